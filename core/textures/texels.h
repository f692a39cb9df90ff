// Stored numbers of a picture as floats and back.
#pragma once

#include <array>

#include "core/simd/batch.h"
#include "core/textures/image.h"

namespace pivot {

constexpr std::size_t number_bytes(TexelType type) {
    switch (type) {
        case TexelType::uint8:
            return 1;
        case TexelType::uint16:
        case TexelType::float16:
            return 2;
        case TexelType::float32:
            return 4;
    }
    return 0;
}

/// A half's bits as a float: its exponent's bias is 112 less. It is finite.
inline float float_from_half(std::uint32_t bits) {
    return std::bit_cast<float>((bits & 0x7fff) << 13) * (bits & 0x8000 ? -0x1p112f : 0x1p112f);
}

inline Batch float_from_half(const WordBatch& bits) {
    const Batch size = std::bit_cast<Batch>((bits & WordBatch(0x7fff)) << 13) * Batch(0x1p112f);
    return std::bit_cast<Batch>(std::bit_cast<WordBatch>(size) | ((bits & WordBatch(0x8000)) << 16));
}

/// To the nearest, even of two; the largest half for what is larger.
inline std::uint16_t half_from_float(float x) {
    const auto bits = std::bit_cast<std::uint32_t>(std::min(std::abs(x), 65504.0f) * 0x1p-112f);
    const std::uint32_t rounded = (bits + 0x0fff + (bits >> 13 & 1)) >> 13;
    return static_cast<std::uint16_t>(rounded | (x < 0.0f ? 0x8000 : 0));
}

inline Batch float_from_word(const WordBatch& x) { return xsimd::to_float(std::bit_cast<IndexBatch>(x)); }

/// Number i of texels of which each lane has the words, in the order of memory.
template <TexelType type>
Batch number_of(const std::array<WordBatch, 4>& words, std::uint32_t i) {
    if constexpr (type == TexelType::uint8)
        return float_from_word((words[0] >> static_cast<int>(8 * i)) & WordBatch(0xff)) * Batch(1 / 255.0f);
    if constexpr (type == TexelType::float32) return std::bit_cast<Batch>(words[i]);
    const WordBatch bits = (words[i / 2] >> static_cast<int>(16 * (i % 2))) & WordBatch(0xffff);
    if constexpr (type == TexelType::uint16) return float_from_word(bits) * Batch(1 / 65535.0f);
    return float_from_half(bits);
}

}  // namespace pivot
