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
    T mu;                  // the positive eigenvalue of S, over scale^2
    T inverse_scale;       // 1 / |M^-1 b|, the unit of mu, mu1 and mu2
    T det;                 // sqrt(mu mu1 mu2)
    T lift;                // 1 / (|M^-1 b| sqrt(mu))
    T form_factor;         // F, in [0, 1]
};

/// The mapped cone's ellipse across e3, after the boost.
template <class T>
struct GgxAxes {
    Vec2<T> major;      // direction of the longer semi-axis
    Vec2<T> semi_axes;  // tangents of the half-angles: sqrt(mu1 / mu), sqrt(mu2 / mu)
};

/// One direction inside the cap.
template <class T>
struct GgxCapPoint {
    Vec3<T> omega_i, half;  // unit
    T weight;               // D(h) / (4 cos_o) / pdf_omega: the caller multiplies masking and Fresnel
    T cos_oh;
    T pdf_omega;
};

namespace detail {

/// The positive root, at most 1, of m^3 - trace m^2 + minors m - det2, all of whose roots are real and two negative:
/// Laguerre's steps from above it. Each cubes the error, which a lobe much wider than the light starts with almost none
/// of: so lanes say when they are done.
template <class T>
T positive_root(T trace, T minors, T det2) {
    T m = T(1);
    if (const auto is_far = trace < T(0); any(is_far)) {
        // there without m^3
        const T r = safe_sqrt(minors * minors - T(4) * trace * det2);
        const T quadratic = select(minors > T(0), T(2) * det2 / (minors + r), (r - minors) / (T(-2) * trace));
        m = select(is_far, min(quadratic, T(1)), m);
    }
    const T done = T(std::numeric_limits<T>::digits > 24 ? 1e-6 : 1e-3);
    for (int i = 0; i < 5; ++i) {
        const T f = ((m - trace) * m + minors) * m - det2;
        const T slope = (T(3) * m - T(2) * trace) * m + minors;
        const T bend = T(6) * m - T(2) * trace;
        const T step = T(3) * f / (slope + safe_sqrt(T(4) * slope * slope - T(6) * f * bend));
        m -= step;
        if (!any(abs(step) > done * m)) break;
    }
    return m;
}

/// Dot products of a cone's frame under diag(x, y, 1), of x^2 and y^2.
template <class T>
struct FrameProducts {
    T bb, dd, pp, bd, bp;

    FrameProducts(const GgxCap<T>& g, T x2, T y2) {
        const Vec3<T> m2(x2, y2, T(1)), b = m2 * g.b;
        bb = dot(b, g.b);
        bd = dot(b, g.d);
        bp = dot(b, g.p);
        dd = dot(m2 * g.d, g.d);
        pp = dot(m2 * g.p, g.p);
    }

