// What of an area light is above the horizon, as a unit square that is stretched to fit a lobe: nodes that are even in
// it follow the lobe. area_sampling.h says why so. Over float or SIMD batches.
#pragma once

#include <algorithm>

#include "core/integrators/area_view.h"

namespace pivot {

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

/// The place of the light that is nearest to an offset from its centre in its plane, above the horizon.
template <class T>
Vec2<T> nearest_place(const AreaView<T>& light, const AreaSpan<T>& x_span, const Vec3<T>& offset) {
    const Vec3<T> area = cross(light.half_u, light.half_v);
    const T per_area2 = inverse(max(dot(area, area), tiny<T>));
    const T x = x_span.nearest(dot(offset, cross(light.half_v, area)) * per_area2);
    return {x, y_above(light, x).nearest(dot(offset, cross(area, light.half_u)) * per_area2)};
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

/// The unit square on what of the light is above the horizon, stretched as a lobe is: under it the lobe is about even.
template <class T>
struct AreaMap {
    T x_center, x_scale;
    AreaWarp<T> x_warp;  ///< of x, or of an ellipse's share of strips
    T y_center, shear, y_scale;

    AreaMap() = default;
    AreaMap(const AreaView<T>& light, const AreaSpan<T>& x_span, const Vec2<T>& center, const AreaFit<T>& fit) {
        // What spreads less evenly than this leaves the tails to the few nodes that they have.
        constexpr float narrower = 0.7f;
        const T tail = T(narrower) * sqrt(T(1) + fit.mm), per_v = inverse_sqrt(fit.vv);
        x_center = center.x;
        x_scale = tail * inverse_sqrt(fit.across());
        y_center = center.y;
        shear = -fit.uv * sqr(per_v);
        y_scale = tail * per_v;
        AreaSpan<T> span = x_span;
        // Where the lobe's ridge, y_center + shear (x - x_center), leaves the light's sides y, little is left of it: as
        // the product of two Gaussians has them, the lobe's along x and one of what the ridge has of the light.
        const AreaSpan<T> sides = y_above(light, x_center);
        const T half_height = T(0.5f) * (sides.high - sides.low);
        const T ridge2 = sqr(shear * x_scale), sides2 = sqr(half_height) + sqr(y_scale);
        const T per_sum = inverse(ridge2 + sides2);
        const T to_middle = T(0.5f) * (sides.high + sides.low) - y_center;
        T warp_center = x_span.nearest(x_center + to_middle * shear * sqr(x_scale) * per_sum);
        T warp_scale = x_scale * sqrt(sides2 * per_sum);
        if (any(light.ellipse)) {
            // As wide as the strip of that width towards the middle. Not moved: near its ends few bits tell strips
            // apart.
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
};

}  // namespace detail

}  // namespace pivot
