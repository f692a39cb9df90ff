// Samples of an area light in proportion to what a surface reflects of its parts. Each lobe has a grid of cells on the
// light, chosen by the integrand at their centres; the grid is fit to the lobe, so few cells do. Shading frame about
// the lit point, over float or SIMD batches.
//
// The GGX lobe is Student's t distribution of half-vector slopes, (1 + |m|^2 / alpha^2)^-2. Where the light comes
// nearest to the mirrored view its slopes are linear in the place (x, y) on the light, so the lobe is such a
// distribution there too: of x with a closed marginal, of y given x about a sheared centre. Both are warped by the
// inverse of 1D Student's t, z / sqrt(1 + z^2), and cells are even in the warped numbers. For the diffuse lobe the warp
// is even. u.x and u.y move the sample monotonously along x and y: stratification lasts.
//
// Tried on three lights over glossy spheres, relMSE at 64 samples x CPU, the smaller the better: 3 x 3 cells 1, 2 x
// 2 1.0 (but they weigh less evenly), 4 x 4 1.13; eight patches cut in eight again, chosen by ggx_cap, 4.2; five levels
// of them 6.7 (relMSE 1.4, for u jumps between patches).
#pragma once

#include <array>

#include "core/bsdf/surface.h"
#include "core/geometry/surface_point.h"
#include "core/integrators/joint_sampling.h"
#include "core/lights/light.h"

namespace pivot {

/// An area light from a lit point: places are center + x half_u + y half_v.
template <class T>
struct AreaView {
    Vec3<T> center, half_u, half_v;
    Vec3<T> normal;      ///< of the side towards the point, if that shines
    T parallelogram_m2;  ///< |half_u x half_v|
    Mask<T> ellipse, triangle;
};

/// Whether samples by area would vary without bound, so that BSDF samples must share: near the light, and at grazing
/// views, where slopes are far from linear in the place. And always of a mesh's triangles: their choice among many
/// knows less of the lobe than the lobe does.
template <class T>
Mask<T> needs_bsdf_samples(const AreaView<T>& light, const Vec3<T>& wo_local) {
    const T reach_m = T(1.2f) * (length(light.half_u) + length(light.half_v));
    return light.triangle || length_squared(light.center) < sqr(reach_m) || wo_local.z < T(0.05f);
}

AreaView<float> view_from(const AreaLight& light, const SurfacePoint& point);

/// A place on the light as the lit point sees it.
template <class T>
struct SeenPlace {
    Vec3<T> wi;
    T distance_m;
    T omega_per_xy;  ///< solid angle by (x, y)
};
template <class T>
SeenPlace<T> see(const AreaView<T>& light, const Vec2<T>& place) {
    const Vec3<T> d = light.center + place.x * light.half_u + place.y * light.half_v;
    const T distance2 = dot(d, d), per_distance = inverse_sqrt(max(distance2, tiny<T>));
    const Vec3<T> wi = d * per_distance;
    return {wi, distance2 * per_distance,
            max(-dot(wi, light.normal), T(0)) * sqr(per_distance) * light.parallelogram_m2};
}

namespace detail {

inline constexpr std::size_t area_columns = 3, area_rows = 3;
/// Of each choice among cells this share is even: it bounds what a cell that looks dark at its centre can weigh.
inline constexpr float area_even_share = 0.1f;

/// One coordinate's warp: t = z / sqrt(1 + z^2), z = (x - center) / scale, over the t of an interval of x.
template <class T>
struct AreaWarp {
    T center, scale, t_low, t_width;

    static T to_t(T z) { return z * inverse_sqrt(T(1) + z * z); }

