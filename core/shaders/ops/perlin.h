// Perlin's gradient noise in 1 to 4 dimensions: about -1..1, 0 at whole numbers.
// [Perlin02] Ken Perlin, "Improving Noise", SIGGRAPH 2002; [C] Cycles 4.5 kernel/svm/noise.h, whose gradients these
// are.
#pragma once

#include "core/shaders/ops/hash.h"

namespace pivot {
namespace detail {

inline BatchMask masked_is(const WordBatch& hash, std::uint32_t mask, std::uint32_t value) {
    return equal(hash & WordBatch(mask), WordBatch(value));
}

inline Batch negated_if(const WordBatch& hash, int bit, const Batch& x) {
    return std::bit_cast<Batch>(std::bit_cast<WordBatch>(x) ^ ((hash & WordBatch(1u << bit)) << (31 - bit)));
}

/// The product of a corner's gradient, which its hash chooses, and of the way from there. [C 27-33, 113-136]
template <std::size_t n>
Batch gradient(const WordBatch& hash, const Point<n>& way) {
    const auto& x = way.x;
    if constexpr (n == 1) {
        const Batch slope = Batch(1.0f) + xsimd::to_float(std::bit_cast<IndexBatch>(hash & WordBatch(7u)));
        return negated_if(hash, 3, slope) * x[0];
    }
    if constexpr (n == 2) {
        const BatchMask first = masked_is(hash, 4, 0);
        const Batch v = select(first, x[1], x[0]);
        return negated_if(hash, 0, select(first, x[0], x[1])) + negated_if(hash, 1, v + v);
    }
    if constexpr (n == 3) {
        const Batch v = select(masked_is(hash, 12, 0), x[1], select(masked_is(hash, 13, 12), x[0], x[2]));
        return negated_if(hash, 0, select(masked_is(hash, 8, 0), x[0], x[1])) + negated_if(hash, 1, v);
    }
    if constexpr (n == 4)
        return negated_if(hash, 0, select(masked_is(hash, 24, 24), x[1], x[0])) +
               negated_if(hash, 1, select(masked_is(hash, 16, 0), x[1], x[2])) +
               negated_if(hash, 2, select(masked_is(hash, 24, 0), x[2], x[3]));
}

/// The remainder towards 0 of what is far out, and half a unit on where floats are whole numbers. [C 690-760]
inline Batch wrapped(const Batch& x) {
    constexpr float period = 1e5f;
    const Batch rest = x - trunc(x / Batch(period)) * Batch(period);
    return rest + select(abs(x) >= Batch(1e6f), Batch(0.5f), Batch(0.0f));
}

}  // namespace detail

/// wraps: as from Blender 4.2, it repeats every 100 000; before, it is 0 where it is not finite.
template <std::size_t n>
Batch perlin(Point<n> at, bool wraps) {
    constexpr std::array scales{0.25f, 0.6616f, 0.9820f, 0.8344f};  // to about -1..1 [C 665-688]
    constexpr std::size_t corners = std::size_t(1) << n;
    BatchMask far = abs(at.x[0]) >= Batch(1e5f);
    for (std::size_t i = 1; i < n; ++i) far = far || abs(at.x[i]) >= Batch(1e5f);
    if (wraps && any(far)) at = make_point<n>([&](std::size_t i) { return detail::wrapped(at.x[i]); });

    const Point<n> low = floor(at);
    const std::array<Point<n>, 2> way{at - low, at - low - make_point<n>([](std::size_t) { return Batch(1.0f); })};
    std::array<Words<n>, 2> cell;
    for (std::size_t i = 0; i < n; ++i) {
        cell[0][i] = std::bit_cast<WordBatch>(to_index(low.x[i]));
        cell[1][i] = cell[0][i] + WordBatch(1u);
    }
    std::array<Batch, corners> value;
#pragma GCC unroll 16
    for (std::size_t corner = 0; corner < corners; ++corner) {
        Words<n> key;
        Point<n> from_corner;
        for (std::size_t i = 0; i < n; ++i) {
            key[i] = cell[corner >> i & 1][i];
            from_corner.x[i] = way[corner >> i & 1].x[i];
        }
        value[corner] = detail::gradient(hash(key), from_corner);
    }
    for (std::size_t i = 0; i < n; ++i) {
        const Batch t = way[0].x[i];
        const Batch s = t * t * t * (t * (t * Batch(6.0f) - Batch(15.0f)) + Batch(10.0f));  // [Perlin02 (1)]
        for (std::size_t j = 0; j < corners >> (i + 1); ++j) value[j] = lerp(value[2 * j], value[2 * j + 1], s);
    }
    const Batch result = value[0] * Batch(scales[n - 1]);
    return select(abs(result) < Batch(std::numeric_limits<float>::infinity()), result, Batch(0.0f));
}

}  // namespace pivot
