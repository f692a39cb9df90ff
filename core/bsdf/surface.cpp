#include "core/bsdf/surface.h"

#include "core/sampling/warp.h"
#include "core/tables/ggx_albedo.h"
#include "core/tables/ggx_dielectric.h"

namespace pivot {
namespace {

/// Hemispherical mean of Schlick's weight, and of the dielectric curve (fit of [KullaConty17], ior in 1..3).
constexpr float schlick_mean_weight = 1.0f / 21.0f;

float dielectric_mean(float ior) { return (ior - 1.0f) / (4.08567f + 1.00071f * ior); }

/// What single scattering must be multiplied by for the lobe to keep its energy, given its mean Fresnel [KullaConty17].
Rgb multiscatter_scale(const Rgb& mean_fresnel, float albedo, float mean_albedo) {
    const Rgb bounces = mean_fresnel * mean_albedo / (Rgb(1.0f) - mean_fresnel * (1.0f - mean_albedo));
    return Rgb(1.0f) + bounces * ((1.0f - albedo) / albedo);
}

/// Of the GGX lobe towards wo, over what it would reflect without Fresnel.
Rgb mean_fresnel(const Surface& surface) {
    const LobeFresnel& fresnel = surface.fresnel;
    const float cos_o = surface.wo_local.z;
    Rgb mean = fresnel.schlick_f0 + (fresnel.schlick_f90 - fresnel.schlick_f0) * schlick_weight(cos_o);
    if (max_component(fresnel.dielectric_f90) > 0.0f) {
        const float share = ggx_dielectric_weight(surface.alpha, cos_o, fresnel.ior);
        mean += fresnel.dielectric_f0 + (fresnel.dielectric_f90 - fresnel.dielectric_f0) * share;
    }
    return mean;
}

}  // namespace

Rgb LobeFresnel::at(float cos_theta) const {
    Rgb f = schlick_f0 + (schlick_f90 - schlick_f0) * schlick_weight(cos_theta);
    if (max_component(dielectric_f90) > 0.0f) {
        f += dielectric_f0 + (dielectric_f90 - dielectric_f0) * fresnel_dielectric_weight(cos_theta, ior);
    }
    return f;
}

Surface make_surface(const Material& material, const Vec3f& wo_local) {
    Surface surface{.wo_local = wo_local,
                    .diffuse = material.diffuse,
                    .alpha = std::clamp(material.alpha, min_alpha, 1.0f),
                    .fresnel = {},
                    .glossy_probability = 0.0f};
    LobeFresnel& fresnel = surface.fresnel;
    fresnel.ior = material.dielectric_ior;
    if (!material.has_glossy()) return surface;

    const float albedo = ggx_albedo(surface.alpha, wo_local.z);
    const float mean_albedo = material.multiscatter ? ggx_average_albedo(surface.alpha) : 1.0f;
    fresnel.schlick_f0 = material.conductor_f0;
    fresnel.schlick_f90 = material.conductor_f90;
    if (material.multiscatter && max_component(fresnel.schlick_f90) > 0.0f) {
        const Rgb mean = fresnel.schlick_f0 + (fresnel.schlick_f90 - fresnel.schlick_f0) * schlick_mean_weight;
        // The two Fresnel parts are weighted shares of one surface: each part's own mean is over its own weight.
        const Rgb own_mean = min(mean / std::max(material.conductor_weight, 1e-6f), Rgb(1.0f));
        const Rgb scale = multiscatter_scale(own_mean, albedo, mean_albedo);
        fresnel.schlick_f0 *= scale;
        fresnel.schlick_f90 *= scale;
    }
    if (material.dielectric_weight > 0.0f && fresnel.ior > 1.0f) {
        const float f0 = f0_from_ior(fresnel.ior);
        const Rgb tinted_f0 = f0 * material.dielectric_tint;
        const float share = ggx_dielectric_weight(surface.alpha, wo_local.z, fresnel.ior);
        // What the layer reflects. Cycles takes a lobe without multiple scattering for one that loses nothing.
        Rgb layer = tinted_f0 + (Rgb(1.0f) - tinted_f0) * share;
        Rgb scale(material.dielectric_weight);
        if (material.multiscatter) {
            const float mean_weight = (dielectric_mean(fresnel.ior) - f0) / (1.0f - f0);
            const Rgb gain = multiscatter_scale(tinted_f0 + (Rgb(1.0f) - tinted_f0) * mean_weight, albedo, mean_albedo);
            layer *= gain * albedo;
            scale *= gain;
        }
        // The diffuse lobe lies on the part that is not conductor, and the dielectric on some or all of that.
        const bool has_conductor = max_component(max(material.conductor_f0, material.conductor_f90)) > 0.0f;
        const float rest = has_conductor ? std::max(1.0f - material.conductor_weight, 1e-6f) : 1.0f;
        const float coverage = std::min(material.dielectric_weight / rest, 1.0f);
        surface.diffuse *= std::max(0.0f, 1.0f - coverage * max_component(layer));
        fresnel.dielectric_f0 = scale * tinted_f0;
        fresnel.dielectric_f90 = scale;
    }
    const float glossy = mean_component(mean_fresnel(surface)) * albedo;
    const float diffuse = mean_component(surface.diffuse);
    if (glossy > 0.0f) surface.glossy_probability = glossy / (glossy + diffuse);
    // A faint lobe keeps a share of the samples: its peak may be far above its mean.
    if (diffuse > 0.0f && glossy > 0.0f)
        surface.glossy_probability = std::clamp(surface.glossy_probability, 0.1f, 0.9f);
    return surface;
}

Rgb glossy_albedo(const Surface& surface) {
    return mean_fresnel(surface) * ggx_albedo(surface.alpha, surface.wo_local.z);
}

Rgb eval_diffuse(const Surface& surface, const Vec3f& wi_local) {
    return surface.diffuse * (std::max(wi_local.z, 0.0f) / pi<float>);
}

Rgb eval_glossy(const Surface& surface, const Vec3f& wi_local) {
    if (wi_local.z <= 0.0f) return Rgb(0.0f);
    const Vec3f h = normalize(surface.wo_local + wi_local);
    return surface.fresnel.at(dot(surface.wo_local, h)) *
           ggx_eval(surface.wo_local, wi_local, surface.alpha, surface.alpha);
}

Rgb eval(const Surface& surface, const Vec3f& wi_local) {
    Rgb f = eval_diffuse(surface, wi_local);
    if (surface.has_glossy()) f += eval_glossy(surface, wi_local);
    return f;
}

float pdf_omega(const Surface& surface, const Vec3f& wi_local) {
    if (wi_local.z <= 0.0f) return 0.0f;
    float pdf = 0.0f;
    if (surface.has_diffuse()) pdf += (1.0f - surface.glossy_probability) * wi_local.z / pi<float>;
    if (surface.has_glossy()) {
        pdf += surface.glossy_probability * ggx_pdf_omega(surface.wo_local, wi_local, surface.alpha, surface.alpha);
    }
    return pdf;
}

Vec3f sample(const Surface& surface, float u_lobe, const Vec2f& u) {
    if (u_lobe < surface.glossy_probability) return ggx_sample(surface.wo_local, surface.alpha, surface.alpha, u);
    return sample_cosine_hemisphere(u);
}

}  // namespace pivot