    /// Under diag(x, x, 1).
    FrameProducts(const GgxCap<T>& g, T x2) {
        const auto square = [&](const Vec3<T>& v) { return x2 * (sqr(v.x) + sqr(v.y)) + sqr(v.z); };
        const T cross = (T(1) - x2) * g.b.z;
        bb = square(g.b);
        dd = square(g.d);
        pp = square(g.p);
        bd = cross * g.d.z;
        bp = cross * g.p.z;
    }
};

/// The cone of half vectors.
template <class T>
GgxCap<T> half_vectors(const Vec3<T>& wo, const Cap<T>& cap) {
    const T least = tiny<T> / std::numeric_limits<T>::epsilon();
    GgxCap<T> g;
    g.cap = cap;
    g.wo = wo;

    const Vec3<T> sum = wo + cap.axis, difference = wo - cap.axis;
    const T sum2 = length_squared(sum), difference2 = length_squared(difference);
    const T inverse_sum = inverse_sqrt(max(sum2, least));
    g.cos_half = T(0.5) * sum2 * inverse_sum;
    g.sin_half = T(0.5) * difference2 * inverse_sqrt(max(difference2, least));
    g.b = sum * inverse_sum;
    const Vec3<T> aside = cross(sum, difference);
    const T aside2 = length_squared(aside);
    g.p = aside * inverse_sqrt(max(aside2, least));
    if (const auto is_along = aside2 <= least; any(is_along)) g.p = select(is_along, frame_from_z(g.b).y, g.p);
    g.d = cross(g.p, g.b);
    const T room = T(0.5) * sum2 - cap.versine;
    g.a1 = sqrt(cap.versine * inverse(T(2) - cap.versine));
    g.a2 = sqrt(cap.versine * inverse(max(room, least)));
    return g;
}

/// The rest, of its frame's products under M^-1 and M; inverse_area is 1 / (alpha_x alpha_y).
template <class T>
void put_eigenvalues(GgxCap<T>& g, const FrameProducts<T>& under_inverse, const FrameProducts<T>& under_m,
                     T inverse_area) {
    // B, A1, A2 are b, a1 d, a2 p under M^-1, over |M^-1 b|; cross products of two of them are those of the third under
    // M
    g.inverse_scale = inverse_sqrt(under_inverse.bb);
    const T unit2 = sqr(g.inverse_scale), area = inverse_area * unit2, area2 = sqr(area);
    const T a1_2 = sqr(g.a1), a2_2 = sqr(g.a2);
    const T squares = unit2 * (a1_2 * under_inverse.dd + a2_2 * under_inverse.pp);  // A1^2 + A2^2
    const T cross12 = area2 * a1_2 * a2_2 * under_m.bb;                             // (A1 x A2)^2
    const T trace = T(1) - squares, minors = cross12 - area2 * (a1_2 * under_m.pp + a2_2 * under_m.dd);
    g.det = g.a1 * g.a2 * area * g.inverse_scale;
    g.mu = positive_root(trace, minors, sqr(g.det));

    const T mu_unit2 = g.mu * unit2;
    g.velocity = Vec2<T>(g.a1 * (area2 * a2_2 * under_m.bd - mu_unit2 * under_inverse.bd),
                         g.a2 * (area2 * a1_2 * under_m.bp - mu_unit2 * under_inverse.bp)) *
                 inverse(g.mu * (g.mu + squares) + cross12);
    g.gamma = inverse_sqrt(max(T(1) - dot(g.velocity, g.velocity), std::numeric_limits<T>::epsilon()));

    g.form_factor = g.det * inverse_sqrt(max(sqr(g.mu) * (g.mu + (g.mu - trace)) + sqr(g.det), tiny<T>));
    g.lift = g.inverse_scale * inverse_sqrt(g.mu);
}

}  // namespace detail

/// wo with wo.z > 0, which integral() and weights need alone; alphas > 0.
template <class T>
GgxCap<T> ggx_cap(const Vec3<T>& wo, const Cap<T>& cap, T alpha_x, T alpha_y) {
    GgxCap<T> g = detail::half_vectors(wo, cap);
    g.alpha_x = alpha_x;
    g.alpha_y = alpha_y;
    const T inverse_x = inverse(alpha_x), inverse_y = inverse(alpha_y);
    detail::put_eigenvalues(g, detail::FrameProducts<T>(g, sqr(inverse_x), sqr(inverse_y)),
                            detail::FrameProducts<T>(g, sqr(alpha_x), sqr(alpha_y)), inverse_x * inverse_y);
    return g;
}

/// The same alpha both ways, which is cheaper.
template <class T>
GgxCap<T> ggx_cap(const Vec3<T>& wo, const Cap<T>& cap, T alpha) {
    GgxCap<T> g = detail::half_vectors(wo, cap);
    g.alpha_x = g.alpha_y = alpha;
    const T inverse_area = sqr(inverse(alpha));
    detail::put_eigenvalues(g, detail::FrameProducts<T>(g, inverse_area), detail::FrameProducts<T>(g, sqr(alpha)),
                            inverse_area);
    return g;
}

