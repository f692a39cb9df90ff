// Spherical caps {omega : omega . axis >= cos psi}, as (axis, versine h = 1 - cos psi): a tiny cap keeps all its bits.
//   [Dupuy17]   "A Spherical Cap Preserving Parameterization for Spherical Distributions", Sec 3.3, 5.1
//   [Shirley96] "Monte Carlo Techniques for Direct Lighting Calculations"
#pragma once

#include "core/math/frame.h"
#include "core/math/quadrature.h"
#include "core/math/stable.h"

namespace pivot {

template <class T>
struct Cap {
    Vec3<T> axis;
    T versine;  // in [0, 2]: 0 is a point, 1 a hemisphere, 2 the sphere
};

template <class T>
T cos_half_angle(const Cap<T>& cap) {
    return T(1) - cap.versine;
}

template <class T>
T sin2_half_angle(const Cap<T>& cap) {
    return cap.versine * (T(2) - cap.versine);
}

/// The rest of the sphere.
template <class T>
Cap<T> complement(const Cap<T>& cap) {
    return {-cap.axis, T(2) - cap.versine};
}

/// In steradians [Dupuy17 (5)].
template <class T>
T solid_angle(const Cap<T>& cap) {
    return T(2) * pi<T> * cap.versine;
}

template <class T>
Mask<T> contains(const Cap<T>& cap, const Vec3<T>& omega) {
    return length_squared(omega - cap.axis) <= T(2) * cap.versine;
}

/// The direction at azimuth 2 pi u.y whose versine from the cap's axis is u.x of the cap's: uniform in solid angle.
template <class T>
Vec3<T> sample(const Cap<T>& cap, const Vec2<T>& u) {
    const T versine = cap.versine * u.x, radius = safe_sqrt(versine * (T(2) - versine)), phi = T(2) * pi<T> * u.y;
    return frame_from_z(cap.axis).to_world({radius * cos(phi), radius * sin(phi), T(1) - versine});
}

template <class T>
T pdf_omega(const Cap<T>& cap, const Vec3<T>& omega) {
    return select(contains(cap, omega), T(1) / solid_angle(cap), T(0));
}

/// What a sphere covers, seen from the origin [Shirley96]; from inside or on it, the whole sphere of directions.
template <class T>
Cap<T> cap_of_sphere(const Vec3<T>& center, T radius) {
    const T distance = length(center);
    const auto outside = distance > radius;
    const T safe_distance = select(outside, distance, T(1));
    const T sin_psi = radius / safe_distance;
    const T cos_psi = safe_sqrt((distance - radius) * (distance + radius)) / safe_distance;
    return {select(outside, center / safe_distance, Vec3<T>(T(0), T(0), T(1))),
            select(outside, sqr(sin_psi) / (T(1) + cos_psi), T(2))};
}

/// What a disk covers that faces the origin from center; nothing is ever inside it.
template <class T>
Cap<T> cap_of_facing_disk(const Vec3<T>& center, T radius) {
    const T distance = length(center), slant = sqrt(sqr(distance) + sqr(radius));
    const auto apart = distance > tiny<T>;
    return {select(apart, center / select(apart, distance, T(1)), Vec3<T>(T(0), T(0), T(1))),
            sqr(radius) / (slant * (slant + distance))};
}

/// The integral of max(0, omega . normal) over the cap, cut by the horizon: pi times the form factor, and the area of
/// the cap projected along the normal.
///
/// With z = axis . normal, g^2 = sin^2 psi - z^2 and alpha the azimuth where the rim meets the horizon, Stokes' theorem
/// gives atan2(g, cos psi) - g cos psi + alpha z sin^2 psi. Two cases cancel and are rewritten: small caps, and, as
/// d/dz = sin^2 psi (alpha - sin alpha cos alpha), slivers above the horizon.
template <class T>
T clamped_cosine_integral(const Cap<T>& cap, const Vec3<T>& normal) {
    const auto large = cap.versine > T(1);
    const T h = select(large, T(2) - cap.versine, cap.versine);
    const T z = select(large, -dot(cap.axis, normal), dot(cap.axis, normal));
    const T c = T(1) - h, s2 = h * (T(2) - h), s = sqrt(s2);

    const T g = safe_sqrt((s - z) * (s + z));
    const T alpha = select(abs(z) < s, atan2(g, -c * z), select(z > T(0), pi<T>, T(0)));
    const T x = g / max(c, T(0.5));
    const T lune = select(c > T(0.5), x * s2 - x_minus_atan(x), atan2(g, c) - g * c);
    const T sliver = s2 * s * sqr(c) * gauss_legendre8(min(alpha, T(0.5)), [&](T t) {
                         const T l2 = sqr(c) + s2 * sqr(cos(t));
                         return sin(t) * x_minus_sin(t + t) * T(0.5) / (l2 * sqrt(l2));
                     });
    const T integral = select(alpha < T(0.5), sliver, lune + alpha * z * s2);
    return select(large, pi<T> - integral, integral);
}

}  // namespace pivot
