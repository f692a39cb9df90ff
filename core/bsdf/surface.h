// A material as seen from one direction: what a shading point needs to evaluate and sample its BSDF.
// Shading frame, z the normal. Every eval is BRDF times cosine, 1/sr; zero below the surface.
//
// The dielectric part darkens the diffuse lobe beneath it by its own directional albedo, and multiple scattering
// between microfacets scales the lobe back to full energy [KullaConty17]; both follow Cycles 4.5, so that one file
// looks the same. [KullaConty17]  Revisiting Physically Based Shading at Imageworks
#pragma once

#include "core/bsdf/fresnel.h"
#include "core/bsdf/material.h"

namespace pivot {

/// Fresnel of the GGX lobe: F(c) = schlick(c) + dielectric(c), scales multiplied in.
struct LobeFresnel {
    Rgb schlick_f0, schlick_f90;
    Rgb dielectric_f0, dielectric_f90;
    float ior;

    Rgb at(float cos_theta) const;
};

struct Surface {
    Vec3f wo_local;
    Rgb diffuse;
    float alpha;
    LobeFresnel fresnel;
    float glossy_probability;  ///< of choosing the GGX lobe when the BSDF is sampled

    bool has_diffuse() const { return glossy_probability < 1.0f; }
    bool has_glossy() const { return glossy_probability > 0.0f; }
};

/// wo_local.z > 0. A black material gives a surface with neither lobe's weight; sampling it yields zero.
Surface make_surface(const Material& material, const Vec3f& wo_local);

/// Albedo of the GGX lobe towards wo when all light around is equal: what it reflects of a white furnace.
Rgb glossy_albedo(const Surface& surface);

Rgb eval_diffuse(const Surface& surface, const Vec3f& wi_local);
Rgb eval_glossy(const Surface& surface, const Vec3f& wi_local);
Rgb eval(const Surface& surface, const Vec3f& wi_local);

/// Density of sample(), both lobes.
float pdf_omega(const Surface& surface, const Vec3f& wi_local);

/// A direction by one of the lobes: u_lobe chooses it, u places it. May lie below the surface.
Vec3f sample(const Surface& surface, float u_lobe, const Vec2f& u);

}  // namespace pivot
