// The base of a surface: a Lambert lobe beneath one GGX lobe, whose product with lights has closed forms. Its numbers
// as a material has them, and as seen from one direction, over float or batches. Shading frame, z the normal. Every
// eval is BRDF times cosine, 1/sr; zero below the base.
//
// The dielectric part darkens the diffuse lobe beneath it by its own directional albedo, and multiple scattering
// between microfacets scales the lobe back to full energy [KullaConty17]; both follow Cycles 4.5, so that one file
// looks the same. [KullaConty17]  Revisiting Physically Based Shading at Imageworks
#pragma once

#include "core/bsdf/fresnel.h"
#include "core/bsdf/ggx.h"
#include "core/sampling/warp.h"

namespace pivot {

/// Principled, Diffuse and Glossy are settings of these numbers; the exporter chooses them.
template <class T>
struct BaseMaterialOf {
    Vec3<T> diffuse{T(0)};  ///< Lambert reflectance, before the dielectric above it takes its share
    T alpha = T(0.5f);      ///< GGX alpha, roughness squared, in [0, 1]; the smoothest is min_alpha
    // The GGX lobe's Fresnel is the sum of two curves, each with its weight multiplied in.
    Vec3<T> conductor_f0{T(0)};   ///< Schlick at normal incidence
    Vec3<T> conductor_f90{T(0)};  ///< Schlick at grazing incidence
    T conductor_weight = T(1);    ///< the weight in both: over it they are what the conductor itself reflects
    T dielectric_weight = T(0);
    T dielectric_ior = T(1.5f);     ///< at least 1
    Vec3<T> dielectric_tint{T(1)};  ///< scales the reflectance at normal incidence
    T multiscatter = T(0);          ///< 1: give back what single scattering loses between microfacets; 0: do not
    T weight = T(1);                ///< the share of the surface that is this base, multiplied into all of the above
    Vec3<T> conductor_dip{T(0)};    ///< what F82 takes off Schlick's curve, over f82_weight

    Mask<T> has_conductor() const { return max(max_component(conductor_f0), max_component(conductor_f90)) > T(0); }
    Mask<T> has_glossy() const { return dielectric_weight > T(0) || has_conductor(); }
};

/// Fresnel of the GGX lobe: F(c) = schlick(c) - dip f82(c) + dielectric(c), scales multiplied in.
template <class T>
struct LobeFresnelOf {
    Vec3<T> schlick_f0, schlick_f90;
    Vec3<T> dielectric_f0, dielectric_f90;
    T ior;
    Vec3<T> conductor_dip{T(0)};

    Mask<T> has_dielectric() const { return max_component(dielectric_f90) > T(0); }
    Mask<T> has_dip() const { return max_component(conductor_dip) > T(0); }

    Vec3<T> at(T cos_theta) const {
        Vec3<T> f = schlick_f0 + (schlick_f90 - schlick_f0) * schlick_weight(cos_theta);
        if (any(has_dip())) f = max(f - conductor_dip * f82_weight(cos_theta), Vec3<T>(T(0)));
        if (any(has_dielectric()))
            f += dielectric_f0 + (dielectric_f90 - dielectric_f0) * fresnel_dielectric_weight(cos_theta, ior);
        return f;
    }

    /// The lobe over something, of what that is for F = 1 and under the curves' weights.
    Vec3<T> of_sums(T plain, T schlick, T f82, T dielectric) const {
        Vec3<T> f = schlick_f0 * plain + (schlick_f90 - schlick_f0) * schlick;
        if (any(has_dip())) f = max(f - conductor_dip * f82, Vec3<T>(T(0)));
        return f + dielectric_f0 * plain + (dielectric_f90 - dielectric_f0) * dielectric;
    }
};

/// How a normal that a shader chose lights the diffuse lobe, in the shading frame, which follows the glossy lobe: that
/// one's normal is kept from mirroring below the surface.
template <class T>
struct DiffuseBumpOf {
    Vec3<T> normal{T(0), T(0), T(1)};
    Vec3<T> normal_smooth{T(0), T(0), T(1)};  ///< the surface's own
    T alpha2 = T(0);                          ///< of the microfacets whose shadows smooth where light ends

    /// Whether the lobe's cosine is any other than that from the frame's normal.
    Mask<T> is_turned() const { return alpha2 > T(0) || normal.z < T(1.0f - 1e-6f); }

    /// The lobe's cosine to light from wi, times what bumps leave of it. [Conty19] A Microfacet-Based Shadowing
    /// Function to Solve the Bump Terminator Problem; with Cycles' sides. [Cycles 4.5 closure/bsdf.h:60-102]
    T cosine(const Vec3<T>& wi_local) const {
        const T bare = max(dot(wi_local, normal), T(0));
        const Mask<T> bumped = alpha2 > T(0);
        if (!any(bumped)) return bare;
        const T c = dot(wi_local, normal_smooth), c2 = max(c * c, T(1e-12f));
        const T shadowing = T(2) / (T(1) + sqrt(T(1) + alpha2 * max(T(1) - c2, T(0)) / c2));
        return select(bumped, bare * select(c > T(1e-6f), min(shadowing, T(1)), T(0)), bare);
    }
};

template <class T>
struct BaseOf {
    Vec3<T> wo_local;
    Vec3<T> diffuse;
    T alpha;
    LobeFresnelOf<T> fresnel;
    T glossy_probability;  ///< of choosing the GGX lobe when the base is sampled
    DiffuseBumpOf<T> bump{};

