// A density over an area light that is fit to one lobe: nodes on what of the light is above the horizon, bilinear
// between. area_sampling.h says why so. Over float or SIMD batches.
#pragma once

#include <algorithm>
#include <array>

#include "core/integrators/area_view.h"

namespace pivot {

/// A place and its density by (x, y).
template <class T>
struct AreaSample {
    Vec2<T> place;
    T pdf;
};

namespace detail {

template <class T>
struct AreaSpan {
    T low, high;

    T nearest(T x) const { return min(max(x, low), high); }
};

/// How far the light reaches along half_v at x.
template <class T>
T half_height(const AreaView<T>& light, T x) {
    T height(1);
    if (any(light.triangle)) height = select(light.triangle, max(T(0.5) + T(0.5) * x, T(1e-3f)), height);
    if (any(light.ellipse)) height = select(light.ellipse, sqrt(max(T(1) - x * x, T(1e-6f))), height);
    return height;
}

/// Where along half_v the light is above the horizon at x.
template <class T>
AreaSpan<T> y_above(const AreaView<T>& light, T x) {
    const T height = half_height(light, x), rise = light.half_v.z, nearly = T(1.0f - 1e-4f) * height;
    if (!any(light.center.z < abs(light.half_u.z) + abs(rise))) return {-height, height};
    const T cut = -(light.center.z + x * light.half_u.z) / rise;
    return {select(rise > T(0), min(max(cut, -height), nearly), -height),
            select(rise < T(0), max(min(cut, height), -nearly), height)};
}

/// Where along half_u any of the light is above the horizon.
template <class T>
AreaSpan<T> x_above(const AreaView<T>& light) {
    const T rise_u = light.half_u.z, rise_v = abs(light.half_v.z), z = light.center.z, nearly(1.0f - 1e-4f);
    // The higher of the two sides rises evenly from x = 0; a triangle's from its tip.
    const T slant = rise_u + select(light.triangle, T(0.5) * rise_v, T(0));
    const T cut = -(z + select(light.triangle, T(0.5), T(1)) * rise_v) / slant;
    T low = select(slant > T(0), cut, T(-1)), high = select(slant < T(0), cut, T(1));
    if (any(light.ellipse)) {
        // The rim is above within an angle of its highest place.
        const T per_rise = inverse_sqrt(max(sqr(rise_u) + sqr(rise_v), tiny<T>));
        const T cosine = min(max(-z * per_rise, T(-1)), T(1)), sine = sqrt(max(T(1) - sqr(cosine), T(0)));
        const T top_x = rise_u * per_rise, top_y = rise_v * per_rise;
        low = select(light.ellipse, select(top_x <= -cosine, T(-1), top_x * cosine - top_y * sine), low);
        high = select(light.ellipse, select(top_x >= cosine, T(1), top_x * cosine + top_y * sine), high);
    }
    return {min(max(low, T(-1)), nearly), max(min(high, T(1)), -nearly)};
}

/// How a lobe's distribution (1 + |m|^2)^-2 changes with x and y where it is about m + x m_u + y m_v.
template <class T>
struct AreaFit {
    T mm, um, vm, uu, uv, vv;  ///< products of m, m_u and m_v

