// Between world, object and camera space at a place. In the world's shader there is no object: its space is the
// world's. Camera space is that of the camera's projection.
#pragma once

#include "core/shaders/ops/math.h"
#include "core/shaders/place.h"

namespace pivot {

/// v / |v|, and 0 of 0.
inline Vec3b unit(const Vec3b& v) {
    const Batch size = sqrt(dot(v, v));
    return {divided(v.x, size), divided(v.y, size), divided(v.z, size)};
}

inline Vec3b world_from_object_vector(const Place& place, const Vec3b& v) {
    return place.lanes.corners.world_from_object.vector(v);
}
inline Vec3b world_from_object_point(const Place& place, const Vec3b& p) {
    return place.lanes.corners.world_from_object.point(p);
}
/// Unit.
inline Vec3b world_from_object_normal(const Place& place, const Vec3b& n) {
    return place.lanes.is_world() ? n : unit(place.lanes.corners.normal_matrix * n);
}

/// 0 of an object that is scaled flat.
inline Vec3b object_from_world_vector(const Place& place, const Vec3b& v) {
    if (place.lanes.is_world()) return v;
    const Mat3<Batch>& linear = place.lanes.corners.world_from_object.linear;
    const Mat3<Batch>& cofactors = place.lanes.corners.normal_matrix;
    const Batch size = divided(Batch(1.0f), abs(dot(linear[0], cofactors[0])));
    return Vec3b(dot(cofactors[0], v), dot(cofactors[1], v), dot(cofactors[2], v)) * size;
}
inline Vec3b object_from_world_point(const Place& place, const Vec3b& p) {
    return object_from_world_vector(place, p - place.lanes.corners.world_from_object.translation);
}
/// Unit.
inline Vec3b object_from_world_normal(const Place& place, const Vec3b& n) {
    if (place.lanes.is_world()) return n;
    const Mat3<Batch>& linear = place.lanes.corners.world_from_object.linear;
    return unit(Vec3b(dot(linear[0], n), dot(linear[1], n), dot(linear[2], n)));
}

inline TransformOf<Batch> broadcast(const Transform& t) {
    return {{broadcast(t.linear[0]), broadcast(t.linear[1]), broadcast(t.linear[2])}, broadcast(t.translation)};
}

inline Vec3b camera_from_world_vector(const Place& place, const Vec3b& v) {
    return broadcast(place.lanes.camera->camera_from_world).vector(v);
}
inline Vec3b camera_from_world_point(const Place& place, const Vec3b& p) {
    return broadcast(place.lanes.camera->camera_from_world).point(p);
}
inline Vec3b world_from_camera_vector(const Place& place, const Vec3b& v) {
    return broadcast(place.lanes.camera->world_from_camera).vector(v);
}
inline Vec3b world_from_camera_point(const Place& place, const Vec3b& p) {
    return broadcast(place.lanes.camera->world_from_camera).point(p);
}

}  // namespace pivot