    AreaWarp() = default;
    AreaWarp(T center_, T scale_, T half_width) : center(center_), scale(scale_) {
        const T per_scale = inverse(scale);
        t_low = to_t((-half_width - center) * per_scale);
        t_width = max(to_t((half_width - center) * per_scale) - t_low, tiny<T>);
    }
    struct Place {
        T x, width;  ///< width: of all numbers, if x moved everywhere as it does here
    };
    Place place(T unit) const {
        const T t = t_low + unit * t_width, stretch = inverse_sqrt(max(T(1) - t * t, T(1e-12f)));
        return {center + scale * t * stretch, scale * t_width * stretch * sqr(stretch)};
    }
    T unit(T x) const { return (to_t((x - center) / scale) - t_low) / t_width; }
    /// Density of place(uniform): 1 / width there.
    T pdf(T x) const {
        const T z = (x - center) / scale, s = T(1) / (T(1) + z * z);
        return s * sqrt(s) / (scale * t_width);
    }
};

/// Which of the equal parts of [0, 1) a number lies in.
template <std::size_t n, class T>
T part_of(T unit) {
    return min(max(floor(unit * T(static_cast<float>(n))), T(0)), T(static_cast<float>(n - 1)));
}

template <class T, std::size_t n>
T at_index(const std::array<T, n>& values, T index) {
    T value = values[0];
    for (std::size_t i = 1; i < n; ++i) value = select(index >= T(static_cast<float>(i)), values[i], value);
    return value;
}

/// Takes one of the parts by their probabilities: its index, and what is left of u within it.
template <class T, std::size_t n>
T choose_part(const std::array<T, n>& probability, T& u) {
    T index(0), low(0), chosen = probability[0], sum = probability[0];
    for (std::size_t i = 1; i < n; ++i) {
        const auto beyond = u >= sum;
        index = select(beyond, T(static_cast<float>(i)), index);
        low = select(beyond, sum, low);
        chosen = select(beyond, probability[i], chosen);
        sum += probability[i];
    }
    u = min(max((u - low) / chosen, T(0)), T(1.0f - 0x1p-24f));
    return index;
}

/// How far the light reaches along half_v at x.
template <class T>
T half_height(const AreaView<T>& light, T x) {
    return select(light.ellipse, sqrt(max(T(1) - x * x, T(1e-6f))), T(1));
}

/// One lobe's cells.
template <class T>
struct AreaGrid {
    AreaWarp<T> x_warp;
    T y_center, shear, y_scale;
    std::array<T, area_columns> column;                      ///< probability
    std::array<std::array<T, area_columns>, area_rows> row;  ///< probability within each column
    T integral;                                              ///< of what the cells were chosen by

    AreaWarp<T> y_warp(const AreaView<T>& light, T x) const {
        const T height = half_height(light, x), z = (x - x_warp.center) * inverse(x_warp.scale);
        const T wanted = y_center + shear * (x - x_warp.center);
        const T center = max(min(wanted, height), -height), off = (wanted - center) * inverse(y_scale);
        return AreaWarp<T>(center, y_scale * sqrt(T(1) + z * z + off * off), height);
    }

    /// Fills the cells by value(x, y, dx, dy), the integrand by (x, y) in a cell of that size.
    template <class Value>
    void fill(const AreaView<T>& light, const Value& value) {
        constexpr float columns = area_columns, rows = area_rows;
        std::array<T, area_columns> sums;
        integral = T(0);
        for (std::size_t i = 0; i < area_columns; ++i) {
            const auto [x, width] = x_warp.place(T((static_cast<float>(i) + 0.5f) / columns));
            const AreaWarp<T> warp = y_warp(light, x);
            const T dx = width * T(1 / columns);
            sums[i] = T(0);
            for (std::size_t j = 0; j < area_rows; ++j) {
                const auto [y, height] = warp.place(T((static_cast<float>(j) + 0.5f) / rows));
                const T dy = height * T(1 / rows);
                row[j][i] = value(x, y, dx, dy) * dx * dy;
                sums[i] += row[j][i];
            }
            const auto lit = sums[i] > tiny<T>;
            const T scale = select(lit, T(1.0f - area_even_share) * inverse(max(sums[i], tiny<T>)), T(0));
            const T even = select(lit, T(area_even_share / rows), T(1 / rows));
            for (std::size_t j = 0; j < area_rows; ++j) row[j][i] = row[j][i] * scale + even;
            integral += sums[i];
        }
        const auto lit = integral > tiny<T>;
        const T scale = select(lit, T(1.0f - area_even_share) / max(integral, tiny<T>), T(0));
        const T even = select(lit, T(area_even_share / columns), T(1 / columns));
        for (std::size_t i = 0; i < area_columns; ++i) column[i] = sums[i] * scale + even;
    }

    Vec2<T> sample(const AreaView<T>& light, Vec2<T> u) const {
        const T i = choose_part(column, u.x);
        std::array<T, area_rows> rows;
        for (std::size_t k = 0; k < area_rows; ++k) rows[k] = at_index(row[k], i);
        const T x = x_warp.place((i + u.x) * T(1.0f / area_columns)).x;
        const T j = choose_part(rows, u.y);
        return {x, y_warp(light, x).place((j + u.y) * T(1.0f / area_rows)).x};
    }

