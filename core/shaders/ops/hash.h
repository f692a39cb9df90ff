// What textures take for random: hashes of whole numbers, and of the bits of floats. [Cycles 4.5 util/hash.h 14-330]
#pragma once

#include "core/shaders/point.h"

namespace pivot {

template <std::size_t n>
using Words = std::array<WordBatch, n>;

/// Bob Jenkins' lookup3 of up to four words (burtleburtle.net/bob/c/lookup3.c, 2006).
struct Lookup3 {
    WordBatch a, b, c;

    static WordBatch rotated(const WordBatch& x, int by) { return (x << by) | (x >> (32 - by)); }

    void mix() {
        a -= c, a ^= rotated(c, 4), c += b;
        b -= a, b ^= rotated(a, 6), a += c;
        c -= b, c ^= rotated(b, 8), b += a;
        a -= c, a ^= rotated(c, 16), c += b;
        b -= a, b ^= rotated(a, 19), a += c;
        c -= b, c ^= rotated(b, 4), b += a;
    }
    void finish() {
        c ^= b, c -= rotated(b, 14);
        a ^= c, a -= rotated(c, 11);
        b ^= a, b -= rotated(a, 25);
        c ^= b, c -= rotated(b, 16);
        a ^= c, a -= rotated(c, 4);
        b ^= a, b -= rotated(a, 14);
        c ^= b, c -= rotated(b, 24);
    }
};

template <std::size_t n>
WordBatch hash(const Words<n>& key) {
    static_assert(n >= 1 && n <= 4);
    const WordBatch start(0xdeadbeefu + (static_cast<std::uint32_t>(n) << 2) + 13u);
    Lookup3 state{.a = start + key[0], .b = start, .c = start};
    if constexpr (n >= 2) state.b += key[1];
    if constexpr (n >= 3) state.c += key[2];
    if constexpr (n == 4) {
        state.mix();
        state.a += key[3];
    }
    state.finish();
    return state.c;
}

/// [0, 1], of all 32 bits, rounded once.
inline Batch to_unit_inclusive(const WordBatch& x) {
    const auto number = [](const WordBatch& small) { return xsimd::to_float(std::bit_cast<IndexBatch>(small)); };
    const Batch whole = number(x >> 16) * Batch(65536.0f) + number(x & WordBatch(0xffffu));
    return whole * Batch(1.0f / 4294967296.0f);
}

/// [0, 1], of the bits of a point and of more numbers.
template <std::size_t n, class... More>
Batch random_number(const Point<n>& at, const More&... more) {
    Words<n + sizeof...(more)> words;
    for (std::size_t i = 0; i < n; ++i) words[i] = std::bit_cast<WordBatch>(at.x[i]);
    if constexpr (sizeof...(more) > 0) {
        std::size_t i = n;
        ((words[i++] = std::bit_cast<WordBatch>(Batch(more))), ...);
    }
    return to_unit_inclusive(hash(words));
}

/// The number of a point of four dimensions with its parts in another order.
inline Batch random_number_of_order(const Point<4>& at, std::array<std::size_t, 4> order) {
    return random_number(make_point<4>([&](std::size_t i) { return at.x[order[i]]; }));
}

/// In the unit cube: where a Voronoi cell has its point.
template <std::size_t n>
Point<n> random_point(const Point<n>& at) {
    Point<n> result{};
    result.x[0] = random_number(at);
    if constexpr (n == 2 || n == 3) result.x[1] = random_number(at, 1.0f);
    if constexpr (n == 3) result.x[2] = random_number(at, 2.0f);
    if constexpr (n == 4) {
        result.x[1] = random_number_of_order(at, {3, 0, 1, 2});
        result.x[2] = random_number_of_order(at, {2, 3, 0, 1});
        result.x[3] = random_number_of_order(at, {1, 2, 3, 0});
    }
    return result;
}

template <std::size_t n>
Vec3b random_color(const Point<n>& at) {
    if constexpr (n == 4)
        return {random_number(at), random_number_of_order(at, {2, 0, 3, 1}), random_number_of_order(at, {3, 2, 1, 0})};
    else
        return {random_number(at), random_number(at, 1.0f), random_number(at, 2.0f)};
}

}  // namespace pivot
