// The curve of sRGB, IEC 61966-2-1, over floats or batches; 0 below 0.
#pragma once

#include "core/math/number.h"

namespace pivot {

template <class T>
T linear_from_srgb(T encoded) {
    const T toe = max(encoded, T(0)) * T(1 / 12.92f);
    return select(encoded < T(0.04045f), toe, T(pow(max((encoded + T(0.055f)) * T(1 / 1.055f), T(0)), T(2.4f))));
}

template <class T>
T srgb_from_linear(T linear) {
    const T toe = max(linear, T(0)) * T(12.92f);
    return select(linear < T(0.0031308f), toe, T(T(1.055f) * pow(max(linear, T(0)), T(1 / 2.4f)) - T(0.055f)));
}

}  // namespace pivot
