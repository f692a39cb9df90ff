// Fresnel reflectance: for conductors Schlick's curve between two colours, what F82 takes off it towards grazing
// incidence, and the curve of an index of refraction; for dielectrics the exact curve.
//
// [Schlick94]  An Inexpensive BRDF Model for Physically-based Rendering
// [Kutz21]     Novel Aspects of the Adobe Standard Material
#pragma once

#include "core/math/vector.h"

namespace pivot {

/// (1 - cos)^5, the weight of f90 in Schlick's curve [Schlick94 (15)].
template <class T>
T schlick_weight(T cos_theta) {
    const T m = clamp01(T(1) - cos_theta);
    return sqr(sqr(m)) * m;
}

/// cos (1 - cos)^6, the weight of what F82 takes off Schlick's curve [Kutz21].
template <class T>
T f82_weight(T cos_theta) {
    const T c = clamp01(cos_theta);
    return c * (T(1) - c) * schlick_weight(c);
}

/// Where F82 is given: at about 82 degrees.
inline constexpr float f82_cosine = 1.0f / 7.0f;

/// Hemispherical means, 2 int w(c) c dc, of the weights of Schlick and of F82.
inline constexpr float schlick_mean_weight = 1.0f / 21.0f;
inline constexpr float f82_mean_weight = 1.0f / 126.0f;

/// Unpolarised reflectance of a conductor of index n + i k. [Cycles 4.5 closure/bsdf_util.h, fresnel_conductor]
template <class T>
Vec3<T> fresnel_conductor(T cos_theta, const Vec3<T>& n, const Vec3<T>& k) {
    const T c = clamp01(cos_theta), c2 = sqr(c);
    const Vec3<T> one(T(1)), size2 = n * n + k * k, twice = T(2) * c * n;
    const Vec3<T> p = (size2 * c2 - twice + one) / (size2 * c2 + twice + one);
    const Vec3<T> s = (size2 - twice + Vec3<T>(c2)) / (size2 + twice + Vec3<T>(max(c2, tiny<T>)));
    return T(0.5f) * (p + s);
}

/// Reflectance of a dielectric at normal incidence.
template <class T>
T f0_from_ior(T ior) {
    return sqr((ior - T(1)) * inverse(ior + T(1)));
}

/// Unpolarised reflectance of a dielectric boundary, cos_theta >= 0; ior: of the other side, over that of the side
/// where the light is. Below 1 all is reflected past some angle; cos_theta = 0 is then no angle.
template <class T>
T fresnel_dielectric(T cos_theta, T ior) {
    const T g = safe_sqrt(sqr(ior) - T(1) + sqr(cos_theta));
    const T s = (g - cos_theta) * inverse(g + cos_theta);
    const T p = (cos_theta * (g + cos_theta) - T(1)) * inverse(cos_theta * (g - cos_theta) + T(1));
    return T(0.5) * sqr(s) * (T(1) + sqr(p));
}

/// Where the dielectric curve stands between F0 (0) and 1 (1).
template <class T>
T fresnel_dielectric_weight(T cos_theta, T ior) {
    const T f0 = f0_from_ior(ior);
    return clamp01((fresnel_dielectric(cos_theta, ior) - f0) * inverse(T(1) - f0));
}

}  // namespace pivot
