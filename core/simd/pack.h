// Structs in a batch's lanes: of a template S over a number type, S<Batch> holds in each lane what S<float> holds. All
// members are numbers, or words of as many bits.
#pragma once

#include "core/simd/batch.h"

namespace pivot {
namespace detail {

#ifdef __AVX2__
/// Four numbers of a lane, then four of the lane four places on.
inline Batch load_row(const float* low, const float* high) {
    return _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_loadu_ps(low)), _mm_loadu_ps(high), 1);
}
inline void store_row(Batch row, float* low, float* high) {
    _mm_storeu_ps(low, _mm256_castps256_ps128(row));
    _mm_storeu_ps(high, _mm256_extractf128_ps(row, 1));
}
// Within each four numbers: the first two of a and b by turns, the last two; then the first two of each, the last two.
inline Batch zip_first(Batch a, Batch b) { return _mm256_unpacklo_ps(a, b); }
inline Batch zip_last(Batch a, Batch b) { return _mm256_unpackhi_ps(a, b); }
inline Batch join_first(Batch a, Batch b) { return _mm256_shuffle_ps(a, b, 0x44); }
inline Batch join_last(Batch a, Batch b) { return _mm256_shuffle_ps(a, b, 0xee); }
#else
inline Batch load_row(const float* low, const float*) { return _mm_loadu_ps(low); }
inline void store_row(Batch row, float* low, float*) { _mm_storeu_ps(low, row); }
inline Batch zip_first(Batch a, Batch b) { return _mm_unpacklo_ps(a, b); }
inline Batch zip_last(Batch a, Batch b) { return _mm_unpackhi_ps(a, b); }
inline Batch join_first(Batch a, Batch b) { return _mm_shuffle_ps(a, b, 0x44); }
inline Batch join_last(Batch a, Batch b) { return _mm_shuffle_ps(a, b, 0xee); }
#endif
static_assert(batch_size % 4 == 0);

/// Of each four numbers of the four rows: rows become columns.
inline std::array<Batch, 4> transpose(const std::array<Batch, 4>& r) {
    const Batch ab_first = zip_first(r[0], r[1]), ab_last = zip_last(r[0], r[1]);
    const Batch cd_first = zip_first(r[2], r[3]), cd_last = zip_last(r[2], r[3]);
    return {join_first(ab_first, cd_first), join_last(ab_first, cd_first), join_first(ab_last, cd_last),
            join_last(ab_last, cd_last)};
}

/// Calls visit(first) with where each group of four of so many numbers starts; the last overlaps the one before.
template <class One, std::size_t numbers, class Visit>
void for_each_four(const Visit& visit) {
    static_assert(std::is_trivially_copyable_v<One> && sizeof(One) % sizeof(float) == 0);
    static_assert(numbers >= 4 && numbers <= sizeof(One) / sizeof(float));
    for (std::size_t first = 0; first + 4 <= numbers; first += 4) visit(first);
    if constexpr (numbers % 4 != 0) visit(numbers - 4);
}

}  // namespace detail

template <template <class> class S>
inline constexpr std::size_t all_numbers = sizeof(S<float>) / sizeof(float);

/// Of each the first `numbers`, or all; others keep what an S<Batch> starts with.
template <template <class> class S, std::size_t numbers = all_numbers<S>>
S<Batch> pack(const std::array<const S<float>*, batch_size>& lanes) {
    static_assert(sizeof(S<Batch>) == batch_size * sizeof(S<float>));
    S<Batch> packed;
    auto* bytes = reinterpret_cast<std::byte*>(&packed);
    detail::for_each_four<S<float>, numbers>([&](std::size_t first) {
        const auto from = [&](std::size_t lane) { return reinterpret_cast<const float*>(lanes[lane]) + first; };
        std::array<Batch, 4> rows;
        for (std::size_t i = 0; i < 4; ++i) rows[i] = detail::load_row(from(i), from(i + batch_size - 4));
        rows = detail::transpose(rows);
        std::memcpy(bytes + first * sizeof(Batch), rows.data(), sizeof(rows));
    });
    return packed;
}

template <template <class> class S, std::size_t numbers = all_numbers<S>>
std::array<S<float>, batch_size> unpack(const S<Batch>& packed) {
    static_assert(sizeof(S<Batch>) == batch_size * sizeof(S<float>));
    std::array<S<float>, batch_size> lanes;
    const auto* bytes = reinterpret_cast<const std::byte*>(&packed);
    detail::for_each_four<S<float>, numbers>([&](std::size_t first) {
        const auto to = [&](std::size_t lane) { return reinterpret_cast<float*>(&lanes[lane]) + first; };
        std::array<Batch, 4> rows;
        std::memcpy(rows.data(), bytes + first * sizeof(Batch), sizeof(rows));
        rows = detail::transpose(rows);
        for (std::size_t i = 0; i < 4; ++i) detail::store_row(rows[i], to(i), to(i + batch_size - 4));
    });
    return lanes;
}

/// The same struct in every lane.
template <template <class> class S>
S<Batch> broadcast(const S<float>& same) {
    static_assert(sizeof(S<Batch>) == batch_size * sizeof(S<float>));
    S<Batch> lanes;
    for (std::size_t at = 0; at < sizeof(same); at += sizeof(float)) {
        float number;
        std::memcpy(&number, reinterpret_cast<const std::byte*>(&same) + at, sizeof(float));
        const Batch batch(number);
        std::memcpy(reinterpret_cast<std::byte*>(&lanes) + at * batch_size, &batch, sizeof(Batch));
    }
    return lanes;
}

}  // namespace pivot
