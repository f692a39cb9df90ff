// Owen-scrambled Sobol points: two dimensions at a time, decorrelated between dimensions and pixels by shuffling.
// Over 32-bit words or SIMD batches of them.
//
// [Ahmed20]   Ahmed, Wonka, Screen-Space Blue-Noise Diffusion of Monte Carlo Sampling Error via Hierarchical Ordering
//             of Pixels
// [Burley20]  Practical Hash-based Owen Scrambling
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include "core/simd/batch.h"

namespace pivot {

/// A well-mixed hash of two words (PCG's output permutation over a combined state).
template <class U>
U hash(U a, U b) {
    U state = (a ^ (b * U(0x9e3779b9u))) * U(747796405u) + U(2891336453u);
    state = ((state >> ((state >> 28) + U(4u))) ^ state) * U(277803737u);
    state = (state >> 22) ^ state;
    state = state * U(747796405u) + b;
    state = ((state >> ((state >> 28) + U(4u))) ^ state) * U(277803737u);
    return (state >> 22) ^ state;
}

template <class U>
U reverse_bits(U x) {
    x = (x << 16) | (x >> 16);
    x = ((x & U(0x00ff00ffu)) << 8) | ((x & U(0xff00ff00u)) >> 8);
    x = ((x & U(0x0f0f0f0fu)) << 4) | ((x & U(0xf0f0f0f0u)) >> 4);
    x = ((x & U(0x33333333u)) << 2) | ((x & U(0xccccccccu)) >> 2);
    return ((x & U(0x55555555u)) << 1) | ((x & U(0xaaaaaaaau)) >> 1);
}

/// Owen scrambling of a 32-bit fraction given with its bits reversed: each bit is flipped by a hash of the bits below
/// it [Burley20, listing 3; constants by N. Vegdahl].
template <class U>
U owen_scramble_reversed(U x, U seed) {
    x ^= x * U(0x3d20adeau);
    x += seed;
    x *= (seed >> 16) | U(1u);
    x ^= x * U(0x05526c56u);
    return x ^ (x * U(0x53a22864u));
}

/// The second Sobol dimension of an index, bits reversed (the first dimension is the index itself, bits reversed).
/// Its matrix is Pascal's triangle mod 2, a tensor power of [[1, 1], [0, 1]]: five steps instead of 32 columns.
template <class U>
U sobol_second_reversed(U index) {
    index ^= (index >> 1) & U(0x55555555u);
    index ^= (index >> 2) & U(0x33333333u);
    index ^= (index >> 4) & U(0x0f0f0f0fu);
    index ^= (index >> 8) & U(0x00ff00ffu);
    return index ^ (index >> 16);
}

/// [0, 1) with 24 bits: the largest value is below 1 in float.
inline float to_unit(std::uint32_t x) { return static_cast<float>(x >> 8) * 0x1p-24f; }

/// A sample of a pixel, or of a batch of pixels: a sequence of points, asked for by dimension.
template <class U>
struct SamplerOf {
    U pixel_seed, sample;

    /// A point of a (0, 2)-sequence over the sample index; different dimensions are independent.
    auto point(std::uint32_t dimension) const {
        const U seed = hash(pixel_seed, U(dimension));
        const U index = reverse_bits(owen_scramble_reversed(reverse_bits(sample), seed));
        const auto x = to_unit(reverse_bits(owen_scramble_reversed(index, hash(seed, U(1u)))));
        return Vec2<std::remove_const_t<decltype(x)>>(
            x, to_unit(reverse_bits(owen_scramble_reversed(sobol_second_reversed(index), hash(seed, U(2u))))));
    }
};

using Sampler = SamplerOf<std::uint32_t>;

/// The bits of two coordinates in turns, x first: squares of 2^k x 2^k pixels are 4^k successive numbers.
inline std::uint32_t morton_code(std::uint32_t x, std::uint32_t y) {
    const auto spread = [](std::uint32_t v) {
        v = (v | (v << 8)) & 0x00ff00ffu;
        v = (v | (v << 4)) & 0x0f0f0f0fu;
        v = (v | (v << 2)) & 0x33333333u;
        return (v | (v << 1)) & 0x55555555u;
    };
    return spread(x & 0xffffu) | (spread(y & 0xffffu) << 1);
}

/// Sample number `sample` of the 2^log2_samples of a pixel. Those of a square of pixels are successive points of one
/// sequence, so that neighbours' errors make up for each other in the eye [Ahmed20] and in a filter over both.
inline Sampler pixel_sampler(std::uint32_t x, std::uint32_t y, std::uint32_t seed, std::uint32_t log2_samples,
                             std::uint32_t sample) {
    const std::uint32_t log2_square = std::min(3u, (32u - log2_samples) / 2u), mask = (1u << log2_square) - 1u;
    return {hash(hash(x >> log2_square, y >> log2_square), seed),
            (morton_code(x & mask, y & mask) << log2_samples) + sample};
}

/// As many samplers as a batch has lanes; past the end, the last again.
inline SamplerOf<WordBatch> sampler_lanes(std::span<const Sampler> samplers) {
    std::array<std::uint32_t, batch_size> pixel_seed, sample;
    for (std::size_t i = 0; i < batch_size; ++i) {
        const Sampler& sampler = samplers[std::min(i, samplers.size() - 1)];
        pixel_seed[i] = sampler.pixel_seed;
        sample[i] = sampler.sample;
    }
    return {WordBatch::load_unaligned(pixel_seed.data()), WordBatch::load_unaligned(sample.data())};
}

/// One point of each sampler.
inline void sample_points(std::span<const Sampler> samplers, std::uint32_t dimension, std::span<Vec2f> points) {
    for (std::size_t first = 0; first < samplers.size(); first += batch_size) {
        const Vec2b u = sampler_lanes(samplers.subspan(first)).point(dimension);
        const Lanes x = store(u.x), y = store(u.y);
        for (std::size_t i = first; i < std::min(first + batch_size, samplers.size()); ++i)
            points[i] = {x[i - first], y[i - first]};
    }
}

}  // namespace pivot
