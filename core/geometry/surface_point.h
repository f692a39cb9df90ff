// A ray's hit made ready for shading: place, frame, and where rays may start from it. Over float or batches.
#pragma once

#include <array>

#include "core/math/frame.h"
#include "core/math/moving_transform.h"
#include "core/math/vector.h"

namespace pivot {

template <class T>
struct SurfacePointOf {
    Vec3<T> position;
    Vec3<T> normal_geometric;  ///< towards the viewer
    Frame<T> frame;            ///< z: the shading normal, towards the viewer
    T error_m;                 ///< bound of position's rounding error
    T front;                   ///< 1: normal_geometric is the triangle's own; -1: that turned
    Vec3<T> wo_local;
    T time = T(middle_time);  ///< when it is there: that of rays that leave it

    /// Whether both the shading and the true surface face a direction.
    Mask<T> faces(const Vec3<T>& wi) const { return dot(wi, normal_geometric) > T(0) && dot(wi, frame.z) > T(0); }

    /// A start for rays that leave towards wi without meeting this surface again.
    Vec3<T> ray_origin(const Vec3<T>& wi) const {
        return position + normal_geometric * select(dot(wi, normal_geometric) > T(0), error_m, -error_m);
    }
};

using SurfacePoint = SurfacePointOf<float>;

/// The point as it is lit from behind, for lobes that send light through: nothing but a Lambert lobe is seen by way of
/// it, so that wo_local stays.
inline SurfacePoint turned_over(const SurfacePoint& point) {
    SurfacePoint back = point;
    back.normal_geometric = -point.normal_geometric;
    back.frame = {point.frame.x, -point.frame.y, -point.frame.z};
    back.front = -point.front;
    return back;
}

/// The triangle that a ray hit, in object space.
template <class T>
struct HitTriangleOf {
    Vec3<T> corner_a, corner_b, corner_c;
    Vec3<T> normal_a, normal_b, normal_c;  ///< 0: flat shading
    TransformOf<T> world_from_object;
    Mat3<T> normal_matrix;
    T time = T(middle_time);  ///< when it is so
};

/// The smooth normal of the side that the triangle's own normal is of, world, unit. normal: that, where there is none.
template <class T>
Vec3<T> smooth_normal(const HitTriangleOf<T>& triangle, const Vec2<T>& barycentric, const Vec3<T>& normal) {
    const Vec3<T> n = triangle.normal_matrix * ((T(1) - barycentric.x - barycentric.y) * triangle.normal_a +
                                                barycentric.x * triangle.normal_b + barycentric.y * triangle.normal_c);
    const T n2 = length_squared(n);
    return select(n2 >= tiny<T>, n * inverse_sqrt(max(n2, tiny<T>)), normal);
}

/// Two directions of the surface that normal stands on. [Cycles 4.5 util/math_float3.h, make_orthonormals]
template <class T>
std::array<Vec3<T>, 2> bump_directions(const Vec3<T>& normal) {
    const Mask<T> is_diagonal = normal.x == normal.y && normal.x == normal.z;
    const Vec3<T> x = normalize(cross(Vec3<T>(select(is_diagonal, T(-1), T(1)), T(1), T(1)), normal));
    return {x, cross(normal, x)};
}

/// Shades as if the surface stood across `normal`, unit, of either side. wo: unit.
template <class T>
void turn_shading_normal(SurfacePointOf<T>& point, const Vec3<T>& normal, const Vec3<T>& wo) {
    // A normal of the wrong side (flipped custom normals) is turned with the surface it belongs to.
    const Vec3<T> towards_viewer = normal * select(dot(normal, point.normal_geometric) < T(0), T(-1), T(1));
    // Shading normals may lean away from the viewer where the surface is seen; there they are bent until wo lies above.
    constexpr float min_cos = 1e-3f;
    const T cos_o = dot(towards_viewer, wo);
    const Vec3<T> bent = normalize(towards_viewer + (T(2.0f * min_cos) - cos_o) * wo);
    point.frame = frame_from_z(select(cos_o < T(min_cos), bent, towards_viewer));
    point.wo_local = point.frame.to_local(wo);
}

/// The normal bent towards the surface's own where it would mirror wo below the surface: to just above it. [Cycles 4.5
/// closure/bsdf_util.h, ensure_valid_specular_reflection, from which the equation for the bent normal's cosine is]
template <class T>
Vec3<T> reflecting_normal(const Vec3<T>& geometric, const Vec3<T>& wo, const Vec3<T>& normal) {
    const T wo_z = dot(wo, geometric), least = min(T(0.9f) * wo_z, T(0.01f));
    const Vec3<T> mirrored = T(2) * dot(normal, wo) * normal - wo;
    const Vec3<T> across = normal - dot(normal, geometric) * geometric;
    const Vec3<T> x = across * inverse_sqrt(max(length_squared(across), tiny<T>));
    const T wo_x = dot(wo, x);
    const T a = max(sqr(wo_x) + sqr(wo_z), tiny<T>), b = T(2) * (a + wo_z * least), c = sqr(least + wo_z);
    const T root = safe_sqrt(sqr(b) - T(4) * a * c);
    const T z2 = T(0.25f) * (b + select(wo_x < T(0), root, -root)) / a;
    return select(dot(geometric, mirrored) >= least, normal, safe_sqrt(T(1) - z2) * x + safe_sqrt(z2) * geometric);
}

/// Shades as if the surface stood across `normal`, unit, which a shader chose. reflects: where there is more than a
/// diffuse lobe, which alone may be seen from behind its normal.
template <class T>
void set_shading_normal(SurfacePointOf<T>& point, const Vec3<T>& normal, const Vec3<T>& wo, const Mask<T>& reflects) {
    turn_shading_normal(point, reflecting_normal(point.normal_geometric, wo, normal), wo);
    point.frame = frame_from_z(select(reflects, point.frame.z, normal));
    const Vec3<T> wo_local = point.frame.to_local(wo);
    point.wo_local = select(reflects, wo_local, Vec3<T>(wo_local.x, wo_local.y, max(wo_local.z, T(1e-3f))));
}

/// Turns the shading frame about its normal until x lies along the tangent, unit, which need not lie in the surface.
template <class T>
void set_tangent(SurfacePointOf<T>& point, const Vec3<T>& tangent) {
    const Vec3<T> wo = point.frame.to_world(point.wo_local);
    point.frame = frame_from_z(point.frame.z, tangent);
    point.wo_local = point.frame.to_local(wo);
}

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
    point.front = select(dot(normal, wo) >= T(0), T(1), T(-1));
    point.normal_geometric = normal * point.front;
    turn_shading_normal(point, smooth_normal(triangle, barycentric, normal), wo);
    point.time = triangle.time;
    return point;
}

}  // namespace pivot