/// Whether the half vectors make a cone and stay above the surface: else cut the cap, or use quadrature.
template <class T>
Mask<T> is_valid(const GgxCap<T>& g) {
    const T room = T(2) * sqr(g.cos_half) - g.cap.versine;
    return room > T(0) && g.b.z > T(0) && sqr(g.b.z) > sqr(g.a1 * g.d.z) + sqr(g.a2 * g.p.z);
}

/// Whether the half vectors make a cone, above the surface or not.
template <class T>
Mask<T> is_cone(const GgxCap<T>& g) {
    return T(2) * sqr(g.cos_half) - g.cap.versine > T(1e-3f);
}

/// Of D(h) / 4 over the cap if they do: where D means the same below the surface.
template <class T>
T projected_integral(const GgxCap<T>& g) {
    const T center = g.cos_half + g.velocity.x * g.a1 * g.sin_half;
    return g.form_factor * g.gamma * center * g.lift;
}

/// Of D(h) / (4 cos_o) over the cap, without masking, Fresnel and horizon; 0 if not valid.
template <class T>
T integral(const GgxCap<T>& g) {
    return select(is_valid(g), projected_integral(g) * inverse(g.wo.z), T(0));
}

/// Of the semi-axes, boosted: they are across e3.
template <class T>
GgxAxes<T> ellipse_axes(const GgxCap<T>& g) {
    const Vec3<T> m_inverse = Vec3<T>(inverse(g.alpha_x), inverse(g.alpha_y), T(1)) * g.inverse_scale;
    const Vec3<T> B = m_inverse * g.b, A1 = m_inverse * g.d * g.a1, A2 = m_inverse * g.p * g.a2;
    const Vec3<T> shift = g.velocity.x * A1 + g.velocity.y * A2;
    const Vec3<T> along = g.gamma * (B + shift) - (g.gamma * inverse(g.gamma + T(1))) * shift;
    const Vec3<T> E1 = A1 + g.velocity.x * along, E2 = A2 + g.velocity.y * along;
    const T half_difference = (length_squared(E1) - length_squared(E2)) * T(0.5), mixed = dot(E1, E2);
    const T radius = max(sqrt(sqr(half_difference) + sqr(mixed)), tiny<T> / std::numeric_limits<T>::epsilon());
    const T mu1 = (length_squared(E1) + length_squared(E2)) * T(0.5) + radius;
    const T larger = sqrt(T(0.5) + abs(half_difference) / (T(2) * radius)), smaller = mixed / (T(2) * radius * larger);
    const T longer = sqrt(mu1 / g.mu);
    return {{select(half_difference > T(0), larger, smaller), select(half_difference > T(0), smaller, larger)},
            {longer, g.det / (g.mu * sqrt(g.mu) * longer)}};
}

