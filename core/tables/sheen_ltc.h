// The linearly transformed cosine of a layer of upright fibres [Zeltner22], a 32 x 32 table over roughness and the
// view's cosine, made by lut/sheen_ltc.py.
#pragma once

#include "core/simd/batch.h"

namespace pivot {

inline constexpr int sheen_roughness_nodes = 32, sheen_cos_nodes = 32;

/// Light from wi is distributed as (a x + b z, a y, z) is by the cosine, x along the surface towards the viewer.
template <class T>
struct SheenLtc {
    T albedo, a, b;
};

/// roughness in [0, 1].
template <class T>
SheenLtc<T> sheen_ltc(T roughness, T cos_o);

}  // namespace pivot
