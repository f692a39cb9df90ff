// Scalars: what the core needs of a number type T, so that one body serves float, double and a SIMD batch.
// Code templated over T calls sqrt, atan2, ... unqualified and chooses with select(): no branch on a T.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace pivot {

using std::abs;
using std::acos;
using std::asin;
using std::asinh;
using std::atan;
using std::atan2;
using std::cbrt;
using std::cos;
using std::cosh;
using std::erf;
using std::erfc;
using std::exp;
using std::expm1;
using std::floor;
using std::log;
using std::log1p;
using std::max;
using std::min;
using std::pow;
using std::sin;
using std::sinh;
using std::sqrt;
using std::tan;

template <class T>
inline constexpr T pi = T(3.14159265358979323846);

/// The smallest normal number: max(x, tiny<T>) is what to divide by where x may be 0.
template <class T>
inline constexpr T tiny = std::numeric_limits<T>::min();

/// What comparing two T gives: bool, or a SIMD mask.
template <class T>
using Mask = decltype(T() < T());

/// `condition ? a : b` lane by lane.
template <class T>
constexpr T select(bool condition, T a, T b) {
    return condition ? a : b;
}

/// Whether a condition holds in some lane: what a branch around work for all lanes asks.
constexpr bool any(bool condition) { return condition; }

/// 1 / x of a normal number. A batch of floats has it and the next to a unit or two in the last place, faster than it
/// divides: for the rest, a / b.
template <class T>
T inverse(T x) {
    return T(1) / x;
}

/// 1 / sqrt(x) of a normal number.
template <class T>
T inverse_sqrt(T x) {
    return T(1) / sqrt(x);
}

template <class T>
constexpr T sqr(T x) {
    return x * x;
}

/// sqrt of a value that is >= 0 but for rounding.
template <class T>
T safe_sqrt(T x) {
    return sqrt(max(x, T(0)));
}

template <class T>
constexpr T clamp01(T x) {
    return min(max(x, T(0)), T(1));
}

template <class T>
constexpr T lerp(T a, T b, T t) {
    return a + (b - a) * t;
}

}  // namespace pivot
