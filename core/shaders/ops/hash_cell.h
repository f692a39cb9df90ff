// The hashes that Voronoi textures have taken: of the bits of a cell's corner, or from Blender 5.0 of its whole
// numbers.
#pragma once

#include "core/shaders/ops/hash.h"

namespace pivot {

enum class CellHash { of_bits, of_numbers };

namespace detail {

/// [0, 1]^n of whole numbers. [Jarzynski20] Mark Jarzynski and Marc Olano, "Hash Functions for GPU Rendering", JCGT
/// 9(3), 2020: pcg2d, pcg3d and pcg4d, in the form of Cycles 5.0 util/hash.h 39-80.
template <std::size_t n>
Point<n> random_of_numbers(const Point<n>& at) {
    const IndexBatch factor(1664525), increment(1013904223);
    std::array<IndexBatch, n> v;
    for (std::size_t i = 0; i < n; ++i) v[i] = to_index(at.x[i]) * factor + increment;
    const auto stir = [&] {
        if constexpr (n == 2) {
            v[0] += v[1] * factor;
            v[1] += v[0] * factor;
        }
        if constexpr (n == 3) {
            v[0] += v[1] * v[2];
            v[1] += v[2] * v[0];
            v[2] += v[0] * v[1];
        }
        if constexpr (n == 4) {
            v[0] += v[1] * v[3];
            v[1] += v[2] * v[0];
            v[2] += v[0] * v[1];
            v[3] += v[1] * v[2];
        }
    };
    stir();
    for (IndexBatch& word : v) word ^= word >> 16;
    stir();
    return make_point<n>(
        [&](std::size_t i) { return xsimd::to_float(v[i] & IndexBatch(0x7fffffff)) * Batch(1.0f / 2147483648.0f); });
}

}  // namespace detail

/// In the unit cube: where the point of a cell is.
template <std::size_t n>
Point<n> cell_point(const Point<n>& cell, CellHash hash) {
    if (n == 1 || hash == CellHash::of_bits) return random_point(cell);
    return detail::random_of_numbers(cell);
}

template <std::size_t n>
Vec3b cell_color(const Point<n>& cell, CellHash hash) {
    if (n == 1 || hash == CellHash::of_bits) return random_color(cell);
    if constexpr (n <= 3) {
        const Point<3> color =
            detail::random_of_numbers<3>({{cell.x[0], cell.x[n > 1 ? 1 : 0], n > 2 ? cell.x[n - 1] : Batch(0.0f)}});
        return {color.x[0], color.x[1], color.x[2]};
    } else {
        const Point<4> color = detail::random_of_numbers(cell);
        return {color.x[0], color.x[1], color.x[2]};
    }
}

}  // namespace pivot
