// Points of the unit square that are spread evenly, and uniform ones mapped to disks and hemispheres.
//
// [Shirley97]  A Low Distortion Map Between Disk and Square
#pragma once

#include "core/math/vector.h"

namespace pivot {

/// Number k of count points of the unit square, evenly spread: multiples of the golden ratio. Over float or batches.
template <class T>
Vec2<T> golden_point(const T& k, std::size_t count) {
    const T middle = k + T(0.5f), turns = middle * T(0.618034f);
    return {middle / T(static_cast<float>(count)), turns - floor(turns)};
}

/// Unit disk, concentric: neighbours stay neighbours [Shirley97].
template <class T>
Vec2<T> sample_disk(const Vec2<T>& u) {
    const T a = T(2) * u.x - T(1);
    const T b = T(2) * u.y - T(1);
    const Mask<T> steep = abs(b) > abs(a);
    const T radius = select(steep, b, a), other = select(steep, a, b);
    const T turn = pi<T> / T(4) * (other / select(radius == T(0), T(1), radius));
    const T across = radius * sin(turn), along = radius * cos(turn);
    return {select(steep, across, along), select(steep, along, across)};
}

/// Hemisphere about +z with pdf_omega = z / pi.
template <class T>
Vec3<T> sample_cosine_hemisphere(const Vec2<T>& u) {
    const Vec2<T> d = sample_disk(u);
    return {d.x, d.y, safe_sqrt(T(1) - d.x * d.x - d.y * d.y)};
}

}  // namespace pivot
