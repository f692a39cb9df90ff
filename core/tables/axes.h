// The axes that tables share: where a value lies on [0, 1], the value at a place on it, and linear interpolation
// between nodes.
#pragma once

#include "core/simd/batch.h"

namespace pivot {

/// GGX alpha from 1e-3 to 1, even in its square root, the artist's roughness.
inline constexpr float table_min_roughness = 0.031622777f;

template <class T>
T alpha_coordinate(T alpha) {
    return clamp01((sqrt(alpha) - T(table_min_roughness)) * T(1.f / (1.f - table_min_roughness)));
}
inline float alpha_at(float coordinate) { return sqr(lerp(table_min_roughness, 1.f, coordinate)); }

/// Cosine to the normal, even in its square root: the dip in albedo at cos ~ alpha spans nodes at any roughness.
template <class T>
T cos_coordinate(T cos_theta) {
    return sqrt(clamp01(cos_theta));
}
inline float cos_at(float coordinate) { return sqr(coordinate); }

/// Index of refraction from 1 to 3, dense at 1.
template <class T>
T ior_coordinate(T ior) {
    return sqrt(clamp01((ior - T(1)) * T(0.5)));
}
inline float ior_at(float coordinate) { return 1.f + 2.f * sqr(coordinate); }

/// Relative index of refraction from 0 to infinity, 1 in the middle and dense there.
template <class T>
T eta_coordinate(T eta) {
    const T ratio = (eta - T(1)) / (eta + T(1)), root = sqrt(abs(ratio));
    return T(0.5) + T(0.5) * select(ratio < T(0), -root, root);
}
/// Its ends stand for 1 / 1000 and 1000.
inline float eta_at(float coordinate) {
    const float root = 2.f * coordinate - 1.f, ratio = max(-0.998f, min(root * abs(root), 0.998f));
    return (1.f + ratio) / (1.f - ratio);
}

/// The interval between nodes `index` and `index + 1` of `nodes`, and how far along it.
template <class T>
struct TableCell {
    Index<T> index;
    T weight;
};

template <class T>
TableCell<T> table_cell(T coordinate, int nodes) {
    const T position = coordinate * T(static_cast<float>(nodes - 1));
    const T first = min(floor(position), T(static_cast<float>(nodes - 2)));
    return {to_index(first), position - first};
}

}  // namespace pivot
