// Vectors are GLM's, over any number type.
#pragma once

#include <concepts>
#include <glm/glm.hpp>

#include "core/math/number.h"

namespace pivot {

template <class T>
using Vec2 = glm::vec<2, T>;
template <class T>
using Vec3 = glm::vec<3, T>;
/// Column-major, as in GLM: m[column][row].
template <class T>
using Mat3 = glm::mat<3, 3, T>;

using Vec2f = Vec2<float>;
using Vec3f = Vec3<float>;
/// Linear scene-referred RGB: radiance, reflectance.
using Rgb = Vec3<float>;

using glm::cross;
using glm::dot;

template <class T>
T length_squared(const Vec3<T>& v) {
    return dot(v, v);
}

template <class T>
T length(const Vec3<T>& v) {
    return sqrt(dot(v, v));
}

template <class T>
Vec3<T> normalize(const Vec3<T>& v) {
    return v * inverse_sqrt(dot(v, v));
}

/// Lane by lane; select(bool, ...) chooses a whole vector.
template <class T, class M>
requires(!std::same_as<M, bool>) Vec3<T> select(const M& condition, const Vec3<T>& a, const Vec3<T>& b) {
    return {select(condition, a.x, b.x), select(condition, a.y, b.y), select(condition, a.z, b.z)};
}

// GLM's own compare with a bool.
template <class T>
Vec3<T> min(const Vec3<T>& a, const Vec3<T>& b) {
    return {min(a.x, b.x), min(a.y, b.y), min(a.z, b.z)};
}
template <class T>
Vec3<T> max(const Vec3<T>& a, const Vec3<T>& b) {
    return {max(a.x, b.x), max(a.y, b.y), max(a.z, b.z)};
}
template <class T>
Vec3<T> abs(const Vec3<T>& v) {
    return {abs(v.x), abs(v.y), abs(v.z)};
}

template <class T>
T max_component(const Vec3<T>& c) {
    return max(max(c.x, c.y), c.z);
}
template <class T>
T mean_component(const Vec3<T>& c) {
    return (c.x + c.y + c.z) * T(1.0f / 3.0f);
}

}  // namespace pivot