    Mask<T> has_diffuse() const { return glossy_probability < T(1); }
    Mask<T> has_glossy() const { return glossy_probability > T(0); }
};

/// The base without its GGX lobe.
template <class T>
BaseOf<T> without_highlight(BaseOf<T> base) {
    base.fresnel = {Vec3<T>(T(0)), Vec3<T>(T(0)), Vec3<T>(T(0)), Vec3<T>(T(0)), base.fresnel.ior};
    base.glossy_probability = T(0);
    return base;
}

/// Whether it reflects nothing.
template <class T>
Mask<T> is_black(const BaseOf<T>& base) {
    return !base.has_glossy() && !(max_component(base.diffuse) > T(0));
}

using LobeFresnel = LobeFresnelOf<float>;
using Base = BaseOf<float>;

/// What single scattering between the microfacets keeps of the light, F = 1: towards wo, and its hemispherical mean.
template <class T>
struct FacetAlbedoOf {
    T towards_wo, mean;
};

/// What single scattering must be multiplied by for microfacets to keep the energy of what they reflect or let through,
/// given the mean of its colours over one bounce [KullaConty17].
template <class T>
Vec3<T> multiscatter_scale(const Vec3<T>& mean_color, T albedo, T mean_albedo) {
    const Vec3<T> bounces = mean_color * mean_albedo / (Vec3<T>(T(1)) - mean_color * (T(1) - mean_albedo));
    return Vec3<T>(T(1)) + bounces * ((T(1) - albedo) / albedo);
}

/// wo_local.z > 0. A black one has neither lobe's weight; sampling it yields zero.
template <class T>
BaseOf<T> make_base(const BaseMaterialOf<T>& material, const Vec3<T>& wo_local);

/// The same of microfacets that are not GGX's, but about as rough.
template <class T>
BaseOf<T> make_base(const BaseMaterialOf<T>& material, const Vec3<T>& wo_local, const FacetAlbedoOf<T>& facets);

/// The base, its GGX alpha at least so much and all else as it was: the energy stays that of the sharper, as in Cycles.
template <class T>
BaseOf<T> blurred(BaseOf<T> base, T least_alpha) {
    base.alpha = max(base.alpha, least_alpha);
    return base;
}

/// Albedo of the GGX lobe towards wo when all light around is equal: what it reflects of a white furnace.
template <class T>
Vec3<T> glossy_albedo(const BaseOf<T>& base);
/// The same of microfacets that keep so much of it towards wo.
template <class T>
Vec3<T> glossy_albedo(const BaseOf<T>& base, const T& facets_towards_wo);

/// The same of both lobes.
template <class T>
Vec3<T> albedo_base(const BaseOf<T>& base) {
    return base.diffuse + select(base.has_glossy(), glossy_albedo(base), Vec3<T>(T(0)));
}

template <class T>
Vec3<T> eval_diffuse(const BaseOf<T>& base, const Vec3<T>& wi_local) {
    return base.diffuse * (base.bump.cosine(wi_local) * T(1.0f / pi<float>));
}

template <class T>
Vec3<T> eval_glossy(const BaseOf<T>& base, const Vec3<T>& wi_local) {
    const Vec3<T> h = normalize(base.wo_local + wi_local);
    return select(wi_local.z > T(0),
                  base.fresnel.at(dot(base.wo_local, h)) * ggx_eval(base.wo_local, wi_local, base.alpha, base.alpha),
                  Vec3<T>(T(0)));
}

template <class T>
Vec3<T> eval_base(const BaseOf<T>& base, const Vec3<T>& wi_local) {
    const Vec3<T> diffuse = eval_diffuse(base, wi_local);
    const Mask<T> has_glossy = base.has_glossy();
    if (!any(has_glossy)) return diffuse;
    return diffuse + select(has_glossy, eval_glossy(base, wi_local), Vec3<T>(T(0)));
}

/// A direction from which a facet sends light to wo, and what that light is worth: of facets drawn as wo sees them, the
/// mean is the lobe's reflection.
template <class T>
struct FacetRayOf {
    Vec3<T> wi_local;
    Vec3<T> worth;
};

/// Of the GGX lobe.
template <class T>
FacetRayOf<T> facet_ray(const BaseOf<T>& base, const Vec2<T>& u) {
    const Vec3<T> wi_local = ggx_sample(base.wo_local, base.alpha, base.alpha, u);
    const T pdf = ggx_pdf_omega(base.wo_local, wi_local, base.alpha, base.alpha);
    return {wi_local, select(pdf > T(0), eval_glossy(base, wi_local) / max(pdf, tiny<T>), Vec3<T>(T(0)))};
}

/// Density of sample_base(), both lobes.
template <class T>
T pdf_omega_base(const BaseOf<T>& base, const Vec3<T>& wi_local) {
    const T diffuse = (T(1) - base.glossy_probability) * max(wi_local.z, T(0)) * T(1.0f / pi<float>);
    const Mask<T> has_glossy = base.has_glossy();
    if (!any(has_glossy)) return diffuse;
    const T glossy = ggx_pdf_omega(base.wo_local, wi_local, base.alpha, base.alpha);
    return diffuse + select(has_glossy && wi_local.z > T(0), base.glossy_probability * glossy, T(0));
}

/// A direction by one of the lobes: u_lobe chooses it, u places it. May lie below the surface.
template <class T>
Vec3<T> sample_base(const BaseOf<T>& base, T u_lobe, const Vec2<T>& u) {
    const Mask<T> glossy = u_lobe < base.glossy_probability;
    const Vec3<T> wi_local = sample_cosine_hemisphere(u);
    if (!any(glossy)) return wi_local;
    return select(glossy, ggx_sample(base.wo_local, base.alpha, base.alpha, u), wi_local);
}

}  // namespace pivot