namespace detail {

/// (time, X, Y) of the boosted (1, x, y): the place in the cone is (X, Y) / time. Without the 1 (whole = 0), of a
/// difference of places; sign -1 is the inverse.
template <class T>
Vec3<T> boost(const GgxCap<T>& g, T whole, const Vec2<T>& v, T sign) {
    const T approach = sign * dot(g.velocity, v);
    const Vec2<T> at = v + g.velocity * (sign * g.gamma * (whole + approach * g.gamma * inverse(g.gamma + T(1))));
    return {g.gamma * (whole + approach), at.x, at.y};
}

/// Of a place in the cone; cos_e3 is the direction's cosine. Inlined, to spare the pdf where nobody reads it.
template <class T>
[[gnu::always_inline]] inline GgxCapPoint<T> point_in_cone(const GgxCap<T>& g, const Vec2<T>& at, T time, T cos_e3) {
    const T x = at.x * g.a1, y = at.y * g.a2, bend = x * x + y * y, length2 = T(1) + bend;
    const T cos_oh = g.cos_half + x * g.sin_half;  // times |h|
    const T inverse_length = inverse_sqrt(length2);

    const Vec3<T> tilt = x * g.d + y * g.p;
    const Vec3<T> offset = ((x * g.sin_half - g.cos_half * bend) * g.b + cos_oh * tilt) * (T(2) * sqr(inverse_length));
    const T stretch = time * g.lift;  // |M w| / (|h| cos_e3)
    const T jacobian = stretch * cos_e3 * length2 * inverse_length;
    const T pdf = cos_e3 * jacobian * jacobian * jacobian /
                  (T(4) * pi<T> * g.form_factor * g.alpha_x * g.alpha_y * cos_oh * inverse_length);
    return {g.cap.axis + offset, (g.b + tilt) * inverse_length, g.form_factor * stretch * cos_oh * inverse(g.wo.z),
            cos_oh * inverse_length, pdf};
}

/// Of a boosted place, which is (1, x, y) boosted.
template <class T>
[[gnu::always_inline]] inline GgxCapPoint<T> boosted_point(const GgxCap<T>& g, const Vec3<T>& boosted, T cos_e3) {
    const T inverse_time = inverse(boosted.x);
    return point_in_cone(g, Vec2<T>(boosted.y * inverse_time, boosted.z * inverse_time), boosted.x, cos_e3);
}

}  // namespace detail

/// The highlight's centre.
template <class T>
[[gnu::always_inline]] inline GgxCapPoint<T> center_point(const GgxCap<T>& g) {
    return detail::point_in_cone(g, g.velocity, g.gamma, T(1));
}

/// The point at (x, y) of the unit disk: uniform points of the disk, and rules for it, make points of density
/// pdf_omega. (0, 0) is the highlight's centre. `room` is 1 - x^2 - y^2.
template <class T>
[[gnu::always_inline]] inline GgxCapPoint<T> disk_point(const GgxCap<T>& g, const GgxAxes<T>& axes, const Vec2<T>& xy,
                                                        T room) {
    const T k1 = inverse(T(1) + sqr(axes.semi_axes.x)), k2 = inverse(T(1) + sqr(axes.semi_axes.y));
    const T major = xy.x * axes.major.x + xy.y * axes.major.y, minor = xy.y * axes.major.x - xy.x * axes.major.y;
    const T cos2_e3 = room + k1 * sqr(major) + k2 * sqr(minor), inverse_e3 = inverse_sqrt(max(cos2_e3, tiny<T>));
    const T along = major * sqrt(k1) * inverse_e3, across = minor * sqrt(k2) * inverse_e3;
    const Vec2<T> place(along * axes.major.x - across * axes.major.y, along * axes.major.y + across * axes.major.x);
    return detail::boosted_point(g, detail::boost(g, T(1), place, T(1)), cos2_e3 * inverse_e3);
}

/// A direction in the cap by D(h), up to a smooth weight.
template <class T>
GgxCapPoint<T> sample(const GgxCap<T>& g, const Vec2<T>& u) {
    const T radius = sqrt(u.x), phi = T(2) * pi<T> * u.y;
    return disk_point(g, ellipse_axes(g), Vec2<T>(radius * cos(phi), radius * sin(phi)), T(1) - u.x);
}

/// A fixed rule of N = 1, 4, 8 or 16 points. Weigh a smooth factor f by
/// integral(g) * sum(weight f) / sum(weight): exact where f is constant.
template <size_t N, class T>
std::array<GgxCapPoint<T>, N> points(const GgxCap<T>& g) {
    if constexpr (N == 1) return {center_point(g)};
    std::array<GgxCapPoint<T>, N> result;
    const GgxAxes<T> axes = ellipse_axes(g);
    const std::array<Vec2<T>, N> rule = disk_rule<T, N>();
    for (size_t i = 0; i < N; ++i) result[i] = disk_point(g, axes, rule[i], T(1) - dot(rule[i], rule[i]));
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
    const T cos_e3 = time / (g.lift * sqrt(stretched2));
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