    /// A place nearer to where |m| is least on the light, from the place of the fit.
    Vec2<T> least(const AreaView<T>& light, const AreaSpan<T>& x_span, const Vec2<T>& from) const {
        const T per_vv = inverse(vv), slope = uv * per_vv;
        const auto best_y = [&](T x) { return y_above(light, x).nearest(from.y - (vm + uv * (x - from.x)) * per_vv); };
        const T free_x = from.x - (um - slope * vm) * inverse(across());
        T x = x_span.nearest(free_x);
        // The y that is best there may be out of reach; x is what it is with the nearest.
        x = x_span.nearest(from.x - (um + uv * (best_y(x) - from.y)) * inverse(uu));
        if (any(light.ellipse)) {
            // From beside an ellipse, about where its rim is passed on the way to its centre.
            const T free_y = from.y - (vm + uv * (free_x - from.x)) * per_vv;
            const T shrink = inverse_sqrt(max(sqr(free_x) + sqr(free_y), T(1)));
            x = select(light.ellipse, x_span.nearest(free_x * shrink), x);
        }
        return {x, best_y(x)};
    }
    /// |m_u|^2 across m_v: of x, whatever y is.
    T across() const { return max(uu - sqr(uv) * inverse(vv), T(1e-6f)); }
};

template <class T>
AreaFit<T> fit_of(const Vec3<T>& m, const Vec3<T>& m_u, const Vec3<T>& m_v) {
    return {
        dot(m, m), dot(m, m_u), dot(m, m_v), max(dot(m_u, m_u), T(1e-6f)), dot(m_u, m_v), max(dot(m_v, m_v), T(1e-6f))};
}

/// Of the GGX lobe: slopes in alphas. per_alpha: over that of x and y, and 0; all in the highlight's own frame.
template <class T>
AreaFit<T> fit_glossy(const AreaView<T>& light, const Vec3<T>& wo, const Vec3<T>& per_alpha, const Vec2<T>& at) {
    const Vec3<T> d = light.center + at.x * light.half_u + at.y * light.half_v;
    const T inverse_d = inverse_sqrt(max(dot(d, d), tiny<T>));
    const Vec3<T> wi = d * inverse_d;
    const T inverse_h = inverse(max(wo.z + wi.z, T(1e-3f)));
    const Vec3<T> m((wo.x + wi.x) * inverse_h, (wo.y + wi.y) * inverse_h, T(0));
    const auto change = [&](const Vec3<T>& along) {
        const Vec3<T> turn = (along - dot(along, wi) * wi) * inverse_d;
        return Vec3<T>(turn.x - m.x * turn.z, turn.y - m.y * turn.z, T(0)) * (per_alpha * inverse_h);
    };
    return fit_of(m * per_alpha, change(light.half_u), change(light.half_v));
}

/// Of the diffuse lobe: offsets in the light's plane in distances from it.
template <class T>
AreaFit<T> fit_diffuse(const AreaView<T>& light, const Vec2<T>& at) {
    const T height = dot(light.center, light.normal);
    const T size2 = dot(light.half_u, light.half_u) + dot(light.half_v, light.half_v);
    const T per_height = inverse_sqrt(max(sqr(height), T(1e-6f) * size2));
    const Vec3<T> offset = light.center + at.x * light.half_u + at.y * light.half_v - height * light.normal;
    return fit_of(offset * per_height, light.half_u * per_height, light.half_v * per_height);
}

/// One coordinate's warp: q = z / (1 + sqrt(1 + z^2)), z = (x - center) / scale, over the q of a span of x that holds
/// the centre.
template <class T>
struct AreaWarp {
    T center, scale, q_low, q_width;

    static T to_q(T z) { return z * inverse(T(1) + sqrt(T(1) + z * z)); }

    AreaWarp() = default;
    AreaWarp(T center_, T scale_, const AreaSpan<T>& span) : center(center_), scale(scale_) {
        const T per_scale = inverse(scale);
        q_low = to_q((span.low - center) * per_scale);
        q_width = max(to_q((span.high - center) * per_scale) - q_low, tiny<T>);
    }
    struct Place {
        T x, width;  ///< width: of all numbers, if x moved everywhere as it does here
    };
    Place place(T unit) const {
        const T q = q_low + unit * q_width, q2 = q * q, stretch = inverse(max(T(1) - q2, T(1e-6f)));
        return {center + scale * T(2) * q * stretch, scale * q_width * T(2) * (T(1) + q2) * sqr(stretch)};
    }
    T unit(T x) const { return min(max((to_q((x - center) * inverse(scale)) - q_low) * inverse(q_width), T(0)), T(1)); }
};

/// About the share of an ellipse's area on one side of x, from -1 to 1: in it strips of the ellipse are even, where in
/// x they end with the slope of a root, which few nodes cannot follow. With w^2 = 1 - |x| the share beyond is w^3 (s0 +
/// s1 w^2 + s2 w^4), exact at both ends, in value and in slope.
template <class T>
struct EllipseStrip {
    static constexpr float s0 = 1.20042f, s1 = -0.17414f, s2 = -0.02628f;
    T x, width;  ///< width: dx by the share

