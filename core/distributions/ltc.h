// Linearly transformed cosines over lights above the surface, closed: caps and polygons, in the shading frame, z =
// normal.
//   [Heitz16] "Real-Time Polygonal-Light Shading with Linearly Transformed Cosines"
//   [Lambert] for the boundary form: the integral of omega . z over a region is 1/2 oint (w x dw) . z / |w|^2.
//
// [Heitz16] has polygons, clips at the cosine's own horizon only, and calls spheres disks. Here M^-1 makes of a cap a
// cone of second order, { b + x a1 + y a2 : x^2 + y^2 <= 1 }, and of the surface's horizon a plane. With b, a1 and a2
// perpendicular, the boundary's part on the cone is an integral of
//   (n0 + nc cos t + ns sin t) / (mu + mu1 cos^2 t + mu2 sin^2 t),
// which is elementary, and the parts on the two planes are great circles. In double whatever T, as ltsd.h's polygons
// are. Branches: for float and double only.
#pragma once

#include "core/distributions/elliptic_cone.h"
#include "core/distributions/ltsd.h"

namespace pivot {

namespace detail {

/// A cone of second order by perpendicular vectors, counterclockwise in this order about b.
struct DiagonalCone {
    Vec3<double> b, a1, a2;

    Vec3<double> rim(double t) const { return b + cos(t) * a1 + sin(t) * a2; }
};

/// The same for any b, a1 and a2: as S = b b' - a1 a1' - a2 a2' stays under Lorentz maps of (1, x, y), the boost that
/// takes b to the eigenvector of S's one positive eigenvalue, and a turn (see elliptic_cone.h).
inline DiagonalCone diagonal_cone(Vec3<double> b, Vec3<double> a1, Vec3<double> a2) {
    const double unit = 1.0 / length(b);
    b *= unit, a1 *= unit, a2 *= unit;
    if (dot(b, cross(a1, a2)) < 0.0) a2 = -a2;
    const Vec3<double> a12 = cross(a1, a2), ba1 = cross(b, a1), ba2 = cross(b, a2);
    const double det = dot(b, a12), squares = length_squared(a1) + length_squared(a2);
    const double mu =
        positive_root(1.0 - squares, length_squared(a12) - length_squared(ba1) - length_squared(ba2), det * det);
    const double divisor = mu * (mu + squares) + length_squared(a12);
    const double vx = -(mu * dot(a1, b) + dot(a12, ba2)) / divisor, vy = -(mu * dot(a2, b) - dot(a12, ba1)) / divisor;
    const double gamma = 1.0 / sqrt(max(1.0 - vx * vx - vy * vy, tiny<double>));

    const Vec3<double> shift = vx * a1 + vy * a2;
    const Vec3<double> along = gamma * (b + shift) - gamma / (gamma + 1.0) * shift;
    const Vec3<double> e1 = a1 + vx * along, e2 = a2 + vy * along;
    const double turn = 0.5 * atan2(2.0 * dot(e1, e2), length_squared(e1) - length_squared(e2));
    return {gamma * (b + shift), cos(turn) * e1 + sin(turn) * e2, cos(turn) * e2 - sin(turn) * e1};
}

/// 1/2 int (w x dw) . z / |w|^2 along the rim from azimuth `begin` to `end`.
inline double rim_cosine_integral(const DiagonalCone& cone, double begin, double end) {
    const double mu = length_squared(cone.b), mu1 = length_squared(cone.a1), mu2 = length_squared(cone.a2);
    const double difference = max(mu1 - mu2, 0.0), at_a1 = mu + mu1, at_a2 = mu + mu2;  // |w|^2
    const double k = sqrt(at_a2 / at_a1), kc = sqrt(difference / at_a1), ks = sqrt(difference / at_a2);
    const auto ratio = [](double value, double x) { return x > 1e-8 ? value / x : 1.0; };
    const auto antiderivative = [&](double t) {
        const double c = cos(t), s = sin(t);
        const double of_one = (t + atan2((k - 1.0) * s * c, c * c + k * s * s)) / (k * at_a1);
        const double of_cos = s * ratio(std::atanh(kc * abs(s)), kc * abs(s)) / at_a1;
        const double of_sin = -c * ratio(atan(ks * abs(c)), ks * abs(c)) / at_a2;
        return cross(cone.a1, cone.a2).z * of_one + cross(cone.b, cone.a2).z * of_cos -
               cross(cone.b, cone.a1).z * of_sin;
    };
    return 0.5 * (antiderivative(end) - antiderivative(begin));
}

/// The angle of the great-circle arc from p to q that lies above a plane; p and q are less than half a turn apart.
inline double angle_above(Vec3<double> p, Vec3<double> q, const Vec3<double>& plane_normal) {
    const double above_p = dot(p, plane_normal), above_q = dot(q, plane_normal);
    if (above_p <= 0.0 && above_q <= 0.0) return 0.0;
    const Vec3<double> crossing = abs(above_q) * p + abs(above_p) * q;
    if (above_p < 0.0) p = crossing;
    if (above_q < 0.0) q = crossing;
    return atan2(length(cross(p, q)), dot(p, q));
}

/// The integral of omega . z over the cone's part above the planes through the origin with these normals, one of which
/// is z.
inline double cone_cosine_integral(const DiagonalCone& cone, std::span<const Vec3<double>> planes) {
    std::array<double, 5> cuts{};  // azimuths where the rim crosses a plane
    size_t count = 0;
    double sum = 0.0;
    for (size_t i = 0; i < planes.size(); ++i) {
        const Vec3<double>& n = planes[i];
        const double height = dot(cone.b, n), h1 = dot(cone.a1, n), h2 = dot(cone.a2, n);
        const double swing = sqrt(h1 * h1 + h2 * h2);  // hypot would ask for glibc 2.35
        if (height <= -swing) return 0.0;
        if (height >= swing) continue;
        const double top = atan2(h2, h1), half = acos(-height / swing);
        const Vec3<double> leaves = cone.rim(top + half), enters = cone.rim(top - half);
        const bool alone = planes.size() == 1;
        sum += 0.5 * n.z *
               (alone ? atan2(length(cross(leaves, enters)), dot(leaves, enters))
                      : angle_above(leaves, enters, planes[1 - i]));
        for (const double cut : {top - half, top + half}) {
            size_t k = count++;
            for (cuts[k] = cut - 2.0 * pi<double> * floor(cut / (2.0 * pi<double>)); k > 0 && cuts[k] < cuts[k - 1];
                 --k)
                std::swap(cuts[k], cuts[k - 1]);
        }
    }
    cuts[count] = count > 0 ? cuts[0] + 2.0 * pi<double> : 2.0 * pi<double>;
    for (size_t k = 0; k < std::max<size_t>(count, 1); ++k) {
        const double begin = count > 0 ? cuts[k] : 0.0, end = count > 0 ? cuts[k + 1] : cuts[0];
        const Vec3<double> middle = cone.rim(0.5 * (begin + end));
        if (std::all_of(planes.begin(), planes.end(), [&](const Vec3<double>& n) { return dot(middle, n) > 0.0; }))
            sum += rim_cosine_integral(cone, begin, end);
    }
    return max(sum, 0.0);
}

}  // namespace detail

/// The share of D above the surface: M^-1 takes its horizon to a plane, and a cosine over the lune left is closed.
template <class T>
T integrate_above_horizon(const Ltsd<T>& ltc) {
    const Vec3<T> horizon(ltc.m[0].z, ltc.m[1].z, ltc.m[2].z);
    return T(0.5) * (T(1) + horizon.z / length(horizon));
}

/// The integral of D over a cap's part above the surface.
template <class T>
T integrate_above_horizon(const Ltsd<T>& ltc, const Cap<T>& cap) {
    if (cap.versine > T(1))
        return max(integrate_above_horizon(ltc) - integrate_above_horizon(ltc, complement(cap)), T(0));
    const Mat3<double> m(ltc.m), m_inverse = glm::inverse(m);
    const Frame<double> frame = frame_from_z(normalize(Vec3<double>(cap.axis)));
    const double versine = static_cast<double>(cap.versine), radius = sqrt(versine * (2.0 - versine));
    const auto cone = detail::diagonal_cone(m_inverse * (max(1.0 - versine, 1e-9) * frame.z),
                                            m_inverse * (radius * frame.x), m_inverse * (radius * frame.y));
    const Vec3<double> z(0.0, 0.0, 1.0), horizon = normalize(Vec3<double>(m[0].z, m[1].z, m[2].z));
    const std::array<Vec3<double>, 2> planes{z, horizon};
    const bool one_plane = length_squared(horizon - z) < 1e-24;
    const std::span<const Vec3<double>> distinct(planes.data(), one_plane ? 1 : 2);
    return T(detail::cone_cosine_integral(cone, distinct) / pi<double>);
}

/// The integral of D over a polygon's part above the surface, its vertices relative to the shading point.
template <class T>
T integrate_above_horizon(const Ltsd<T>& ltc, std::span<const Vec3<T>> polygon) {
    const Polygon<T> above = clip_to_upper_hemisphere(polygon);
    return above.size() < 3 ? T(0) : integrate<T>(ltc, above);
}

}  // namespace pivot
