// Differences that cancel, written so that they keep their bits.
#pragma once

#include "core/math/number.h"

namespace pivot {

/// 1 - cos(angle).
template <class T>
T versine_of_angle(T angle_rad) {
    return T(2) * sqr(sin(angle_rad * T(0.5)));
}

/// The angle in [0, pi] of 1 - cos(angle), given with its complement 1 + cos(angle).
template <class T>
T angle_of_versine(T versine, T complement) {
    const T smaller = T(2) * asin(safe_sqrt(T(0.5) * min(versine, complement)));
    return select(versine > complement, pi<T> - smaller, smaller);
}

/// x - sin x for x >= 0.
template <class T>
T x_minus_sin(T x) {
    const T x2 = x * x;
    T series = T(1);
    for (int k = 18; k >= 4; k -= 2) series = T(1) - x2 / T(k * (k + 1)) * series;
    return select(x < T(1.5), x2 * x / T(6) * series, x - sin(x));
}

/// x - atan x for x >= 0.
template <class T>
T x_minus_atan(T x) {
    const T x2 = x * x;
    T series = T(0);
    for (int k = 45; k >= 3; k -= 2) series = T(1) / T(k) - x2 * series;
    return select(x < T(0.45), x2 * x * series, x - atan(x));
}

}  // namespace pivot
