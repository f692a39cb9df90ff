// Linearly transformed spherical distributions: a base distribution D_o carried along omega = M omega_o / |M
// omega_o|.
//
// [Heitz16] Heitz, Dupuy, Hill, Neubelt, "Real-Time Polygonal-Light Shading with Linearly Transformed
// Cosines",
//           ACM TOG 35(4), 2016, and its supplement "Properties and MATLAB validation of LTSDs".
//
// Departures from the supplement: the polygon integral is closed, where it uses a Riemann sum (whose
// 0.0059141 should be 0.00589054787); its uniform hemisphere is sampled by (sin cos, sin sin, cos), where it
// prints cos cos for the second; the mean direction is one integral over a line (derived below), where it
// integrates over the sphere.
#pragma once

#include "core/distributions/spherical_polygon.h"

namespace pivot {

/// D_o: each integrates to 1 over the sphere.
enum class BaseDistribution { uniform_sphere, uniform_hemisphere, clamped_cosine, squared_clamped_cosine };

template <class T>
struct Ltsd {
    BaseDistribution base;
    Mat3<T> m, m_inverse;
    T abs_det_inverse;
};

/// m must be invertible; its scale has no effect.
template <class T>
Ltsd<T> make_ltsd(BaseDistribution base, const Mat3<T>& m) {
    const T size = max(length_squared(m[0]), max(length_squared(m[1]), length_squared(m[2])));
    const Mat3<T> unit = m * T(std::ldexp(1.0, -std::ilogb(size) / 2));  // a power of two: without rounding
    const T det = dot(unit[0], cross(unit[1], unit[2]));
    return {base, unit, glm::inverse(unit), T(1) / abs(det)};
}

/// D_o in 1/sr at the cosine to its axis, z.
template <class T>
T eval_base(BaseDistribution base, T cos_theta) {
    const T z = max(cos_theta, T(0));
    switch (base) {
        case BaseDistribution::uniform_sphere:
            return T(0.25) / pi<T>;
        case BaseDistribution::uniform_hemisphere:
            return select(cos_theta >= T(0), T(0.5) / pi<T>, T(0));
        case BaseDistribution::clamped_cosine:
            return z / pi<T>;
        default:
            return T(1.5) / pi<T> * z * z;
    }
}

/// The integral of D_o over a polygon of unit vertices.
template <class T>
T integrate_base(BaseDistribution base, std::span<const Vec3<T>> polygon) {
    if (base == BaseDistribution::uniform_sphere) return abs(solid_angle(polygon)) * T(0.25) / pi<T>;
    const Polygon<T> clipped = clip_to_upper_hemisphere(polygon);
    const std::span<const Vec3<T>> above = clipped;
    if (base == BaseDistribution::uniform_hemisphere) return abs(solid_angle(above)) * T(0.5) / pi<T>;
    const bool flat = lies_along_horizon(above);
    if (base == BaseDistribution::clamped_cosine)
        return abs(flat ? integrate_z_power_along_horizon(above, 1) : vector_irradiance(above).z) / pi<T>;
    return abs(flat ? integrate_z_power_along_horizon(above, 2) : integrate_z_squared(above)) * T(1.5) / pi<T>;
}

/// (cos theta, sin theta) of a direction drawn from D_o, by inverting its distribution at xi.
template <class T>
Vec2<T> sample_base_theta(BaseDistribution base, T xi) {
    const T rest = T(1) - xi;
    switch (base) {
        case BaseDistribution::uniform_sphere:
            return {T(2) * xi - T(1), T(2) * sqrt(xi * rest)};
        case BaseDistribution::uniform_hemisphere:
            return {xi, sqrt(rest * (T(1) + xi))};
        case BaseDistribution::clamped_cosine:
            return {sqrt(xi), sqrt(rest)};
        default: {
            const T z = cbrt(xi);
            return {z, sqrt(rest * (T(1) + z) / (T(1) + z + z * z))};
        }
    }
}

/// D in 1/sr [Heitz16 (1)].
template <class T>
T eval(const Ltsd<T>& ltsd, const Vec3<T>& omega) {
    const Vec3<T> w = ltsd.m_inverse * omega;
    const T inverse_length = T(1) / length(w);
    return eval_base(ltsd.base, w.z * inverse_length) * ltsd.abs_det_inverse * sqr(inverse_length) * inverse_length;
}

/// A direction drawn from D; its pdf per steradian is eval [Heitz16, algorithm 1 of the supplement].
template <class T>
Vec3<T> sample(const Ltsd<T>& ltsd, const Vec2<T>& u) {
    const Vec2<T> theta = sample_base_theta(ltsd.base, u.x);
    const T phi = T(2) * pi<T> * u.y;
    return normalize(ltsd.m * Vec3<T>(theta.y * cos(phi), theta.y * sin(phi), theta.x));
}

/// The integral of D over the directions of a polygon that does not contain the origin, its vertices in either order.
/// In double whatever T: M^-1 makes thin triangles of round ones, beyond what float's vertices can hold.
template <class T>
T integrate(const Ltsd<T>& ltsd, std::span<const Vec3<T>> polygon) {
    const Mat3<double> m_inverse = glm::inverse(Mat3<double>(ltsd.m));
    Polygon<double> transformed;
    transformed.reserve(polygon.size());
    for (const Vec3<T>& vertex : polygon) transformed.push_back(normalize(m_inverse * Vec3<double>(vertex)));
    return T(integrate_base<double>(ltsd.base, transformed));
}

/// The mean direction E[omega], of length <= 1.
///
/// |M x|^-1 = 2 / sqrt(pi) int_0^inf exp(-t^2 |M x|^2) dt turns the integral over the hemisphere into moments
/// of half a Gaussian of covariance C(t) = (I + t^2 M'M)^-1 / 2, which are closed: proportional to M C e_z
/// times a power of C_zz. What remains is one integral over t, exponentially accurate by the trapezoidal rule
/// in log t. With M = (x | y | z),
///   det(I + t^2 M'M) = 1 + t^2 (|x|^2 + |y|^2 + |z|^2) + t^4 (|x*y|^2 + |y*z|^2 + |z*x|^2) + t^6 det(M)^2 =:
///   d 2 d C_zz         = 1 + t^2 (|x|^2 + |y|^2) + t^4 |x*y|^2 =: q 2 d M C e_z      = z + t^2 (x*(z*x) +
///   y*(z*y)) + t^4 det(M) x*y                                           =: n
/// where * is the cross product, the integrand is n / d^(3/2) for the cosine, n / (d q^(1/2)) for the uniform
/// hemisphere, n q^(1/2) / d^2 for the squared cosine, times what makes M = I give E_o[cos].
template <class T>
Vec3<T> mean_direction(const Ltsd<T>& ltsd) {
    if (ltsd.base == BaseDistribution::uniform_sphere) return Vec3<T>(T(0));
    const Vec3<T>&x = ltsd.m[0], &y = ltsd.m[1], &z = ltsd.m[2];
    const Vec3<T> xy = cross(x, y), yz = cross(y, z), zx = cross(z, x);
    const T det = T(1) / ltsd.abs_det_inverse, sign = select(dot(xy, z) < T(0), T(-1), T(1));
    const T sum_squares = length_squared(x) + length_squared(y) + length_squared(z);
    const T sum_minors = length_squared(xy) + length_squared(yz) + length_squared(zx);
    const Vec3<T> n1 = cross(x, zx) - cross(y, yz), n2 = sign * det * xy;

    // The step resolves the poles at imaginary t; the ends are where the integrand falls below rounding.
    const T bits = -log(std::numeric_limits<T>::epsilon()), step = sqr(pi<T>) / bits;
    const T low = -bits - T(0.5) * log(sum_squares), high = bits / T(3) + T(0.5) * log(sum_minors) - log(det);
    const int steps = static_cast<int>((high - low) / step) + 1;
    Vec3<T> sum(T(0));
    for (int i = 0; i <= steps; ++i) {
        const T t = exp(low + T(i) * step), t2 = t * t;
        const T d = T(1) + t2 * (sum_squares + t2 * (sum_minors + t2 * sqr(det)));
        const T q = T(1) + t2 * (length_squared(x) + length_squared(y) + t2 * length_squared(xy));
        const Vec3<T> n = (z + t2 * (n1 + t2 * n2)) * (t / d);
        switch (ltsd.base) {
            case BaseDistribution::uniform_hemisphere:
                sum += n / (sqrt(q) * pi<T> / T(2));
                break;
            case BaseDistribution::clamped_cosine:
                sum += n / sqrt(d);
                break;
            default:
                sum += n * (sqrt(q) / (d * pi<T> / T(4)));
        }
    }
    return sum * step;
}

}  // namespace pivot
