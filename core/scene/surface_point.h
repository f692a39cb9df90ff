// A ray's hit made ready for shading: place, frame, and where rays may start from it. Over float or batches.
#pragma once

#include "core/bsdf/surface.h"
#include "core/math/frame.h"
#include "core/math/transform.h"

namespace pivot {

template <class T>
struct SurfacePointOf {
    Vec3<T> position;
    Vec3<T> normal_geometric;  ///< towards the viewer
    Frame<T> frame;            ///< z: the shading normal, towards the viewer
    T error_m;                 ///< bound of position's rounding error
    T front;                   ///< 1: normal_geometric is the triangle's own; -1: that turned
    Vec3<T> wo_local;

    /// Whether both the shading and the true surface face a direction.
    Mask<T> faces(const Vec3<T>& wi) const { return dot(wi, normal_geometric) > T(0) && dot(wi, frame.z) > T(0); }

    /// A start for rays that leave towards wi without meeting this surface again.
    Vec3<T> ray_origin(const Vec3<T>& wi) const {
        return position + normal_geometric * select(dot(wi, normal_geometric) > T(0), error_m, -error_m);
    }
};

using SurfacePoint = SurfacePointOf<float>;

/// The triangle that a ray hit, in object space.
template <class T>
struct HitTriangleOf {
    Vec3<T> corner_a, corner_b, corner_c;
    Vec3<T> normal_a, normal_b, normal_c;  ///< 0: flat shading
    TransformOf<T> world_from_object;
    Mat3<T> normal_matrix;
};

/// barycentric: weights of the second and third corner. wo: unit.
template <class T>
SurfacePointOf<T> surface_point(const HitTriangleOf<T>& triangle, const Vec2<T>& barycentric, const Vec3<T>& wo) {
    const Vec3<T>&a = triangle.corner_a, &b = triangle.corner_b, &c = triangle.corner_c;
    const TransformOf<T>& transform = triangle.world_from_object;
    SurfacePointOf<T> point;
    // From the triangle, not along the ray: the error is then that of the surface, not of the ray's length.
    point.position = transform.point(a + barycentric.x * (b - a) + barycentric.y * (c - a));
    // Rounding is relative to what is summed, the corners, not to a sum that may be 0.
    const Vec3<T> corner_size = max(max(abs(a), abs(b)), abs(c));
    const Vec3<T> magnitude = abs(transform.linear[0]) * corner_size.x + abs(transform.linear[1]) * corner_size.y +
                              abs(transform.linear[2]) * corner_size.z + abs(transform.translation);
    constexpr float error_per_magnitude = 0x1p-20f;  // a few roundings of 2^-24 each, with room
    point.error_m = T(error_per_magnitude) * max_component(magnitude);

    const Vec3<T> across = triangle.normal_matrix * cross(b - a, c - a);
    const T across2 = length_squared(across);
    // Rays meet corners on one line by rounding: such a sliver faces the viewer.
    const Vec3<T> normal = select(across2 >= tiny<T>, across * inverse_sqrt(max(across2, tiny<T>)), wo);
    const Vec3<T> n = triangle.normal_matrix * ((T(1) - barycentric.x - barycentric.y) * triangle.normal_a +
                                                barycentric.x * triangle.normal_b + barycentric.y * triangle.normal_c);
    const T n2 = length_squared(n);
    const Vec3<T> smooth = select(n2 >= tiny<T>, n * inverse_sqrt(max(n2, tiny<T>)), normal);
    point.front = select(dot(normal, wo) >= T(0), T(1), T(-1));
    point.normal_geometric = normal * point.front;
    // A normal of the wrong side (flipped custom normals) is turned with the surface it belongs to.
    const Vec3<T> towards_viewer = smooth * select(dot(smooth, point.normal_geometric) < T(0), T(-1), T(1));
    // Shading normals may lean away from the viewer where the surface is seen; there they are bent until wo lies above.
    constexpr float min_cos = 1e-3f;
    const T cos_o = dot(towards_viewer, wo);
    const Vec3<T> bent = normalize(towards_viewer + (T(2.0f * min_cos) - cos_o) * wo);
    point.frame = frame_from_z(select(cos_o < T(min_cos), bent, towards_viewer));
    point.wo_local = point.frame.to_local(wo);
    return point;
}

}  // namespace pivot
