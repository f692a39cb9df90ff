// Owen-scrambled Sobol points: two dimensions at a time, decorrelated between dimensions and pixels by shuffling.
//
// [Burley20]  Practical Hash-based Owen Scrambling
#pragma once

#include <cstdint>

#include "core/math/vector.h"

namespace pivot {

/// A well-mixed hash of two words (PCG's output permutation over a combined state).
inline std::uint32_t hash(std::uint32_t a, std::uint32_t b) {
    std::uint32_t state = (a ^ (b * 0x9e3779b9u)) * 747796405u + 2891336453u;
    state = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    state = (state >> 22u) ^ state;
    state = state * 747796405u + b;
    state = ((state >> ((state >> 28u) + 4u)) ^ state) * 277803737u;
    return (state >> 22u) ^ state;
}

inline std::uint32_t reverse_bits(std::uint32_t x) {
    x = __builtin_bswap32(x);
    x = ((x & 0x0f0f0f0fu) << 4) | ((x & 0xf0f0f0f0u) >> 4);
    x = ((x & 0x33333333u) << 2) | ((x & 0xccccccccu) >> 2);
    return ((x & 0x55555555u) << 1) | ((x & 0xaaaaaaaau) >> 1);
}

/// Owen scrambling of a 32-bit fraction given with its bits reversed: each bit is flipped by a hash of the bits below
/// it [Burley20, listing 3; constants by N. Vegdahl].
inline std::uint32_t owen_scramble_reversed(std::uint32_t x, std::uint32_t seed) {
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16) | 1u;
    x ^= x * 0x05526c56u;
    return x ^ (x * 0x53a22864u);
}

/// The second Sobol dimension of an index, bits reversed (the first dimension is the index itself, bits reversed).
/// Its matrix is Pascal's triangle mod 2, a tensor power of [[1, 1], [0, 1]]: five steps instead of 32 columns.
inline std::uint32_t sobol_second_reversed(std::uint32_t index) {
    index ^= (index >> 1) & 0x55555555u;
    index ^= (index >> 2) & 0x33333333u;
    index ^= (index >> 4) & 0x0f0f0f0fu;
    index ^= (index >> 8) & 0x00ff00ffu;
    return index ^ (index >> 16);
}

/// [0, 1) with 24 bits: the largest value is below 1 in float.
inline float to_unit(std::uint32_t x) { return static_cast<float>(x >> 8) * 0x1p-24f; }

/// One sample of one pixel: a sequence of points, asked for by dimension.
class Sampler {
   public:
    Sampler() : Sampler(0, 0) {}
    Sampler(std::uint32_t pixel_seed, std::uint32_t sample) : seed_(pixel_seed), sample_(sample) {}

    /// A point of a (0, 2)-sequence over the sample index; different dimensions are independent.
    Vec2f point(std::uint32_t dimension) const {
        const std::uint32_t seed = hash(seed_, dimension);
        const std::uint32_t index = reverse_bits(owen_scramble_reversed(reverse_bits(sample_), seed));
        return {to_unit(reverse_bits(owen_scramble_reversed(index, hash(seed, 1u)))),
                to_unit(reverse_bits(owen_scramble_reversed(sobol_second_reversed(index), hash(seed, 2u))))};
    }

    float number(std::uint32_t dimension) const { return point(dimension).x; }

   private:
    std::uint32_t seed_, sample_;
};

}  // namespace pivot
