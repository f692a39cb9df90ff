#include "core/bsdf/base.h"

#include "core/tables/ggx_albedo.h"
#include "core/tables/ggx_dielectric.h"

namespace pivot {
namespace {

/// Hemispherical mean of the dielectric curve (fit of [KullaConty17], ior in 1..3).
template <class T>
T dielectric_mean(T ior) {
    return (ior - T(1)) / (T(4.08567f) + T(1.00071f) * ior);
}

/// What the GGX lobe reflects towards wo over what it would without Fresnel. dielectric_share: where the dielectric
/// stands between normal (0) and grazing incidence (1).
template <class T>
Vec3<T> mean_fresnel(const BaseOf<T>& base, T dielectric_share) {
    const LobeFresnelOf<T>& f = base.fresnel;
    const T cosine = base.wo_local.z;
    return f.of_sums(T(1), schlick_weight(cosine), f82_weight(cosine), dielectric_share);
}

template <class T>
T facet_alpha(const BaseMaterialOf<T>& material) {
    return min(max(material.alpha, T(min_alpha)), T(1));
}

}  // namespace

template <class T>
BaseOf<T> make_base(const BaseMaterialOf<T>& material, const Vec3<T>& wo_local) {
    FacetAlbedoOf<T> facets{T(1), T(1)};
    if (any(material.has_glossy())) {
        const T alpha = facet_alpha(material);
        facets.towards_wo = ggx_albedo(alpha, wo_local.z);
        if (any(material.multiscatter > T(0))) facets.mean = ggx_average_albedo(alpha);
    }
    return make_base(material, wo_local, facets);
}

template <class T>
BaseOf<T> make_base(const BaseMaterialOf<T>& material, const Vec3<T>& wo_local, const FacetAlbedoOf<T>& facets) {
    const T zero(0), one(1);
    const Vec3<T> black(zero), white(one);
    BaseOf<T> base{.wo_local = wo_local,
                   .diffuse = material.diffuse,
                   .alpha = facet_alpha(material),
                   .fresnel = {black, black, black, black, material.dielectric_ior},
                   .glossy_probability = zero};
    if (!any(material.has_glossy())) return base;

    LobeFresnelOf<T>& fresnel = base.fresnel;
    const T albedo = facets.towards_wo;
    const Mask<T> multiscatter = material.multiscatter > zero;
    const auto energy_scale = [&](const Vec3<T>& mean) {
        return any(multiscatter) ? select(multiscatter, multiscatter_scale(mean, albedo, facets.mean), white) : white;
    };
    fresnel.schlick_f0 = material.conductor_f0;
    fresnel.schlick_f90 = material.conductor_f90;
    fresnel.conductor_dip = material.conductor_dip;
    if (any(multiscatter && material.has_conductor())) {
        const Vec3<T> mean = fresnel.schlick_f0 + (fresnel.schlick_f90 - fresnel.schlick_f0) * T(schlick_mean_weight) -
                             fresnel.conductor_dip * T(f82_mean_weight);
        // The two Fresnel parts are weighted shares of one surface: each part's own mean is over its own weight.
        const Vec3<T> scale = energy_scale(min(mean / max(material.conductor_weight, T(1e-6f)), white));
        fresnel.schlick_f0 *= scale;
        fresnel.schlick_f90 *= scale;
        fresnel.conductor_dip *= scale;
    }
    const Mask<T> has_dielectric = material.dielectric_weight > zero && material.dielectric_ior > one;
    T share = zero;
    if (any(has_dielectric)) {
        const T weight = select(has_dielectric, material.dielectric_weight, zero);
        const T f0 = f0_from_ior(fresnel.ior);
        const Vec3<T> tinted_f0 = f0 * material.dielectric_tint;
        share = ggx_dielectric_weight(base.alpha, wo_local.z, fresnel.ior);
        const T mean_weight = (dielectric_mean(fresnel.ior) - f0) / (one - f0);
        const Vec3<T> gain = energy_scale(tinted_f0 + (white - tinted_f0) * mean_weight);
        // What the layer reflects. Cycles takes a lobe without multiple scattering for one that loses nothing.
        const Vec3<T> layer = (tinted_f0 + (white - tinted_f0) * share) * gain * select(multiscatter, albedo, one);
        // The diffuse lobe lies on the part that is not conductor, and the dielectric on some or all of that.
        const T conductor = select(material.has_conductor(), material.conductor_weight, zero);
        const T rest = max(material.weight - conductor, T(1e-6f));
        const T coverage = min(weight / rest, one);
        base.diffuse *= max(zero, one - coverage * max_component(layer));
        fresnel.dielectric_f90 = gain * weight;
        fresnel.dielectric_f0 = fresnel.dielectric_f90 * tinted_f0;
    }
    const T glossy = mean_component(mean_fresnel(base, share)) * albedo;
    const T diffuse = mean_component(base.diffuse);
    const T probability = glossy / max(glossy + diffuse, tiny<T>);
    // A faint lobe keeps a share of the samples: its peak may be far above its mean.
    base.glossy_probability =
        select(diffuse > zero && glossy > zero, min(max(probability, T(0.1f)), T(0.9f)), probability);
    return base;
}

template <class T>
Vec3<T> glossy_albedo(const BaseOf<T>& base) {
    return glossy_albedo(base, ggx_albedo(base.alpha, base.wo_local.z));
}

template <class T>
Vec3<T> glossy_albedo(const BaseOf<T>& base, const T& facets_towards_wo) {
    const Mask<T> has_dielectric = base.fresnel.has_dielectric();
    const T share = any(has_dielectric) ? ggx_dielectric_weight(base.alpha, base.wo_local.z, base.fresnel.ior) : T(0);
    return mean_fresnel(base, share) * facets_towards_wo;
}

template Base make_base(const BaseMaterialOf<float>&, const Vec3f&);
template BaseOf<Batch> make_base(const BaseMaterialOf<Batch>&, const Vec3b&);
template Base make_base(const BaseMaterialOf<float>&, const Vec3f&, const FacetAlbedoOf<float>&);
template BaseOf<Batch> make_base(const BaseMaterialOf<Batch>&, const Vec3b&, const FacetAlbedoOf<Batch>&);
template Rgb glossy_albedo(const Base&);
template Vec3b glossy_albedo(const BaseOf<Batch>&);
template Rgb glossy_albedo(const Base&, const float&);
template Vec3b glossy_albedo(const BaseOf<Batch>&, const Batch&);

}  // namespace pivot
