// Albedo of a GGX dielectric boundary that reflects and refracts: what single scattering between the microfacets keeps
// of the light. A 32 x 32 x 33 table over alpha, the view's cosine and the relative index of refraction, made by
// lut/ggx_glass.py, and its hemispherical mean.
#pragma once

#include "core/simd/batch.h"

namespace pivot {

inline constexpr int ggx_glass_alpha_nodes = 32, ggx_glass_cos_nodes = 32, ggx_glass_eta_nodes = 33;

/// What comes to the viewer where all light around is 1, by the side that it comes from.
template <class T>
struct GlassAlbedo {
    T reflected, refracted;
};

/// alpha in [1e-3, 1]; eta: index of refraction of the other side over that of the viewer's.
template <class T>
GlassAlbedo<T> ggx_glass_albedo(T alpha, T cos_o, T eta);

/// Hemispherical mean of both together: 2 int_0^1 E cos dcos.
template <class T>
T ggx_glass_average_albedo(T alpha, T eta);

}  // namespace pivot
