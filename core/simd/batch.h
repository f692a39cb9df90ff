// Batch: as many floats as the instruction set of this build of the core holds (4 with SSE4.2, 8 with AVX2). Templates
// over T run on it as they do on a float; xsimd's functions are found by their argument.
#pragma once

// clang-format off: the vectors' header must see numeric_limits<Batch>
#include <limits>
#include <xsimd/xsimd.hpp>

namespace pivot {
using Batch = xsimd::batch<float>;
using BatchMask = xsimd::batch_bool<float>;
inline constexpr std::size_t batch_size = Batch::size;
}  // namespace pivot

template <>
struct std::numeric_limits<pivot::Batch> : std::numeric_limits<float> {
    static pivot::Batch min() { return pivot::Batch(std::numeric_limits<float>::min()); }
    static pivot::Batch max() { return pivot::Batch(std::numeric_limits<float>::max()); }
    static pivot::Batch epsilon() { return pivot::Batch(std::numeric_limits<float>::epsilon()); }
    static pivot::Batch infinity() { return pivot::Batch(std::numeric_limits<float>::infinity()); }
};

#include "core/math/vector.h"
// clang-format on

namespace pivot {

template <>
inline const Batch pi<Batch>(pi<float>);
template <>
inline const Batch tiny<Batch>(tiny<float>);

using Vec2b = Vec2<Batch>;
using Vec3b = Vec3<Batch>;

inline bool any(const BatchMask& condition) { return xsimd::any(condition); }
inline bool all(const BatchMask& condition) { return xsimd::all(condition); }

/// A value per lane, for gathering and scattering.
using Lanes = std::array<float, batch_size>;

inline Batch load(const Lanes& lanes) { return Batch::load_unaligned(lanes.data()); }
inline Lanes store(const Batch& batch) {
    Lanes lanes;
    batch.store_unaligned(lanes.data());
    return lanes;
}

}  // namespace pivot
