// A material as seen from one direction: what a shading point needs to evaluate and sample its BSDF, over float or
// batches. Shading frame, z the normal. Every eval is BRDF times cosine, 1/sr; zero below the surface.
//
// The dielectric part darkens the diffuse lobe beneath it by its own directional albedo, and multiple scattering
// between microfacets scales the lobe back to full energy [KullaConty17]; both follow Cycles 4.5, so that one file
// looks the same. [KullaConty17]  Revisiting Physically Based Shading at Imageworks
#pragma once

#include "core/bsdf/fresnel.h"
#include "core/bsdf/material.h"
#include "core/sampling/warp.h"

namespace pivot {

/// Fresnel of the GGX lobe: F(c) = schlick(c) + dielectric(c), scales multiplied in.
template <class T>
struct LobeFresnelOf {
    Vec3<T> schlick_f0, schlick_f90;
    Vec3<T> dielectric_f0, dielectric_f90;
    T ior;

    Mask<T> has_dielectric() const { return max_component(dielectric_f90) > T(0); }

    Vec3<T> at(T cos_theta) const {
        Vec3<T> f = schlick_f0 + (schlick_f90 - schlick_f0) * schlick_weight(cos_theta);
        if (any(has_dielectric()))
            f += dielectric_f0 + (dielectric_f90 - dielectric_f0) * fresnel_dielectric_weight(cos_theta, ior);
        return f;
    }
};

template <class T>
struct SurfaceOf {
    Vec3<T> wo_local;
    Vec3<T> diffuse;
    T alpha;
    LobeFresnelOf<T> fresnel;
    T glossy_probability;  ///< of choosing the GGX lobe when the BSDF is sampled

    Mask<T> has_diffuse() const { return glossy_probability < T(1); }
    Mask<T> has_glossy() const { return glossy_probability > T(0); }
};

using LobeFresnel = LobeFresnelOf<float>;
using Surface = SurfaceOf<float>;

/// wo_local.z > 0. A black material gives a surface with neither lobe's weight; sampling it yields zero.
template <class T>
SurfaceOf<T> make_surface(const MaterialOf<T>& material, const Vec3<T>& wo_local);

/// Albedo of the GGX lobe towards wo when all light around is equal: what it reflects of a white furnace.
Rgb glossy_albedo(const Surface& surface);

template <class T>
Vec3<T> eval_diffuse(const SurfaceOf<T>& surface, const Vec3<T>& wi_local) {
    return surface.diffuse * (max(wi_local.z, T(0)) * T(1.0f / pi<float>));
}

template <class T>
Vec3<T> eval_glossy(const SurfaceOf<T>& surface, const Vec3<T>& wi_local) {
    const Vec3<T> h = normalize(surface.wo_local + wi_local);
    return select(wi_local.z > T(0),
                  surface.fresnel.at(dot(surface.wo_local, h)) *
                      ggx_eval(surface.wo_local, wi_local, surface.alpha, surface.alpha),
                  Vec3<T>(T(0)));
}

template <class T>
Vec3<T> eval(const SurfaceOf<T>& surface, const Vec3<T>& wi_local) {
    const Vec3<T> diffuse = eval_diffuse(surface, wi_local);
    const Mask<T> has_glossy = surface.has_glossy();
    if (!any(has_glossy)) return diffuse;
    return diffuse + select(has_glossy, eval_glossy(surface, wi_local), Vec3<T>(T(0)));
}

/// Density of sample(), both lobes.
template <class T>
T pdf_omega(const SurfaceOf<T>& surface, const Vec3<T>& wi_local) {
    const T diffuse = (T(1) - surface.glossy_probability) * max(wi_local.z, T(0)) * T(1.0f / pi<float>);
    const Mask<T> has_glossy = surface.has_glossy();
    if (!any(has_glossy)) return diffuse;
    const T glossy = ggx_pdf_omega(surface.wo_local, wi_local, surface.alpha, surface.alpha);
    return diffuse + select(has_glossy && wi_local.z > T(0), surface.glossy_probability * glossy, T(0));
}

/// A direction by one of the lobes: u_lobe chooses it, u places it. May lie below the surface.
template <class T>
Vec3<T> sample(const SurfaceOf<T>& surface, T u_lobe, const Vec2<T>& u) {
    const Mask<T> glossy = u_lobe < surface.glossy_probability;
    const Vec3<T> wi_local = sample_cosine_hemisphere(u);
    if (!any(glossy)) return wi_local;
    return select(glossy, ggx_sample(surface.wo_local, surface.alpha, surface.alpha, u), wi_local);
}

}  // namespace pivot
