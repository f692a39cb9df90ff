// A lobe of whatever kind, as numbers: its kind's struct laid out in a fixed handful of them, so that surfaces of
// different lobes are of one size and pack into lanes. core/bsdf/lobe.h has the list of kinds.
#pragma once

#include <algorithm>
#include <array>
#include <cstring>
#include <string_view>
#include <type_traits>

#include "core/bsdf/base.h"
#include "core/simd/batch.h"

namespace pivot {

/// Lobes that a surface may have beside its base.
inline constexpr std::size_t max_lobes = 3;

template <class T>
struct LobeOf {
    T kind = T(0);  ///< 1: the first of the list, and so on; 0: no lobe, nor in the records after this one
    // Where there is no lobe these need not be set: most surfaces have none, and of batches this is most of the bytes.
    T probability;  ///< of choosing it when the BSDF is sampled
    std::array<T, sizeof(BaseOf<float>) / sizeof(float)> numbers;

    /// The lobe, in the lanes that are of its kind; in the others its numbers mean nothing, but are 0 if it holds an
    /// address.
    template <class Numbers>
    Numbers read([[maybe_unused]] const Mask<T>& is_kind) const {
        static_assert(std::is_trivially_copyable_v<Numbers> && sizeof(Numbers) <= sizeof(numbers));
        Numbers value;
        std::memcpy(static_cast<void*>(&value), numbers.data(), sizeof(Numbers));
        if constexpr (requires { value.ndf; })
            value.ndf = {select(is_kind, value.ndf.low, T(0)), select(is_kind, value.ndf.middle, T(0)),
                         select(is_kind, value.ndf.high, T(0))};
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

/// Where something lies that a lobe reads, as numbers among its others: 16 bits each, which floats hold exactly. All 0:
/// nothing.
template <class T>
struct AddressOf {
    T low{0}, middle{0}, high{0};

    static AddressOf of(const void* pointer) {
        const auto bits = reinterpret_cast<std::uintptr_t>(pointer);
        const auto part = [&](int shift) { return static_cast<float>((bits >> shift) & 0xffffu); };
        return {part(0), part(16), part(32)};
    }
    template <class Pointee>
    const Pointee* pointer() const {
        const auto bits = [](float part, int shift) { return static_cast<std::uintptr_t>(part) << shift; };
        return reinterpret_cast<const Pointee*>(bits(low, 0) | bits(middle, 16) | bits(high, 32));
    }
    /// Each lane's.
    template <class Pointee>
    std::array<const Pointee*, batch_size> pointers() const {
        const Lanes l = store(low), m = store(middle), h = store(high);
        std::array<const Pointee*, batch_size> result;
        for (std::size_t i = 0; i < batch_size; ++i)
            result[i] = AddressOf<float>{l[i], m[i], h[i]}.template pointer<Pointee>();
        return result;
    }
};

/// One of a lobe's parameters, as a material has them: `count` numbers between low and high, 3 of a colour.
struct LobeParameter {
    std::string_view name;
    std::size_t count;
    float low, high;
};

/// One list after the other.
template <std::size_t m, std::size_t n>
constexpr std::array<LobeParameter, m + n> joined(const std::array<LobeParameter, m>& a,
                                                  const std::array<LobeParameter, n>& b) {
    std::array<LobeParameter, m + n> both{};
    std::copy(a.begin(), a.end(), both.begin());
    std::copy(b.begin(), b.end(), both.begin() + m);
    return both;
}

}  // namespace pivot
