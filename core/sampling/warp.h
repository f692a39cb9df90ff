// Uniform points of the unit square mapped to disks and hemispheres.
//
// [Shirley97]  A Low Distortion Map Between Disk and Square
#pragma once

#include "core/math/vector.h"

namespace pivot {

/// Unit disk, concentric: neighbours stay neighbours [Shirley97].
template <class T>
Vec2<T> sample_disk(const Vec2<T>& u) {
    const T a = T(2) * u.x - T(1);
    const T b = T(2) * u.y - T(1);
    if (a == T(0) && b == T(0)) return {T(0), T(0)};
    const bool steep = abs(b) > abs(a);
    const T radius = steep ? b : a;
    const T phi = steep ? pi<T> / T(2) - pi<T> / T(4) * (a / b) : pi<T> / T(4) * (b / a);
    return {radius * cos(phi), radius * sin(phi)};
}

/// The inverse of sample_disk.
template <class T>
Vec2<T> invert_disk(const Vec2<T>& d) {
    const T radius = sqrt(d.x * d.x + d.y * d.y);
    if (radius == T(0)) return {T(0.5), T(0.5)};
    T phi = atan2(d.y, d.x);
    // The wedge around +x or +y, of positive radius, or the one opposite.
    if (phi < -pi<T> / T(4)) phi += T(2) * pi<T>;
    const T quarters = T(4) / pi<T> * phi;
    T a, b;
    if (quarters <= T(1)) {
        a = radius, b = radius * quarters;
    } else if (quarters <= T(3)) {
        b = radius, a = radius * (T(2) - quarters);
    } else if (quarters <= T(5)) {
        a = -radius, b = -radius * (quarters - T(4));
    } else {
        b = -radius, a = radius * (quarters - T(6));
    }
    return {clamp01(T(0.5) * (a + T(1))), clamp01(T(0.5) * (b + T(1)))};
}

/// Hemisphere about +z with pdf_omega = z / pi.
template <class T>
Vec3<T> sample_cosine_hemisphere(const Vec2<T>& u) {
    const Vec2<T> d = sample_disk(u);
    return {d.x, d.y, safe_sqrt(T(1) - d.x * d.x - d.y * d.y)};
}

}  // namespace pivot
