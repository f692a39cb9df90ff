// The GGX microfacet lobe: normal distribution, height-correlated Smith masking-shadowing, sampling of
// visible normals. Shading frame, z the normal; wo and wi point away from the surface; alpha is the GGX
// parameter (roughness squared).
//
// [Walter07]  Microfacet Models for Refraction through Rough Surfaces
// [Heitz14]   Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs
// [Dupuy23]   Sampling Visible GGX Normals with Spherical Caps
#pragma once

#include "core/math/vector.h"

namespace pivot {

/// GGX's own highlights stay exact in float32 down to this alpha; smaller ones are indistinguishable from it.
inline constexpr float min_alpha = 1e-3f;

/// Density of microfacet normals D(h), 1/sr, for a unit h above the surface [Walter07 (33)].
template <class T>
T ggx_ndf(const Vec3<T>& h_local, T alpha_x, T alpha_y) {
    const T slope = sqr(h_local.x / alpha_x) + sqr(h_local.y / alpha_y) + sqr(h_local.z);
    return T(1) / (pi<T> * alpha_x * alpha_y * sqr(slope));
}

/// Smith's Lambda of a direction on either side of the surface [Heitz14 (72)].
template <class T>
T ggx_lambda(const Vec3<T>& w_local, T alpha_x, T alpha_y) {
    const T tan2_alpha2 = (sqr(alpha_x * w_local.x) + sqr(alpha_y * w_local.y)) / sqr(w_local.z);
    return T(0.5) * tan2_alpha2 / (T(1) + sqrt(T(1) + tan2_alpha2));
}

/// Masking G1 of one direction.
template <class T>
T ggx_g1(const Vec3<T>& w_local, T alpha_x, T alpha_y) {
    return T(1) / (T(1) + ggx_lambda(w_local, alpha_x, alpha_y));
}

/// Height-correlated masking-shadowing G2 [Heitz14 (99)].
template <class T>
T ggx_g2(const Vec3<T>& wo_local, const Vec3<T>& wi_local, T alpha_x, T alpha_y) {
    return T(1) / (T(1) + ggx_lambda(wo_local, alpha_x, alpha_y) + ggx_lambda(wi_local, alpha_x, alpha_y));
}

/// BRDF times cosine without Fresnel, D G2 / (4 cos_o), 1/sr; both directions above the surface.
template <class T>
T ggx_eval(const Vec3<T>& wo_local, const Vec3<T>& wi_local, T alpha_x, T alpha_y) {
    const Vec3<T> h = normalize(wo_local + wi_local);
    return ggx_ndf(h, alpha_x, alpha_y) * ggx_g2(wo_local, wi_local, alpha_x, alpha_y) / (T(4) * wo_local.z);
}

/// pdf_omega of the direction that ggx_sample draws: G1(wo) D / (4 cos_o), 1/sr.
template <class T>
T ggx_pdf_omega(const Vec3<T>& wo_local, const Vec3<T>& wi_local, T alpha_x, T alpha_y) {
    const Vec3<T> h = normalize(wo_local + wi_local);
    return ggx_ndf(h, alpha_x, alpha_y) * ggx_g1(wo_local, alpha_x, alpha_y) / (T(4) * wo_local.z);
}

/// A visible microfacet normal for u in [0, 1)^2 [Dupuy23, listing 3].
template <class T>
Vec3<T> ggx_sample_normal(const Vec3<T>& wo_local, T alpha_x, T alpha_y, const Vec2<T>& u) {
    const Vec3<T> wo_stretched = normalize(Vec3<T>(wo_local.x * alpha_x, wo_local.y * alpha_y, wo_local.z));
    const T phi = T(2) * pi<T> * u.x;
    const T z = (T(1) - u.y) * (T(1) + wo_stretched.z) - wo_stretched.z;
    const T sin_theta = safe_sqrt(T(1) - sqr(z));
    const Vec3<T> h = Vec3<T>(sin_theta * cos(phi), sin_theta * sin(phi), z) + wo_stretched;
    return normalize(Vec3<T>(h.x * alpha_x, h.y * alpha_y, h.z));
}

/// wo mirrored at a visible normal; may lie below the surface, where the lobe is zero.
template <class T>
Vec3<T> ggx_sample(const Vec3<T>& wo_local, T alpha_x, T alpha_y, const Vec2<T>& u) {
    const Vec3<T> h = ggx_sample_normal(wo_local, alpha_x, alpha_y, u);
    return T(2) * dot(wo_local, h) * h - wo_local;
}

}  // namespace pivot
