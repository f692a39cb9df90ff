// Spherical polygons: integrals of 1, omega and z^2 over them, and their part above the horizon z = 0.
// The sides are great-circle arcs between the unit vertices; every integral is signed, positive for vertices
// that turn counter-clockwise as seen from the origin.
//
// [Oosterom83] van Oosterom and Strackee, "The Solid Angle of a Plane Triangle", IEEE Trans. Biomed. Eng.
// 30(2), 1983. [Arvo95]     Arvo, "Applications of Irradiance Tensors to the Simulation of Non-Lambertian
// Phenomena", 1995.
//
// The edge sums of a polygon of size e are made of terms of order e that cancel to e^2. Here their leading part is
// summed from differences of vertices instead, so that the relative error is eps / e, what rounding the vertices costs
// anyway; and along the horizon, where z^2 cancels once more, integrals of z come from the boundary form that is small
// with z.
#pragma once

#include <span>
#include <vector>

#include "core/math/quadrature.h"
#include "core/math/vector.h"

namespace pivot {

template <class T>
using Polygon = std::vector<Vec3<T>>;

namespace detail {

/// angle / sin(angle) - 1 for the angle between unit vectors a and b, given a x b.
template <class T>
T arc_excess(const Vec3<T>& a, const Vec3<T>& b, const Vec3<T>& a_cross_b) {
    const T x = length_squared(b - a) * T(0.25);  // sin^2(angle / 2)
    T series = T(0);
    for (int n = 8; n > 0; --n) series = (T(1) + series) * x * T(2 * n) / T(2 * n + 1);
    const T sine = length(a_cross_b);
    const T direct = atan2(sine, dot(a, b)) / max(sine, std::numeric_limits<T>::min()) - T(1);
    return select(x < T(0.01), series, direct);
}

/// The sum of a x b over the sides: twice the vector area of the flat polygon, from differences.
template <class T>
Vec3<T> twice_vector_area(std::span<const Vec3<T>> polygon) {
    Vec3<T> sum(T(0));
    for (size_t i = 2; i < polygon.size(); ++i) sum += cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]);
    return sum;
}

/// a x b without the cancellation of close vectors.
template <class T>
Vec3<T> cross_close(const Vec3<T>& a, const Vec3<T>& b) {
    return cross(a, b - a);
}

}  // namespace detail

/// The part of a polygon at z >= 0, its vertices of unit length; fewer than three when nothing is left.
template <class T>
Polygon<T> clip_to_upper_hemisphere(std::span<const Vec3<T>> polygon) {
    Polygon<T> above;
    above.reserve(polygon.size() + 2);
    for (size_t i = 0; i < polygon.size(); ++i) {
        const Vec3<T>& a = polygon[i];
        const Vec3<T>& b = polygon[(i + 1) % polygon.size()];
        if (a.z >= T(0)) above.push_back(normalize(a));
        if ((a.z > T(0) && b.z < T(0)) || (a.z < T(0) && b.z > T(0))) {
            Vec3<T> crossing = (b.z * a - a.z * b) / (b.z - a.z);
            crossing.z = T(0);
            above.push_back(normalize(crossing));
        }
    }
    return above;
}

/// Solid angle in steradians: a fan of triangles [Oosterom83 (8)].
template <class T>
T solid_angle(std::span<const Vec3<T>> polygon) {
    T sum = T(0);
    for (size_t i = 2; i < polygon.size(); ++i) {
        const Vec3<T>&a = polygon[0], &b = polygon[i - 1], &c = polygon[i];
        const T volume = dot(a, cross(b - a, c - a));
        sum += T(2) * atan2(volume, T(1) + dot(a, b) + dot(b, c) + dot(c, a));
    }
    return sum;
}

/// Vector irradiance, the integral of omega: half the sum of angle * unit(a x b) over the sides (Lambert).
template <class T>
Vec3<T> vector_irradiance(std::span<const Vec3<T>> polygon) {
    Vec3<T> sum = detail::twice_vector_area(polygon);
    for (size_t i = 0; i < polygon.size(); ++i) {
        const Vec3<T>&a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        const Vec3<T> n = detail::cross_close(a, b);
        sum += detail::arc_excess(a, b, n) * n;
    }
    return sum * T(0.5);
}

/// The integral of z^2: (solid angle + sum of (a x b)_z (a_z + b_z) / (1 + a.b)) / 3, from the boundary form
/// of the second axial moment [Arvo95 (13)] with the line integral of omega over an arc, (a + b) tan(angle /
/// 2).
template <class T>
T integrate_z_squared(std::span<const Vec3<T>> polygon) {
    if (polygon.size() < 3) return T(0);
    const T z = polygon[0].z;
    T sum = solid_angle(polygon) + z * detail::twice_vector_area(polygon).z;
    for (size_t i = 0; i < polygon.size(); ++i) {
        const Vec3<T>&a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        const T one_plus_cos = length_squared(a + b) * T(0.5);
        const T mean_z_less_z = ((a.z - z) + (b.z - z) + z * length_squared(b - a) * T(0.5)) / one_plus_cos;
        sum += detail::cross_close(a, b).z * mean_z_less_z;
    }
    return sum / T(3);
}

/// Whether z stays so small over a polygon that the sums above would cancel further, to the z of what they sum.
template <class T>
bool lies_along_horizon(std::span<const Vec3<T>> polygon) {
    const T low = T(0.3);
    for (size_t i = 0; i < polygon.size(); ++i) {
        const Vec3<T>&a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        if (abs(a.z) > low || abs(a.z + b.z) > low * length(a + b)) return false;
    }
    return abs(solid_angle(polygon)) < T(3);  // one around the pole covers 2 pi (1 - 0.3) and more
}

/// The integral of z^power over a polygon that lies along the horizon. As d omega = dz d azimuth, it is that of
/// -z^(power + 1) / (power + 1) d azimuth along the sides: small where z is.
template <class T>
T integrate_z_power_along_horizon(std::span<const Vec3<T>> polygon, int power) {
    T sum = T(0);
    for (size_t i = 0; i < polygon.size(); ++i) {
        const Vec3<T>&a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        const Vec3<T> n = detail::cross_close(a, b);
        const T sine = length(n);
        if (!(sine > T(0))) continue;
        const T angle = atan2(sine, dot(a, b));
        sum += n.z / sqr(sine) * gauss_legendre(T(0), angle, [&](T s) {
                   const T z_sine = a.z * sin(angle - s) + b.z * sin(s), z = z_sine / sine;
                   return (power == 1 ? z_sine : z_sine * z) * z / ((T(1) - z) * (T(1) + z));
               });
    }
    return -sum / T(power + 1);
}

}  // namespace pivot