    /// By x and y.
    T pdf(const AreaView<T>& light, const Vec2<T>& at) const {
        const AreaWarp<T> warp = y_warp(light, at.x);
        const T i = part_of<area_columns>(x_warp.unit(at.x)), j = part_of<area_rows>(warp.unit(at.y));
        std::array<T, area_rows> rows;
        for (std::size_t k = 0; k < area_rows; ++k) rows[k] = at_index(row[k], i);
        return T(static_cast<float>(area_columns * area_rows)) * at_index(column, i) * at_index(rows, j) *
               x_warp.pdf(at.x) * warp.pdf(at.y);
    }
};

/// Where the lobe lies on the light.
template <class T>
AreaGrid<T> fit_grid(const AreaView<T>& light, const Vec3<T>& wo, T alpha) {
    AreaGrid<T> grid;
    // The light's place nearest to where the mirrored view meets its plane.
    const Vec3<T> mirrored(-wo.x, -wo.y, wo.z);
    const T towards = max(-dot(mirrored, light.normal), T(1e-4f));
    const Vec3<T> offset = mirrored * (-dot(light.center, light.normal) / towards) - light.center;
    const Vec3<T> across_u = cross(light.half_v, light.normal), across_v = cross(light.normal, light.half_u);
    const T per_m2 = inverse(light.parallelogram_m2);
    T x = min(max(dot(offset, across_u) * per_m2, T(-1)), T(1));
    const T height = half_height(light, x);
    T y = min(max(dot(offset, across_v) * per_m2, -height), height);
    // Below the horizon there is no lobe to fit: go towards the light's highest place.
    const T rise_u = light.half_u.z, rise_v = light.half_v.z;
    const T shrink = select(light.ellipse, inverse_sqrt(max(rise_u * rise_u + rise_v * rise_v, tiny<T>)), T(0));
    const T end_x = select(rise_u < T(0), T(-1), T(1)), end_y = select(rise_v < T(0), T(-1), T(1));
    const T top_x = select(light.ellipse, rise_u * shrink, end_x);
    const T top_y = select(light.ellipse, rise_v * shrink, end_y);
    const T top_z = light.center.z + top_x * rise_u + top_y * rise_v;
    const T z = light.center.z + x * rise_u + y * rise_v, fall = max(top_z - z, tiny<T>);
    const T kept = select(z < T(0.05) * top_z, min(max(T(0.95) * top_z / fall, T(0)), T(1)), T(1));
    x = top_x + kept * (x - top_x);
    y = top_y + kept * (y - top_y);

    // Slopes there, in alphas, and how they change with x and y.
    const Vec3<T> d = light.center + x * light.half_u + y * light.half_v;
    const T inverse_d = inverse_sqrt(max(dot(d, d), tiny<T>));
    const Vec3<T> wi = d * inverse_d;
    const T h_z = max(wo.z + wi.z, T(1e-3f)), inverse_h = inverse(h_z);
    const Vec2<T> m((wo.x + wi.x) * inverse_h, (wo.y + wi.y) * inverse_h);
    const T per_alpha = inverse(alpha);
    const auto slope_change = [&](const Vec3<T>& along) {
        const Vec3<T> turn = (along - dot(along, wi) * wi) * inverse_d;
        return Vec2<T>((turn.x - m.x * turn.z) * inverse_h * per_alpha,
                       (turn.y - m.y * turn.z) * inverse_h * per_alpha);
    };
    const Vec2<T> m_u = slope_change(light.half_u), m_v = slope_change(light.half_v);
    const T tail = sqrt(T(1) + dot(m, m) * per_alpha * per_alpha);
    const T vv = max(dot(m_v, m_v), T(1e-6f)), uv = dot(m_u, m_v);
    const T shear = -uv * inverse(vv), uu = max(dot(m_u, m_u) + uv * shear, T(1e-6f));  // of x whatever y
    grid.x_warp = AreaWarp<T>(x, tail * inverse_sqrt(uu), T(1));
    grid.y_center = y;
    grid.shear = shear;
    grid.y_scale = tail * inverse_sqrt(vv);
    return grid;
}

}  // namespace detail

/// Joint samples of a rectangle or an ellipse that shines on the lit point, dot(center, normal) < 0.
template <class T>
class AreaSampler {
   public:
    AreaSampler(const JointSurface<T>& surface, const AreaView<T>& light) : surface_(surface), light_(light) {
        const Mask<T> has_diffuse = surface.diffuse > T(0);
        const Mask<T> has_glossy = surface.fresnel_f0 + surface.fresnel_f90 > T(0);
        uses_diffuse_ = any(!has_glossy || has_diffuse);
        uses_glossy_ = any(has_glossy);
        T diffuse(0), glossy(0);
        if (uses_diffuse_) {
            diffuse_.x_warp = detail::AreaWarp<T>(T(0), T(1e3f), T(1));
            diffuse_.y_center = diffuse_.shear = T(0);
            diffuse_.y_scale = T(1e3f);
            diffuse_.fill(light, [&](T x, T y, T dx, T dy) {
                const SeenPlace<T> seen = see(light, Vec2<T>(x, y));
                return cosine_of_cell(seen, dx, dy) * seen.omega_per_xy;
            });
            diffuse = surface.diffuse * diffuse_.integral * T(1.0f / pi<float>);
        }
        if (uses_glossy_) {
            glossy_ = detail::fit_grid(light, surface.wo_local, surface.alpha);
            const T alpha2 = surface.alpha * surface.alpha;
            glossy_.fill(light, [&](T x, T y, T dx, T dy) {
                const SeenPlace<T> seen = see(light, Vec2<T>(x, y));
                const Vec3<T> h = surface.wo_local + seen.wi;
                const T h2 = dot(h, h), slope = h.x * h.x + h.y * h.y + alpha2 * h.z * h.z;
                const T cos_i = cosine_of_cell(seen, dx, dy);
                const T masking = cos_i * inverse(cos_i + sqrt(alpha2 + (T(1) - alpha2) * cos_i * cos_i));
                return sqr(h2 * inverse(slope)) * masking * seen.omega_per_xy;
            });
            const T fresnel = lerp(surface.fresnel_f0, surface.fresnel_f90, schlick_weight(surface.wo_local.z));
            glossy = fresnel * glossy_.integral * alpha2 * ggx_g1(surface.wo_local, surface.alpha, surface.alpha) /
                     (T(2.0f * pi<float>) * surface.wo_local.z);
        }
        const T share = glossy / max(diffuse + glossy, tiny<T>);
        const T both = max(min(share, T(1.0f - min_lobe_probability)), T(min_lobe_probability));
        glossy_probability_ = select(has_glossy, select(has_diffuse, both, T(1)), T(0));
    }

