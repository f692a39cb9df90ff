// Batch: as many floats as the instruction set of this build of the core holds (4 with SSE4.2, 8 with AVX2). Templates
// over T run on it as they do on a float; xsimd's functions are found by their argument.
#pragma once

// clang-format off: the vectors' header must see numeric_limits<Batch>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
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

// The instruction set's estimate and a step of Newton's method.
template <>
inline Batch inverse(Batch x) {
    const Batch estimate = xsimd::reciprocal(x);
    return estimate + estimate * (Batch(1.0f) - x * estimate);
}
template <>
inline Batch inverse_sqrt(Batch x) {
    const Batch estimate = xsimd::rsqrt(x);
    return estimate + estimate * (Batch(0.5f) - Batch(0.5f) * x * estimate * estimate);
}

using Vec2b = Vec2<Batch>;
using Vec3b = Vec3<Batch>;

inline bool any(const BatchMask& condition) { return xsimd::any(condition); }

using WordBatch = xsimd::batch<std::uint32_t>;
using IndexBatch = xsimd::batch<std::int32_t>;

/// A 32-bit word, or one a lane, beside numbers T.
template <class T>
using Word = std::conditional_t<std::is_same_v<T, Batch>, WordBatch, std::uint32_t>;
/// A place in a table.
template <class T>
using Index = std::conditional_t<std::is_same_v<T, Batch>, IndexBatch, std::int32_t>;

inline WordBatch select(const BatchMask& condition, const WordBatch& a, const WordBatch& b) {
    return std::bit_cast<WordBatch>(xsimd::select(condition, std::bit_cast<Batch>(a), std::bit_cast<Batch>(b)));
}
inline IndexBatch select(const BatchMask& condition, const IndexBatch& a, const IndexBatch& b) {
    return std::bit_cast<IndexBatch>(xsimd::select(condition, std::bit_cast<Batch>(a), std::bit_cast<Batch>(b)));
}
inline BatchMask equal(const WordBatch& a, const WordBatch& b) { return std::bit_cast<BatchMask>(a == b); }

/// The place that a whole number names.
inline std::int32_t to_index(float x) { return static_cast<std::int32_t>(x); }
inline IndexBatch to_index(const Batch& x) { return xsimd::to_int(x); }

inline float fetch(const float* table, std::int32_t index) { return table[index]; }
inline Batch fetch(const float* table, const IndexBatch& index) { return Batch::gather(table, index); }
inline std::int32_t fetch(const std::int32_t* table, std::int32_t index) { return table[index]; }
inline IndexBatch fetch(const std::int32_t* table, const IndexBatch& index) { return IndexBatch::gather(table, index); }

/// Two neighbours of 16 bits, read at once.
template <class T>
Vec2<T> fetch_pair(const std::uint16_t* table, const Index<T>& index) {
    if constexpr (std::is_same_v<T, float>) {
        return {static_cast<float>(table[index]), static_cast<float>(table[index + 1])};
    } else {
#ifdef __AVX2__
        const WordBatch words(_mm256_i32gather_epi32(reinterpret_cast<const int*>(table), index, sizeof(*table)));
#else
        std::array<std::int32_t, batch_size> at;
        std::array<std::uint32_t, batch_size> pairs;
        index.store_unaligned(at.data());
        for (std::size_t i = 0; i < batch_size; ++i) std::memcpy(&pairs[i], table + at[i], sizeof(pairs[i]));
        const WordBatch words = WordBatch::load_unaligned(pairs.data());
#endif
        return {xsimd::to_float(std::bit_cast<IndexBatch>(words & WordBatch(0xffffu))),
                xsimd::to_float(std::bit_cast<IndexBatch>(words >> 16))};
    }
}

/// [0, 1) with 24 bits.
inline Batch to_unit(const WordBatch& x) {
    return xsimd::to_float(std::bit_cast<xsimd::batch<std::int32_t>>(x >> 8)) * Batch(0x1p-24f);
}

