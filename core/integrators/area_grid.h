// A density over an area light that is fit to one lobe: nodes on what of the light is above the horizon, bilinear
// between. area_sampling.h says why so. Over float or SIMD batches.
#pragma once

#include <array>

#include "core/integrators/area_map.h"

namespace pivot {

/// A place and its density by (x, y).
template <class T>
struct AreaSample {
    Vec2<T> place;
    T pdf;
};

namespace detail {

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

/// One lobe's nodes, `rows` at each of `columns` numbers of x.
template <class T, std::size_t columns, std::size_t rows>
struct AreaGrid {
    AreaMap<T> map;
    std::array<LinearNodes<T, rows>, columns> column;  ///< density over the unit square, by y at each node of x
    LinearNodes<T, columns> marginal;                  ///< of x
    T integral;                                        ///< of what the nodes were filled by

    /// Fills the nodes by value(wi), the integrand by solid angle.
    template <class Value>
    void fill(const AreaView<T>& light, const Value& value) {
        // Each node also has this share of the mean: what looks dark from the nodes is not.
        constexpr float even_share = 0.05f;
        constexpr float per_piece_x = 1.0f / (columns - 1), per_piece_y = 1.0f / (rows - 1);
        // The outer ones a little inside: an ellipse's strip has no width at its ends.
        const auto node_at = [](float unit) { return T(std::min(std::max(unit, 1e-3f), 1.0f - 1e-3f)); };
        const auto share_of = [](std::size_t i, std::size_t count) {
            return T(i == 0 || i + 1 == count ? 0.5f : 1.0f);
        };
        const T plane_m = -dot(light.center, light.normal) * light.parallelogram_m2;  // solid angle is that by d^3
        integral = T(0);
        for (std::size_t i = 0; i < columns; ++i) {
            const auto [x, width] = map.x_place(light, node_at(static_cast<float>(i) * per_piece_x));
            const AreaWarp<T> warp = map.y_warp(light, x);
            const Vec3<T> from = light.center + x * light.half_u;
            const T volume = plane_m * width;
            T sum(0);
            for (std::size_t j = 0; j < rows; ++j) {
                const auto [y, height] = warp.place(node_at(static_cast<float>(j) * per_piece_y));
                const Vec3<T> d = from + y * light.half_v;
                const T per_distance = inverse_sqrt(max(dot(d, d), tiny<T>));
                T& node = column[i].value[j];
                node = value(d * per_distance) * (height * per_distance) * (volume * sqr(per_distance));
                sum += share_of(j, rows) * node;
            }
            marginal.value[i] = sum * T(per_piece_y);
            integral += share_of(i, columns) * marginal.value[i];
        }
        integral *= T(per_piece_x);
        const auto lit = integral > tiny<T>;
        const T scale = select(lit, T(1.0f / (1.0f + even_share)) * inverse(max(integral, tiny<T>)), T(0));
        const T even = select(lit, T(even_share / (1.0f + even_share)), T(1));
        for (std::size_t i = 0; i < columns; ++i) {
            marginal.value[i] = marginal.value[i] * scale + even;
            for (T& node : column[i].value) node = node * scale + even;
        }
    }

    /// Nodes along y where x is that much of its nodes.
    LinearNodes<T, rows> row_at(const std::array<T, columns>& of_x) const {
        LinearNodes<T, rows> row;
        for (std::size_t j = 0; j < rows; ++j) {
            row.value[j] = of_x[0] * column[0].value[j];
            for (std::size_t i = 1; i < columns; ++i) row.value[j] += of_x[i] * column[i].value[j];
        }
        return row;
    }

    template <std::size_t n>
    static T dot_of(const std::array<T, n>& a, const std::array<T, n>& b) {
        T sum = a[0] * b[0];
        for (std::size_t i = 1; i < n; ++i) sum += a[i] * b[i];
        return sum;
    }

    AreaSample<T> sample(const AreaView<T>& light, const Vec2<T>& u) const {
        const T unit_x = marginal.sample(u.x);
        const auto [x, width] = map.x_place(light, unit_x);
        const auto of_x = LinearNodes<T, columns>::weights(unit_x);
        LinearNodes<T, rows> row = row_at(of_x);
        const T in_all = dot_of(of_x, marginal.value), per_all = inverse(in_all);
        for (T& node : row.value) node *= per_all;
        const T unit_y = row.sample(u.y);
        const auto [y, height] = map.y_warp(light, x).place(unit_y);
        const T density = in_all * dot_of(LinearNodes<T, rows>::weights(unit_y), row.value);
        return {{x, y}, density * inverse(width * height)};
    }

    /// By x and y.
    T pdf(const AreaView<T>& light, const Vec2<T>& at) const {
        const AreaWarp<T> warp = map.y_warp(light, at.x);
        const T unit_x = map.x_unit(light, at.x), unit_y = warp.unit(at.y);
        const LinearNodes<T, rows> row = row_at(LinearNodes<T, columns>::weights(unit_x));
        return dot_of(LinearNodes<T, rows>::weights(unit_y), row.value) *
               inverse(map.x_place(light, unit_x).width * warp.place(unit_y).width);
    }
};

}  // namespace detail

}  // namespace pivot
