// Orthonormal frames: the local space of a BSDF has the shading normal as z.
#pragma once

#include "core/math/vector.h"

namespace pivot {

template <class T>
struct Frame {
    Vec3<T> x, y, z;

    Vec3<T> to_local(const Vec3<T>& v) const { return {dot(v, x), dot(v, y), dot(v, z)}; }
    Vec3<T> to_world(const Vec3<T>& v) const { return v.x * x + v.y * y + v.z * z; }
};

/// Any right-handed frame whose z is the unit vector `z`, without a branch [Duff17, JCGT 6(1), listing 3].
template <class T>
Frame<T> frame_from_z(const Vec3<T>& z) {
    const T sign = select(z.z < T(0), T(-1), T(1));
    const T a = -inverse(sign + z.z);
    const T b = z.x * z.y * a;
    return {{T(1) + sign * z.x * z.x * a, sign * b, -sign * z.x}, {b, sign + z.y * z.y * a, -z.y}, z};
}

/// The frame about the unit vector `z` with the unit vector `towards` at azimuth 0; any frame if they are parallel.
template <class T>
Frame<T> frame_from_z(const Vec3<T>& z, const Vec3<T>& towards) {
    // Of the small vector between the two, whose own rounding is small; projecting it forgives lengths that are not
    // quite 1.
    const Vec3<T> between = select(dot(z, towards) > T(0), towards - z, towards + z);
    const Vec3<T> across = between - dot(between, z) * z;
    const T l2 = length_squared(across), least = tiny<T> / std::numeric_limits<T>::epsilon();
    const Vec3<T> x = select(l2 > least, across / sqrt(max(l2, least)), frame_from_z(z).x);
    return {x, cross(z, x), z};
}

}  // namespace pivot