    /// At x.
    static T share(T x) {
        const T w2 = max(T(1) - abs(x), T(0));
        const T from_middle = T(1) - w2 * sqrt(w2) * (T(s0) + w2 * (T(s1) + w2 * T(s2)));
        return select(x < T(0), -from_middle, from_middle);
    }
    /// At a share.
    explicit EllipseStrip(T share) {
        const T beyond = max(T(1) - abs(share), T(0)), root = cbrt(beyond);
        const auto slope = [](T w2) { return T(3 * s0) + w2 * (T(5 * s1) + w2 * T(7 * s2)); };
        T w = max(root * (T(0.94093f) + root * root * (T(0.03749f) + root * root * T(0.02073f))), T(1e-3f)),
          w2 = sqr(w);
        w -= (w * w2 * (T(s0) + w2 * (T(s1) + w2 * T(s2))) - beyond) * inverse(w2 * slope(w2));
        w = max(w, T(1e-3f)), w2 = sqr(w);
        x = select(share < T(0), w2 - T(1), T(1) - w2);
        width = T(2) * inverse(w * slope(w2));
    }
};

/// A density over [0, 1], linear between n even nodes; its integral is 1.
template <class T, std::size_t n>
struct LinearNodes {
    std::array<T, n> value;

    /// How much of each node a number has.
    static std::array<T, n> weights(T unit) {
        const T at = unit * T(static_cast<float>(n - 1));
        std::array<T, n> result;
        for (std::size_t i = 0; i < n; ++i) result[i] = max(T(1) - abs(at - T(static_cast<float>(i))), T(0));
        return result;
    }
    T sample(T u) const {
        constexpr float pieces = n - 1;
        T low = value[0], high = value[1], left = u * T(2 * pieces), first(0);
        T sum = low + high;  // twice what the piece holds
        const T all = left;
        for (std::size_t i = 1; i + 1 < n; ++i) {
            const T piece = value[i] + value[i + 1];
            const auto beyond = all >= sum;
            first = select(beyond, T(static_cast<float>(i)), first);
            low = select(beyond, value[i], low);
            high = select(beyond, value[i + 1], high);
            left = select(beyond, all - sum, left);
            sum += piece;
        }
        // low t + (high - low) t^2 / 2 = left / 2
        const T root = sqrt(max(low * low + (high - low) * left, T(0)));
        return (first + min(left * inverse(low + root), T(1))) * T(1 / pieces);
    }
};

/// One lobe's n x n nodes.
template <class T, std::size_t n>
struct AreaGrid {
    T x_center, x_scale;
    AreaWarp<T> x_warp;  ///< of x, or of an ellipse's share of strips
    T y_center, shear, y_scale;
    std::array<LinearNodes<T, n>, n> column;  ///< density over the unit square, by y at each node of x
    LinearNodes<T, n> marginal;               ///< of x
    T integral;                               ///< of what the nodes were filled by

    AreaGrid() = default;
    AreaGrid(const AreaView<T>& light, const AreaSpan<T>& x_span, const Vec2<T>& center, const AreaFit<T>& fit) {
        // What spreads less evenly than this leaves the tails to the few nodes that they have.
        constexpr float narrower = 0.7f;
        const T tail = T(narrower) * sqrt(T(1) + fit.mm), per_v = inverse_sqrt(fit.vv);
        x_center = center.x;
        x_scale = tail * inverse_sqrt(fit.across());
        y_center = center.y;
        shear = -fit.uv * sqr(per_v);
        y_scale = tail * per_v;
        AreaSpan<T> span = x_span;
        T warp_center = x_center, warp_scale = x_scale;
        if (any(light.ellipse)) {
            // As wide as the strip of that width towards the middle.
            const T share = EllipseStrip<T>::share(x_center), step = min(x_scale, T(1));
            const T beside = x_center + select(x_center > T(0), -step, step);
            const T width = abs(EllipseStrip<T>::share(beside) - share) * x_scale * inverse(step);
            warp_center = select(light.ellipse, share, warp_center);
            warp_scale = select(light.ellipse, width, warp_scale);
            span.low = select(light.ellipse, EllipseStrip<T>::share(span.low), span.low);
            span.high = select(light.ellipse, EllipseStrip<T>::share(span.high), span.high);
        }
        x_warp = AreaWarp<T>(warp_center, warp_scale, span);
    }

    typename AreaWarp<T>::Place x_place(const AreaView<T>& light, T unit) const {
        const auto place = x_warp.place(unit);
        if (!any(light.ellipse)) return place;
        const EllipseStrip<T> strip(place.x);
        return {select(light.ellipse, strip.x, place.x), select(light.ellipse, strip.width * place.width, place.width)};
    }
    T x_unit(const AreaView<T>& light, T x) const {
        return x_warp.unit(any(light.ellipse) ? select(light.ellipse, EllipseStrip<T>::share(x), x) : x);
    }
    AreaWarp<T> y_warp(const AreaView<T>& light, T x) const {
        const AreaSpan<T> span = y_above(light, x);
        const T z = (x - x_center) * inverse(x_scale);
        const T wanted = y_center + shear * (x - x_center);
        const T center = span.nearest(wanted), off = (wanted - center) * inverse(y_scale);
        return AreaWarp<T>(center, y_scale * sqrt(T(1) + z * z + off * off), span);
    }

