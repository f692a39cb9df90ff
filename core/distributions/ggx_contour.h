// GGX over any outline by its contour: to convergence, or with n chords an edge. In the shading frame, z = normal.
//   [Heitz16] "Real-Time Polygonal-Light Shading with Linearly Transformed Cosines"
//
// Reflection takes the light's outline to half vectors and M^-1 = diag(1/ax, 1/ay, 1) those to w = unit(M^-1 h), where
// GGX is a clamped cosine. With the vector irradiance V = 1/2 oint w x dw of what w encloses, the integral of
// D(h) / (4 cos_o) is (M o . V) / (pi cos_o). Light below the surface is clipped first: that leaves every h above it.
//
// As oint r x dw = 0, V = 1/2 oint (w - r) x d(w - r) for any r: with r a point of the outline, and w - r from
// differences of the light's points, a tiny light keeps its bits. Branches: for float and double only.
#pragma once

#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/math/quadrature.h"
#include "core/math/stable.h"

namespace pivot {

/// The integral over a light, and the half vector of its highlight's centre.
template <class T>
struct GgxContourIntegral {
    T integral;    // of D(h) / (4 cos_o) over what of the light is above the surface; without masking and Fresnel
    Vec3<T> half;  // unit; the normal if the integral is 0
};

namespace detail {

using Vec3d = Vec3<double>;

/// Calls visit(from, to) for each edge of what of the polygon is above z = 0, along its plane and then along z = 0.
template <class Visit>
void for_each_edge_above(std::span<const Vec3d> polygon, const Visit& visit) {
    const auto crossing = [](const Vec3d& a, const Vec3d& b) {
        const Vec3d p = a + (b - a) * (a.z / (a.z - b.z));
        return Vec3d(p.x, p.y, 0);
    };
    std::optional<Vec3d> left, entered;  // where the outline last went below, and where it first came up
    for (size_t i = 0; i < polygon.size(); ++i) {
        const Vec3d &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
        const bool a_above = a.z >= 0, b_above = b.z >= 0;
        if (!a_above && !b_above) continue;
        const Vec3d from = a_above ? a : crossing(a, b), to = b_above ? b : crossing(a, b);
        if (!a_above && left)
            visit(*std::exchange(left, std::nullopt), from);
        else if (!a_above)
            entered = from;
        visit(from, to);
        if (!b_above) left = to;
    }
    if (left && entered) visit(*left, *entered);
}

/// w - r along the light's outline, for r = w(reference).
struct StretchedHalf {
    Vec3d wo, m_inverse, reference, r;
    double length_p, length_w;  // at the reference

    StretchedHalf(const Vec3d& o, const Vec3d& m, const Vec3d& p)
        : wo(o), m_inverse(1.0 / m), reference(p), length_p(length(p)) {
        const Vec3d w = m_inverse * (p + length_p * wo);
        length_w = length(w);
        r = w / length_w;
    }

    struct Point {
        Vec3d offset;  // w - r
        Vec3d slope;   // dw/dt, where dp/dt is given
    };

