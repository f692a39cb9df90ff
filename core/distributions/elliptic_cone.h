// GGX over a spherical cap in closed form: integral, points, sample, pdf. All in the shading frame, z = normal.
//   [Heitz16]  "Real-Time Polygonal-Light Shading with Linearly Transformed Cosines"
//   [Walter07] "Microfacet Models for Refraction through Rough Surfaces"
//
// 1. omega_i = 2 (o.h) h / |h|^2 - o lies in the cap (c, v = 1 - cos psi) just when h lies in the elliptic cone
//    { b + X a1 d + Y a2 p : X^2 + Y^2 <= 1 }, b = unit(o + c), d = unit(o - c), p = b x d,
//    a1^2 = v / (2 - v), a2^2 = v / (|o + c|^2 / 2 - v).
// 2. The GGX normal distribution [Walter07 (33)] is the clamped cosine under M = diag(ax, ay, 1) [Heitz16], and M^-1
//    maps that cone to another, { B + X A1 + Y A2 }, in which the integral of w dw is pi F e3:
//    S = B B' - A1 A1' - A2 A2' has one positive eigenvalue mu, with eigenvector e3, and -mu1 and -mu2, and
//    F^2 = mu1 mu2 / ((mu + mu1) (mu + mu2)).
// So the integral over the cap of D(h) / (4 cos_o) is F (M o . e3) / cos_o, and an ellipse of area pi F across e3,
// lifted to the sphere, holds the points.
//
// S is diagonal after a Lorentz boost and a rotation of (1, X, Y). The boost's velocity is the centre (X, Y) of the
// highlight in the cap; it, mu and F need sums of like sign of dot products in M and M^-1, where e3 itself would
// cancel. Points come out in (X, Y) and become the cap's axis and an offset: they stay inside the tiniest light.
#pragma once

#include "core/distributions/cap.h"

