// Affine transforms of points and normals.
#pragma once

#include "core/math/vector.h"

namespace pivot {

template <class T>
struct TransformOf {
    Mat3<T> linear{T(1)};
    Vec3<T> translation{T(0)};

    Vec3<T> point(const Vec3<T>& p) const { return linear * p + translation; }
    Vec3<T> vector(const Vec3<T>& v) const { return linear * v; }

    /// Of one that has an inverse.
    TransformOf inverse() const {
        const Mat3<T> back = glm::inverse(linear);
        return {back, -(back * translation)};
    }

    /// Whether the inverse holds in float: false for an object scaled flat, or to nothing.
    bool is_invertible() const {
        const T determinant = dot(linear[0], cross(linear[1], linear[2]));
        const T volume = length(linear[0]) * length(linear[1]) * length(linear[2]);
        return std::abs(determinant) > T(1e-6f) * volume && std::isfinite(T(1) / determinant);
    }

    /// Takes normals to normals' directions, not unit: the cofactors, which serve where an object is scaled flat and
    /// has no inverse.
    Mat3<T> normal_matrix() const {
        const Mat3<T> cofactors(cross(linear[1], linear[2]), cross(linear[2], linear[0]), cross(linear[0], linear[1]));
        return dot(linear[0], cofactors[0]) < T(0) ? -cofactors : cofactors;
    }
    Vec3<T> normal(const Vec3<T>& n) const { return normal_matrix() * n; }
};

using Transform = TransformOf<float>;

}  // namespace pivot
