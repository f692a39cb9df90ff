// A lobe of whatever kind, as numbers: its kind's struct laid out in a fixed handful of them, so that surfaces of
// different lobes are of one size and pack into lanes. core/bsdf/lobe.h has the list of kinds.
#pragma once

#include <array>
#include <cstring>
#include <string_view>
#include <type_traits>

#include "core/bsdf/base.h"

namespace pivot {

/// Lobes that a surface may have beside its base.
inline constexpr std::size_t max_lobes = 3;

template <class T>
struct LobeOf {
    T kind = T(0);  ///< 1: the first of the list, and so on; 0: no lobe, nor in the records after this one
    // Where there is no lobe these need not be set: most surfaces have none, and of batches this is most of the bytes.
    T probability;  ///< of choosing it when the BSDF is sampled
    std::array<T, sizeof(BaseOf<float>) / sizeof(float)> numbers;

    /// The lobe, if it is of this kind; else its numbers mean nothing.
    template <class Numbers>
    Numbers read() const {
        static_assert(std::is_trivially_copyable_v<Numbers> && sizeof(Numbers) <= sizeof(numbers));
        Numbers value;
        std::memcpy(static_cast<void*>(&value), numbers.data(), sizeof(Numbers));
        return value;
    }
    template <class Numbers>
    void write(const Numbers& value) {
        static_assert(std::is_trivially_copyable_v<Numbers> && sizeof(Numbers) <= sizeof(numbers));
        std::memcpy(numbers.data(), &value, sizeof(Numbers));
    }
    /// The same, in the lanes of a mask.
    template <class Numbers>
    void write(const Numbers& value, const Mask<T>& where) {
        LobeOf written;
        written.write(value);
        for (std::size_t i = 0; i < sizeof(Numbers) / sizeof(T); ++i)
            numbers[i] = select(where, written.numbers[i], numbers[i]);
    }
};

/// One of a lobe's parameters, as a material has them: `count` numbers between low and high, 3 of a colour.
struct LobeParameter {
    std::string_view name;
    std::size_t count;
    float low, high;
};

}  // namespace pivot