/// True in so many lanes, from the first.
inline BatchMask first_lanes(std::size_t count) {
    alignas(sizeof(Batch)) std::array<float, batch_size> places;
    for (std::size_t i = 0; i < batch_size; ++i) places[i] = static_cast<float>(i);
    return Batch::load_aligned(places.data()) < Batch(static_cast<float>(count));
}

/// A value per lane, for gathering and scattering.
using Lanes = std::array<float, batch_size>;

inline Batch load(const Lanes& lanes) { return Batch::load_unaligned(lanes.data()); }
inline Lanes store(const Batch& batch) {
    Lanes lanes;
    batch.store_unaligned(lanes.data());
    return lanes;
}

inline std::array<bool, batch_size> store(const BatchMask& mask) {
    const Lanes lanes = store(xsimd::select(mask, Batch(1.0f), Batch(0.0f)));
    std::array<bool, batch_size> result;
    for (std::size_t i = 0; i < batch_size; ++i) result[i] = lanes[i] > 0.0f;
    return result;
}

/// The same vector in every lane.
inline Vec3b broadcast(const Vec3f& v) { return {Batch(v.x), Batch(v.y), Batch(v.z)}; }

/// value(lane), a number, of each lane.
template <class Value>
Batch gather(const Value& value) {
    Lanes lanes;
    for (std::size_t i = 0; i < batch_size; ++i) lanes[i] = value(i);
    return load(lanes);
}

/// value(lane), a vector, of each lane.
template <class Value>
Vec3b gather_vector(const Value& value) {
    Lanes x, y, z;
    for (std::size_t i = 0; i < batch_size; ++i) {
        const Vec3f v = value(i);
        x[i] = v.x;
        y[i] = v.y;
        z[i] = v.z;
    }
    return {load(x), load(y), load(z)};
}

/// Lane i of a permuted batch is lane index[i].
using LaneIndex = std::array<std::int32_t, batch_size>;

inline Batch permute(const Batch& batch, const LaneIndex& index) {
#ifdef __AVX2__
    static_assert(sizeof(index) == sizeof(__m256i));
    return _mm256_permutevar8x32_ps(batch, std::bit_cast<__m256i>(index));
#else
    const Lanes lanes = store(batch);
    return gather([&](std::size_t i) { return lanes[static_cast<std::size_t>(index[i])]; });
#endif
}

/// Of every member of a struct of batches and masks.
template <class Batches>
Batches permute(const Batches& batches, const LaneIndex& index) {
    static_assert(std::is_trivially_copyable_v<Batches> && sizeof(BatchMask) == sizeof(Batch));
    Batches result = batches;
    for (std::size_t at = 0; at < sizeof(Batches); at += sizeof(Batch)) {
        Batch member;
        std::memcpy(&member, reinterpret_cast<const std::byte*>(&result) + at, sizeof(Batch));
        member = permute(member, index);
        std::memcpy(reinterpret_cast<std::byte*>(&result) + at, &member, sizeof(Batch));
    }
    return result;
}

/// Lane i is lane index[i] of *sources[i], a struct of batches.
template <class Batches>
Batches collect(const std::array<const Batches*, batch_size>& sources, const LaneIndex& index) {
    static_assert(std::is_trivially_copyable_v<Batches> && sizeof(Batches) % sizeof(Batch) == 0);
    Batches result = *sources[0];
    for (std::size_t at = 0; at < sizeof(Batches); at += sizeof(Batch)) {
        Lanes lanes;
        for (std::size_t i = 0; i < batch_size; ++i) {
            const auto* member = reinterpret_cast<const std::byte*>(sources[i]) + at;
            std::memcpy(&lanes[i], member + static_cast<std::size_t>(index[i]) * sizeof(float), sizeof(float));
        }
        std::memcpy(reinterpret_cast<std::byte*>(&result) + at, lanes.data(), sizeof(Batch));
    }
    return result;
}

}  // namespace pivot
