// The axes that tables share: where a value lies on [0, 1], the value at a place on it, and linear interpolation
// between nodes.
#pragma once

#include "core/math/number.h"

namespace pivot {

/// GGX alpha from 1e-3 to 1, even in its square root, the artist's roughness.
inline constexpr float table_min_roughness = 0.031622777f;

inline float alpha_coordinate(float alpha) {
    return clamp01((sqrt(alpha) - table_min_roughness) / (1.f - table_min_roughness));
}
inline float alpha_at(float coordinate) { return sqr(lerp(table_min_roughness, 1.f, coordinate)); }

/// Cosine to the normal, even in its square root: the dip in albedo at cos ~ alpha spans nodes at any roughness.
inline float cos_coordinate(float cos_theta) { return sqrt(clamp01(cos_theta)); }
inline float cos_at(float coordinate) { return sqr(coordinate); }

/// Index of refraction from 1 to 3, dense at 1.
inline float ior_coordinate(float ior) { return sqrt(clamp01((ior - 1.f) * 0.5f)); }
inline float ior_at(float coordinate) { return 1.f + 2.f * sqr(coordinate); }

/// The interval between nodes `index` and `index + 1` of `nodes`, and how far along it.
struct TableCell {
    int index;
    float weight;
};

inline TableCell table_cell(float coordinate, int nodes) {
    const float position = coordinate * static_cast<float>(nodes - 1);
    const int index = min(static_cast<int>(position), nodes - 2);
    return {index, position - static_cast<float>(index)};
}

}  // namespace pivot
