// The Beckmann microfacet lobe, of which the slopes are distributed normally: its tails are shorter than GGX's. Shading
// frame, z the normal; wo and wi point away from the surface; alpha is the root of twice the slopes' variance.
//
// [Walter07]  Microfacet Models for Refraction through Rough Surfaces
// [Heitz14]   Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs
// [HeitzDEon14]  Importance Sampling Microfacet-Based BSDFs using the Distribution of Visible Normals
#pragma once

#include "core/math/vector.h"

namespace pivot {

/// Density of microfacet normals D(h), 1/sr, for a unit h above the surface [Walter07 (25)].
template <class T>
T beckmann_ndf(const Vec3<T>& h_local, T alpha_x, T alpha_y) {
    const T inverse_z2 = T(1) / max(sqr(h_local.z), T(1e-8f));
    const T slope2 = (sqr(h_local.x / alpha_x) + sqr(h_local.y / alpha_y)) * inverse_z2;
    return exp(-min(slope2, T(80))) * sqr(inverse_z2) / (pi<T> * alpha_x * alpha_y);
}

/// Smith's Lambda of a direction on either side of the surface [Heitz14 (66)].
template <class T>
T beckmann_lambda(const Vec3<T>& w_local, T alpha_x, T alpha_y) {
    const T tan2_alpha2 = (sqr(alpha_x * w_local.x) + sqr(alpha_y * w_local.y)) / max(sqr(w_local.z), T(1e-12f));
    const T a = min(T(1) / sqrt(max(tan2_alpha2, T(1e-4f))), T(8));
    return max(T(0.5f) * (exp(-sqr(a)) / (a * sqrt(pi<T>)) - erfc(a)), T(0));
}

/// A visible slope along the view, of alpha 1, below whose cotangent it lies: the inverse of the integral of
/// (1 - x tan) exp(-x^2) by u in [0, 1) [HeitzDEon14, supplement]. Of tan 0: any normally distributed slope.
template <class T>
T beckmann_visible_slope(T tan_theta, T u) {
    constexpr int steps = 10;
    const T most(4);  // all but 1e-8 of them are nearer to 0
    const T k = tan_theta * T(0.56418958f);
    const auto below = [&](T x) { return T(1) + erf(x) + k * exp(-sqr(x)); };
    T low = T(-1) * most, high = min(T(1) / max(tan_theta, T(1e-3f)), most);
    const T wanted = u * below(high);
    T x = T(0.5f) * (low + high);
    for (int i = 0; i < steps; ++i) {
        const T over = below(x) - wanted;
        high = select(over > T(0), x, high);
        low = select(over > T(0), low, x);
        const T slope = T(1.12837917f) * exp(-sqr(x)) * (T(1) - x * tan_theta);
        const T newton = x - over / max(slope, T(1e-12f));
        x = select(newton >= low && newton <= high, newton, T(0.5f) * (low + high));
    }
    return x;
}

/// A visible microfacet normal for u in [0, 1)^2 [HeitzDEon14].
template <class T>
Vec3<T> beckmann_sample_normal(const Vec3<T>& wo_local, T alpha_x, T alpha_y, const Vec2<T>& u) {
    const T x = wo_local.x * alpha_x, y = wo_local.y * alpha_y;
    const T across = sqrt(x * x + y * y);
    const Mask<T> is_tilted = across > T(1e-7f);
    const T scale = T(1) / select(is_tilted, across, T(1));
    const T cos_phi = select(is_tilted, x * scale, T(1)), sin_phi = select(is_tilted, y * scale, T(0));
    const T along = beckmann_visible_slope(across / max(wo_local.z, T(1e-6f)), u.x);
    const T aside = beckmann_visible_slope(T(0), u.y);
    const T slope_x = cos_phi * along - sin_phi * aside, slope_y = sin_phi * along + cos_phi * aside;
    return normalize(Vec3<T>(-alpha_x * slope_x, -alpha_y * slope_y, T(1)));
}

}  // namespace pivot
