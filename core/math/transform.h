// Affine transforms of float points and normals.
#pragma once

#include "core/math/vector.h"

namespace pivot {

struct Transform {
    Mat3<float> linear{1.0f};
    Vec3f translation{0.0f};

    Vec3f point(const Vec3f& p) const { return linear * p + translation; }
    Vec3f vector(const Vec3f& v) const { return linear * v; }

    /// Whether the inverse holds in float: false for an object scaled flat, or to nothing.
    bool is_invertible() const {
        const float determinant = dot(linear[0], cross(linear[1], linear[2]));
        const float volume = length(linear[0]) * length(linear[1]) * length(linear[2]);
        return std::abs(determinant) > 1e-6f * volume && std::isfinite(1.0f / determinant);
    }

    /// Takes normals to normals' directions, not unit: the cofactors, which serve where an object is scaled flat and
    /// has no inverse.
    Mat3<float> normal_matrix() const {
        const Mat3<float> cofactors(cross(linear[1], linear[2]), cross(linear[2], linear[0]),
                                    cross(linear[0], linear[1]));
        return dot(linear[0], cofactors[0]) < 0.0f ? -cofactors : cofactors;
    }
    Vec3f normal(const Vec3f& n) const { return normal_matrix() * n; }
};

}  // namespace pivot
