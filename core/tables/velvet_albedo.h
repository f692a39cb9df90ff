// Albedo of the velvet lobe (core/bsdf/lobes/velvet.h), a 32 x 32 table of sigma^2 times its logarithm,
// over sigma and the view's cosine, even in its angle, made by lut/velvet_albedo.py.
#pragma once

#include "core/simd/batch.h"

namespace pivot {

inline constexpr int velvet_sigma_nodes = 32, velvet_cos_nodes = 32;
inline constexpr float velvet_min_sigma = 0.01f;

/// sigma in [velvet_min_sigma, 1].
template <class T>
T velvet_albedo(T sigma, T cos_o);

}  // namespace pivot
