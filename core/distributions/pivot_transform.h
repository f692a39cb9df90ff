// The pivot transformation: the straight-line projection of the sphere through a point r_p inside it.
//   [Dupuy17] "A Spherical Cap Preserving Parameterization for Spherical Distributions", Sec 3
//
// Departures from [Dupuy17]:
// - A pivot is carried as (direction u, delta = 1 - |r_p|), which keeps the bits of pivots close to the sphere.
// - Eq 6-7 rebuild a mapped cap from two boundary points, which cancels (float32 is off by 280x at 1e-2 rad and
//   |r_p| = 0.99) and turns caps beyond a hemisphere inside out. The map is linear on (1, omega), as Lorentz maps are,
//   so the half-space of a cap maps by arithmetic alone.
// - r_p = 0 is the antipodal map, not the identity.
#pragma once

#include "core/distributions/cap.h"

namespace pivot {

template <class T>
struct Pivot {
    Vec3<T> direction;
    T delta;  // 1 - |r_p|, in (0, 1]
};

/// 1 - |r_p|^2.
template <class T>
T power(const Pivot<T>& pivot) {
    return pivot.delta * (T(2) - pivot.delta);
}

/// |omega - r_p|^2 of a unit omega.
template <class T>
T distance_squared(const Pivot<T>& pivot, const Vec3<T>& omega) {
    return sqr(pivot.delta) + (T(1) - pivot.delta) * length_squared(omega - pivot.direction);
}

/// g(omega), the other end of the chord from omega through r_p [Dupuy17 (2)]. Its own inverse [Dupuy17 (3)].
template <class T>
Vec3<T> transform(const Pivot<T>& pivot, const Vec3<T>& omega) {
    const Vec3<T> r_p = (T(1) - pivot.delta) * pivot.direction;
    const Vec3<T> from_omega = (pivot.direction - omega) - pivot.delta * pivot.direction;
    return normalize(r_p + from_omega * (power(pivot) / distance_squared(pivot, omega)));
}

/// d g(omega) / d omega [Dupuy17 (4)].
template <class T>
T jacobian(const Pivot<T>& pivot, const Vec3<T>& omega) {
    return sqr(power(pivot) / distance_squared(pivot, omega));
}

/// g(r) of any point in space but its pole r_p / |r_p|^2 [Dupuy17 (2)].
template <class T>
Vec3<T> transform_point(const Pivot<T>& pivot, const Vec3<T>& r) {
    const Vec3<T> r_p = (T(1) - pivot.delta) * pivot.direction;
    const T a = dot(r, r_p) - T(1);
    const Vec3<T> b = cross(r, r_p);
    return (a * (r - r_p) - cross(r - r_p, b)) / (a * a + length_squared(b));
}

/// 1 - cos psi' and 1 + cos psi' of g(cap), for every size of cap: with q = |c - u|^2 and m = |r_p|, the image is
/// {omega . n >= x}, |n|^2 = x^2 + sin^2 psi.
template <class T>
Vec2<T> transform_versines(const Pivot<T>& pivot, const Cap<T>& cap) {
    const T delta = pivot.delta, m = T(1) - delta, h = cap.versine, q = length_squared(pivot.direction - cap.axis);
    const T x = (m * q - T(2) * h + delta * delta) * inverse(power(pivot)) + h;
    const T sin2 = sin2_half_angle(cap), length2 = x * x + sin2;
    const T inverse_length = inverse_sqrt(max(length2, tiny<T>)), large = T(1) + abs(x) * inverse_length;
    const T small = sin2 * sqr(inverse_length) * inverse(large);
    return {select(x > T(0), small, large), select(x > T(0), large, small)};
}

/// g(cap). Of c and u, its normal n sees just q and the tangent from c to u: that the rounded directions are not of
/// length 1 matters when they are close and delta is small.
template <class T>
Cap<T> transform(const Pivot<T>& pivot, const Cap<T>& cap) {
    const Vec3<T>& u = pivot.direction;
    const T delta = pivot.delta, m = T(1) - delta, h = cap.versine;
    const Vec3<T> to_u = u - cap.axis;
    const T q = length_squared(to_u);
    const T along_u = (m * m * q - T(2) * m * h - delta * delta) * inverse(power(pivot)) + q * T(0.5);
    return {normalize(to_u + (along_u - dot(to_u, u)) * u), transform_versines(pivot, cap).x};
}

}  // namespace pivot
