// Albedo of the GGX reflection lobe with F = 1, height-correlated Smith: what single scattering keeps of the light.
// Tables made by lut/ggx_sptd.py and lut/ggx_average_albedo.py.
//
// [Kulla17] Kulla and Conty, "Revisiting Physically Based Shading at Imageworks", SIGGRAPH 2017 course: E and E_avg.
#pragma once

#include "core/simd/batch.h"

namespace pivot {

inline constexpr int ggx_albedo_nodes = 64;

/// Directional albedo E(cos_o): the integral of BRDF * cos over the hemisphere. alpha in [1e-3, 1].
template <class T>
T ggx_albedo(T alpha, T cos_o);

/// Hemispherical albedo E_avg = 2 int_0^1 E cos dcos.
template <class T>
T ggx_average_albedo(T alpha);

}  // namespace pivot
