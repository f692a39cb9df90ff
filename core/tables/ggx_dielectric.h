// Albedo of the GGX reflection lobe under the dielectric Fresnel curve, as lerp(F0, 1, s) of its albedo with F = 1: s
// is a 32 x 32 x 16 table over alpha, the view's cosine and the index of refraction, made by lut/ggx_dielectric.py.
#pragma once

#include "core/simd/batch.h"

namespace pivot {

inline constexpr int ggx_dielectric_alpha_nodes = 32, ggx_dielectric_cos_nodes = 32, ggx_dielectric_ior_nodes = 16;

/// s in [0, 1]: the mean over the lobe of where Fresnel's curve stands between F0 (0) and 1 (1). alpha in [1e-3, 1],
/// ior >= 1, held at 3 above that.
template <class T>
T ggx_dielectric_weight(T alpha, T cos_o, T ior);

}  // namespace pivot