namespace pivot {

template <class T>
struct GgxCap {
    Cap<T> cap;
    Vec3<T> wo;
    T alpha_x, alpha_y;
    Vec3<T> b, d, p;       // the frame of the half vectors' cone
    T cos_half, sin_half;  // wo = cos_half b + sin_half d, cap.axis = cos_half b - sin_half d
    T a1, a2;              // tangents of the cone's half-angles, towards d and p
    Vec2<T> velocity;      // of the boost
    T gamma;               // 1 / sqrt(1 - velocity^2)
    Vec2<T> major;         // direction of the longer semi-axis, mu1's, after the boost
    T mu, mu1, mu2;        // the eigenvalues of S / scale^2
    T scale;               // |M^-1 b|
    T form_factor;         // F, in [0, 1]
    T integral;            // of D(h) / (4 cos_o) over the cap, without masking, Fresnel and horizon; 0 if not valid
    Mask<T> valid;  // the half vectors make a cone and stay above the surface: else cut the cap, or use quadrature
};

/// One direction inside the cap.
template <class T>
struct GgxCapPoint {
    Vec3<T> omega_i, half;  // unit
    T weight;               // D(h) / (4 cos_o) / pdf_omega: the caller multiplies masking and Fresnel
    T pdf_omega;
};

namespace detail {

/// The positive root, at most 1, of m^3 - trace m^2 + minors m - det2, all of whose roots are real and two negative.
/// Starts above it, from 1 or without m^3 where that helps, and takes Laguerre's steps: four reach the rounding of a
/// double, two that of a float.
template <class T>
T positive_root(T trace, T minors, T det2) {
    const T r = safe_sqrt(minors * minors - T(4) * trace * det2);
    const T quadratic = select(minors > T(0), T(2) * det2 / (minors + r), (r - minors) / (T(-2) * trace));
    T m = select(trace < T(0), min(quadratic, T(1)), T(1));
    constexpr int steps = std::numeric_limits<T>::digits > 24 ? 4 : 2;
    for (int i = 0; i < steps; ++i) {
        const T f = ((m - trace) * m + minors) * m - det2;
        const T slope = (T(3) * m - T(2) * trace) * m + minors;
        const T bend = T(6) * m - T(2) * trace;
        m -= T(3) * f / (slope + safe_sqrt(T(4) * slope * slope - T(6) * f * bend));
    }
    return m;
}

}  // namespace detail

/// wo with wo.z > 0; alphas > 0.
template <class T>
GgxCap<T> ggx_cap(const Vec3<T>& wo, const Cap<T>& cap, T alpha_x, T alpha_y) {
    const T least = tiny<T> / std::numeric_limits<T>::epsilon();
    const Vec3<T> m(alpha_x, alpha_y, T(1)), m_inverse(T(1) / alpha_x, T(1) / alpha_y, T(1));
    GgxCap<T> g;
    g.cap = cap;
    g.wo = wo;
    g.alpha_x = alpha_x;
    g.alpha_y = alpha_y;

    const Vec3<T> sum = wo + cap.axis, difference = wo - cap.axis;
    const T sum2 = length_squared(sum), difference2 = length_squared(difference);
    g.cos_half = T(0.5) * sqrt(sum2);
    g.sin_half = T(0.5) * sqrt(difference2);
    g.b = sum / max(T(2) * g.cos_half, least);
    const Frame<T> frame = frame_from_z(g.b);
    const Vec3<T> across = difference - dot(difference, g.b) * g.b;
    const T across2 = length_squared(across);
    g.d = select(across2 > least, across / sqrt(max(across2, least)), frame.x);
    g.p = cross(g.b, g.d);
    const T room = T(0.5) * sum2 - cap.versine;
    const T a1_2 = cap.versine / (T(2) - cap.versine), a2_2 = cap.versine / max(room, least);
    g.a1 = sqrt(a1_2);
    g.a2 = sqrt(a2_2);
    g.valid = room > T(0) && g.b.z > T(0) && sqr(g.b.z) > a1_2 * sqr(g.d.z) + a2_2 * sqr(g.p.z);

    // B, A1 and A2 in units of |M^-1 b|; cross products of such vectors are those of M b, M d, M p
    g.scale = length(m_inverse * g.b);
    const Vec3<T> B = m_inverse * g.b / g.scale, A1 = m_inverse * g.d * (g.a1 / g.scale),
                  A2 = m_inverse * g.p * (g.a2 / g.scale);
    const T area = T(1) / (alpha_x * alpha_y * g.scale * g.scale);
    const Vec3<T> Mb = m * g.b * area, Md = m * g.d * area, Mp = m * g.p * area;
    const T a12 = a1_2 * a2_2, A1_2 = length_squared(A1), A2_2 = length_squared(A2);
    const T cross12 = a12 * length_squared(Mb);
    const T trace = T(1) - A1_2 - A2_2;
    const T minors = cross12 - a1_2 * length_squared(Mp) - a2_2 * length_squared(Md);
    const T det = g.a1 * g.a2 * area / g.scale;
    g.mu = detail::positive_root(trace, minors, det * det);

    const T divisor = g.mu * (g.mu + A1_2 + A2_2) + cross12;
    g.velocity =
        Vec2<T>(g.a1 * a2_2 * dot(Mb, Md) - g.mu * dot(A1, B), g.a2 * a1_2 * dot(Mb, Mp) - g.mu * dot(A2, B)) / divisor;
    g.gamma = T(1) / sqrt(max(T(1) - dot(g.velocity, g.velocity), std::numeric_limits<T>::epsilon()));

    // the boosted semi-axes, which are across e3, and their larger eigenvector
    const Vec3<T> shift = g.velocity.x * A1 + g.velocity.y * A2;
    const Vec3<T> along = g.gamma * (B + shift) - (g.gamma / (g.gamma + T(1))) * shift;
    const Vec3<T> E1 = A1 + g.velocity.x * along, E2 = A2 + g.velocity.y * along;
    const T half_difference = (length_squared(E1) - length_squared(E2)) * T(0.5), mixed = dot(E1, E2);
    const T radius = max(sqrt(half_difference * half_difference + mixed * mixed), least);
    g.mu1 = (length_squared(E1) + length_squared(E2)) * T(0.5) + radius;
    g.mu2 = det * det / (g.mu * g.mu1);
    const T larger = sqrt(T(0.5) + abs(half_difference) / (T(2) * radius)), smaller = mixed / (T(2) * radius * larger);
    g.major = {select(half_difference > T(0), larger, smaller), select(half_difference > T(0), smaller, larger)};

    g.form_factor = det / sqrt(g.mu * (g.mu * (g.mu + (g.mu - trace)) + det * det / g.mu));
    const T center = g.cos_half + g.velocity.x * g.a1 * g.sin_half;
    g.integral = select(g.valid, g.form_factor * g.gamma * center / (g.scale * sqrt(g.mu) * wo.z), T(0));
    return g;
}

namespace detail {

/// Of a place in the cone after the boost, and its direction's cosine to e3.
template <class T>
GgxCapPoint<T> boosted_point(const GgxCap<T>& g, const Vec2<T>& boosted, T cos_e3) {
    const T approach = dot(g.velocity, boosted), time = g.gamma * (T(1) + approach);
    const Vec2<T> at = (boosted + g.velocity * (g.gamma * (T(1) + approach * g.gamma / (g.gamma + T(1))))) / time;
    const T x = at.x * g.a1, y = at.y * g.a2, bend = x * x + y * y, length2 = T(1) + bend;
    const T cos_oh = g.cos_half + x * g.sin_half;  // times |h|

    const Vec3<T> tilt = x * g.d + y * g.p;
    const Vec3<T> offset = ((x * g.sin_half - g.cos_half * bend) * g.b + cos_oh * tilt) * (T(2) / length2);
    const T stretch = time / (g.scale * sqrt(g.mu));  // |M w| / (|h| cos_e3)
    const T inverse_length = T(1) / sqrt(length2);
    const T jacobian = stretch * cos_e3 / inverse_length;
    const T pdf = cos_e3 * jacobian * jacobian * jacobian /
                  (T(4) * pi<T> * g.form_factor * g.alpha_x * g.alpha_y * cos_oh * inverse_length);
    return {g.cap.axis + offset, (g.b + tilt) * inverse_length, g.form_factor * stretch * cos_oh / g.wo.z, pdf};
}

}  // namespace detail

/// The point at (x, y) of the unit disk: uniform points of the disk, and rules for it, make points of density
/// pdf_omega. (0, 0) is the highlight's centre. `room` is 1 - x^2 - y^2.
template <class T>
GgxCapPoint<T> disk_point(const GgxCap<T>& g, const Vec2<T>& xy, T room) {
    const T k1 = g.mu / (g.mu + g.mu1), k2 = g.mu / (g.mu + g.mu2);
    const T major = xy.x * g.major.x + xy.y * g.major.y, minor = xy.y * g.major.x - xy.x * g.major.y;
    const T cos_e3 = sqrt(room + k1 * sqr(major) + k2 * sqr(minor));
    const T along = major * sqrt(k1) / cos_e3, across = minor * sqrt(k2) / cos_e3;
    return detail::boosted_point(g, {along * g.major.x - across * g.major.y, along * g.major.y + across * g.major.x},
                                 cos_e3);
}

/// A direction in the cap by D(h), up to a smooth weight.
template <class T>
GgxCapPoint<T> sample(const GgxCap<T>& g, const Vec2<T>& u) {
    const T radius = sqrt(u.x), phi = T(2) * pi<T> * u.y;
    return disk_point(g, Vec2<T>(radius * cos(phi), radius * sin(phi)), T(1) - u.x);
}

/// A fixed rule of N = 1, 4, 8 or 16 points. Weigh a smooth factor f by
/// integral * sum(weight f) / sum(weight): exact where f is constant.
template <size_t N, class T>
std::array<GgxCapPoint<T>, N> points(const GgxCap<T>& g) {
    std::array<GgxCapPoint<T>, N> result;
    const std::array<Vec2<T>, N> rule = disk_rule<T, N>();
    for (size_t i = 0; i < N; ++i) result[i] = disk_point(g, rule[i], T(1) - dot(rule[i], rule[i]));
    return result;
}

/// The density of sample, per steradian, of a direction known to lie in the cap: the samples of a least cap, once
/// rounded, may not.
template <class T>
T pdf_omega_inside(const GgxCap<T>& g, const Vec3<T>& omega_i) {
    const Vec3<T> offset = omega_i - g.cap.axis, h = g.wo + omega_i;
    const T along = T(2) * g.cos_half + dot(offset, g.b);  // h . b
    const T x = dot(offset, g.d) / (g.a1 * along), y = dot(offset, g.p) / (g.a2 * along);
    const T length2 = length_squared(h), cos_oh = dot(g.wo, h);
    const T stretched2 = sqr(h.x / g.alpha_x) + sqr(h.y / g.alpha_y) + sqr(h.z);
    const T time = g.gamma * (T(1) - (g.velocity.x * x + g.velocity.y * y)) * along;
    const T cos_e3 = time * g.scale * sqrt(g.mu / stretched2);
    const T jacobian2 = length2 / stretched2;  // |M w|^2
    const T pdf = cos_e3 * jacobian2 * sqrt(jacobian2 * length2) /
                  (T(4) * pi<T> * g.form_factor * g.alpha_x * g.alpha_y * cos_oh);
    return max(pdf, T(0));
}

/// The density of sample, per steradian: 0 outside the cap.
template <class T>
T pdf_omega(const GgxCap<T>& g, const Vec3<T>& omega_i) {
    return select(contains(g.cap, omega_i), pdf_omega_inside(g, omega_i), T(0));
}

}  // namespace pivot