    const AreaView<T>& light() const { return light_; }

    /// (x, y) of a place on the light. u.x also chooses the lobe.
    Vec2<T> sample(const Vec2<T>& u) const {
        if (!uses_glossy_) return diffuse_.sample(light_, u);
        if (!uses_diffuse_) return glossy_.sample(light_, u);
        const Mask<T> is_glossy = u.x < glossy_probability_;
        const T u_x = select(is_glossy, u.x / max(glossy_probability_, tiny<T>),
                             (u.x - glossy_probability_) / max(T(1) - glossy_probability_, tiny<T>));
        const Vec2<T> glossy = glossy_.sample(light_, {u_x, u.y}), diffuse = diffuse_.sample(light_, {u_x, u.y});
        return {select(is_glossy, glossy.x, diffuse.x), select(is_glossy, glossy.y, diffuse.y)};
    }

    /// Density of sample() by (x, y).
    T pdf(const Vec2<T>& at) const {
        const T diffuse = uses_diffuse_ ? diffuse_.pdf(light_, at) : T(0);
        return uses_glossy_ ? lerp(diffuse, glossy_.pdf(light_, at), glossy_probability_) : diffuse;
    }

   private:
    /// At its centre, or of what of a cell is above the horizon that its centre is below.
    T cosine_of_cell(const SeenPlace<T>& seen, T dx, T dy) const {
        const T rise =
            T(0.5) * (dx * abs(light_.half_u.z) + dy * abs(light_.half_v.z)) * inverse(max(seen.distance_m, tiny<T>));
        return max(max(seen.wi.z, T(0.25) * (seen.wi.z + rise)), T(0));
    }

    JointSurface<T> surface_;
    AreaView<T> light_;
    detail::AreaGrid<T> diffuse_, glossy_;
    T glossy_probability_;
    bool uses_diffuse_, uses_glossy_;
};

}  // namespace pivot