    Point at(const Vec3d& p, const Vec3d& dp_dt) const {
        const Vec3d step = p - reference;
        const double length_here = length(p);
        const Vec3d dw = m_inverse * (step + (dot(step, p + reference) / (length_here + length_p)) * wo);
        const Vec3d w = r * length_w + dw;
        const double norm = length(w);
        // |w| (1/|w| - 1/|w_r|)
        const double shrink = -dot(dw, w + r * length_w) / ((norm + length_w) * length_w);
        const Vec3d unit = w / norm;
        const Vec3d slope = m_inverse * (dp_dt + (dot(p, dp_dt) / length_here) * wo);
        return {dw / norm + r * (length_w * shrink / norm), (slope - unit * dot(unit, slope)) / norm};
    }
};

/// The integral of (w - r) x dw along p(t) = from + t edge, t in [0, 1], by `count` great circles.
inline Vec3d chords(const StretchedHalf& half, const Vec3d& from, const Vec3d& edge, int count) {
    Vec3d sum(0), a = half.at(from, edge).offset;
    for (int i = 1; i <= count; ++i) {
        const Vec3d b = half.at(from + edge * (double(i) / count), edge).offset;
        const Vec3d normal = cross(half.r + a, b - a);
        const double sine = length(normal), angle = atan2(sine, dot(half.r + a, half.r + b));
        sum += cross(a, b) + (sine > 0 ? x_minus_sin(angle) / sine : 0.0) * normal;
        a = b;
    }
    return sum;
}

/// The same on [begin, begin + length] by Gauss and Legendre's rule, halved until that changes it by less than
/// `tolerance`.
inline Vec3d converged(const StretchedHalf& half, const Vec3d& from, const Vec3d& edge, double tolerance,
                       double begin = 0, double length = 1, int depth = 0) {
    const auto rule = [&](double t0, double dt) {
        return gauss_legendre8(dt, [&](double t) {
            const auto w = half.at(from + (t0 + t) * edge, edge);
            return cross(w.offset, w.slope);
        });
    };
    const double dt = length / 2;
    const Vec3d halves = rule(begin, dt) + rule(begin + dt, dt);
    if (depth == 30 || !(pivot::length(halves - rule(begin, length)) > tolerance)) return halves;
    return converged(half, from, edge, tolerance, begin, dt, depth + 1) +
           converged(half, from, edge, tolerance, begin + dt, dt, depth + 1);
}

/// The light in double, whatever T: of a sliver, the contour's two sides leave little.
struct Outline {
    Vec3d wo, m;
    std::vector<Vec3d> polygon;
    std::optional<StretchedHalf> half;  // none if all of the polygon is below the surface

    template <class T>
    Outline(const Vec3<T>& o, T alpha_x, T alpha_y, std::span<const Vec3<T>> vertices)
        : wo(o), m(alpha_x, alpha_y, 1), polygon(vertices.begin(), vertices.end()) {
        const auto highest =
            std::max_element(polygon.begin(), polygon.end(), [](const Vec3d& a, const Vec3d& b) { return a.z < b.z; });
        if (highest->z > 0) half.emplace(wo, m, *highest);
    }

    template <class T, class Along>
    GgxContourIntegral<T> integrate(const Along& along) const {
        Vec3d sum(0);
        if (half)
            for_each_edge_above(polygon, [&](const Vec3d& from, const Vec3d& to) { sum += along(from, to - from); });
        const double projected = dot(m * wo, sum);
        if (projected == 0) return {T(0), {T(0), T(0), T(1)}};
        const Vec3d center = normalize(m * sum) * (sum.z < 0 ? -1.0 : 1.0);
        return {T(abs(projected) / (2 * pi<double> * wo.z)), Vec3<T>(center)};
    }
};

}  // namespace detail

/// GGX over a polygon by `count` >= 1 great circles for each edge; its vertices are relative to the shaded point,
/// either way round.
template <class T>
GgxContourIntegral<T> ggx_polygon_chords(const Vec3<T>& wo, T alpha_x, T alpha_y, std::span<const Vec3<T>> polygon,
                                         int count) {
    const detail::Outline outline(wo, alpha_x, alpha_y, polygon);
    return outline.integrate<T>([&](const detail::Vec3d& from, const detail::Vec3d& edge) {
        return detail::chords(*outline.half, from, edge, count);
    });
}

/// The same to the precision of T.
template <class T>
GgxContourIntegral<T> ggx_polygon(const Vec3<T>& wo, T alpha_x, T alpha_y, std::span<const Vec3<T>> polygon) {
    using detail::Vec3d;
    const detail::Outline outline(wo, alpha_x, alpha_y, polygon);
    double path = 0;  // of |w - r| |dw|, whose rounding the tolerance must stay above
    Vec3d sum(0);
    outline.integrate<double>([&](const Vec3d& from, const Vec3d& edge) {
        Vec3d a = outline.half->at(from, edge).offset;
        for (const double t : {0.25, 0.5, 0.75, 1.0}) {
            const Vec3d b = outline.half->at(from + t * edge, edge).offset;
            path += length(b - a) * max(length(a), length(b));
            a = b;
        }
        sum += detail::chords(*outline.half, from, edge, 4);
        return sum;
    });
    const double tolerance = max(16 * std::numeric_limits<double>::epsilon() * path,
                                 0.01 * static_cast<double>(std::numeric_limits<T>::epsilon()) * length(sum));
    return outline.integrate<T>(
        [&](const Vec3d& from, const Vec3d& edge) { return detail::converged(*outline.half, from, edge, tolerance); });
}

}  // namespace pivot