    /// Fills the nodes by value(wi), the integrand by solid angle.
    template <class Value>
    void fill(const AreaView<T>& light, const Value& value) {
        // Each node also has this share of the mean: what looks dark from the nodes is not.
        constexpr float even_share = 0.05f;
        constexpr float pieces = n - 1;
        // The outer ones a little inside: an ellipse's strip has no width at its ends.
        const auto node_at = [](std::size_t i) {
            return T(std::min(std::max(static_cast<float>(i) / pieces, 1e-3f), 1.0f - 1e-3f));
        };
        const auto ends = [](std::size_t i) { return T(i == 0 || i + 1 == n ? 0.5f : 1.0f); };
        const T plane_m = -dot(light.center, light.normal) * light.parallelogram_m2;  // solid angle is that by d^3
        integral = T(0);
        for (std::size_t i = 0; i < n; ++i) {
            const auto [x, width] = x_place(light, node_at(i));
            const AreaWarp<T> warp = y_warp(light, x);
            const Vec3<T> from = light.center + x * light.half_u;
            const T volume = plane_m * width;
            T sum(0);
            for (std::size_t j = 0; j < n; ++j) {
                const auto [y, height] = warp.place(node_at(j));
                const Vec3<T> d = from + y * light.half_v;
                const T per_distance = inverse_sqrt(max(dot(d, d), tiny<T>));
                T& node = column[i].value[j];
                node = value(d * per_distance) * (height * per_distance) * (volume * sqr(per_distance));
                sum += ends(j) * node;
            }
            marginal.value[i] = sum * T(1 / pieces);
            integral += ends(i) * marginal.value[i];
        }
        integral *= T(1 / pieces);
        const auto lit = integral > tiny<T>;
        const T scale = select(lit, T(1.0f / (1.0f + even_share)) * inverse(max(integral, tiny<T>)), T(0));
        const T even = select(lit, T(even_share / (1.0f + even_share)), T(1));
        for (std::size_t i = 0; i < n; ++i) {
            marginal.value[i] = marginal.value[i] * scale + even;
            for (T& node : column[i].value) node = node * scale + even;
        }
    }

    /// Nodes along y where x is that much of its nodes.
    LinearNodes<T, n> row_at(const std::array<T, n>& of_x) const {
        LinearNodes<T, n> row;
        for (std::size_t j = 0; j < n; ++j) {
            row.value[j] = of_x[0] * column[0].value[j];
            for (std::size_t i = 1; i < n; ++i) row.value[j] += of_x[i] * column[i].value[j];
        }
        return row;
    }

    static T dot_of(const std::array<T, n>& a, const std::array<T, n>& b) {
        T sum = a[0] * b[0];
        for (std::size_t i = 1; i < n; ++i) sum += a[i] * b[i];
        return sum;
    }

    AreaSample<T> sample(const AreaView<T>& light, const Vec2<T>& u) const {
        const T unit_x = marginal.sample(u.x);
        const auto [x, width] = x_place(light, unit_x);
        const auto of_x = LinearNodes<T, n>::weights(unit_x);
        LinearNodes<T, n> row = row_at(of_x);
        const T in_all = dot_of(of_x, marginal.value), per_all = inverse(in_all);
        for (T& node : row.value) node *= per_all;
        const T unit_y = row.sample(u.y);
        const auto [y, height] = y_warp(light, x).place(unit_y);
        const T density = in_all * dot_of(LinearNodes<T, n>::weights(unit_y), row.value);
        return {{x, y}, density * inverse(width * height)};
    }

    /// By x and y.
    T pdf(const AreaView<T>& light, const Vec2<T>& at) const {
        const AreaWarp<T> warp = y_warp(light, at.x);
        const T unit_x = x_unit(light, at.x), unit_y = warp.unit(at.y);
        const LinearNodes<T, n> row = row_at(LinearNodes<T, n>::weights(unit_x));
        return dot_of(LinearNodes<T, n>::weights(unit_y), row.value) *
               inverse(x_place(light, unit_x).width * warp.place(unit_y).width);
    }
};

}  // namespace detail

}  // namespace pivot
