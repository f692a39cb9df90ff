// Fresnel reflectance: Schlick's curve between two colours for conductors, the exact curve for dielectrics.
//
// [Schlick94]  An Inexpensive BRDF Model for Physically-based Rendering
#pragma once

#include "core/math/vector.h"

namespace pivot {

/// (1 - cos)^5, the weight of f90 in Schlick's curve [Schlick94 (15)].
template <class T>
T schlick_weight(T cos_theta) {
    const T m = clamp01(T(1) - cos_theta);
    return sqr(sqr(m)) * m;
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
