// What a place itself has: where it is, how it faces, and the same in other spaces.
#include "core/shaders/ops/spaces.h"
#include "core/shaders/ops/tables.h"

namespace pivot {
namespace {

/// Object space. Beside a place it is that of the mesh there. [Cycles 4.5 svm/tex_coord.h:89-118]
Vec3b normal_object(const Place& place) {
    if (place.lanes.is_world()) return place.normal;
    const Batch front = place.lanes.front;
    const Vec3b n = smooth_normal(place.lanes.corners, place.barycentric, front * place.normal_geometric);
    return object_from_world_normal(place, front * n);
}

Vec3b reflection(const Place& place) {
    const Vec3b& wo = place.lanes.wo;
    return place.lanes.is_world() ? wo : Batch(2.0f) * dot(place.normal, wo) * place.normal - wo;
}

/// Camera space, and of the world a place as far as 1 m that way.
Vec3b position_camera(const Place& place) {
    return place.lanes.is_world() ? camera_from_world_vector(place, place.position)
                                  : camera_from_world_point(place, place.position);
}

/// Where a projection shows what is there in camera space.
Vec2b place_of(const Perspective&, const Vec3b& c) { return {divided(c.x, c.z), divided(c.y, c.z)}; }
Vec2b place_of(const Orthographic&, const Vec3b& c) { return {c.x, c.y}; }
template <class AnyPanorama>
Vec2b place_of(const AnyPanorama& panorama, const Vec3b& c) {
    return panorama.place(unit(c));
}

/// 0 to 1 over the frame.
Vec3b window(const Place& place) {
    const CameraFacts& camera = *place.lanes.camera;
    const Vec3b c = position_camera(place);
    const Vec2b at = std::visit([&](const auto& kind) { return place_of(kind, c); }, camera.projection);
    return {at.x * Batch(camera.window_scale.x) + Batch(camera.window_offset.x),
            at.y * Batch(camera.window_scale.y) + Batch(camera.window_offset.y), Batch(0.0f)};
}

/// The direction from the camera in its space, the depth, and the distance.
std::tuple<Vec3b, Batch, Batch> camera_data(const Place& place) {
    const Vec3b c = camera_from_world_point(place, place.position);
    return {unit(c), c.z, length(c)};
}

/// settings: a row-major 3 x 4 matrix, which takes the place in world space to another.
Vec3b position_in(Settings<12> settings, const Place& place) {
    const auto row = [&](std::size_t first) {
        const auto m = [&](std::size_t i) { return Batch(settings[first + i]); };
        return m(0) * place.position.x + m(1) * place.position.y + m(2) * place.position.z + m(3);
    };
    return {row(0), row(4), row(8)};
}

/// 1 near the triangle's edges. settings: whether the size counts in pixels. [Cycles 4.5 svm/wireframe.h]
Batch wireframe(Settings<1> settings, const Place& place, Batch size) {
    if (place.lanes.is_world()) return Batch(0.0f);
    const auto& [a, b, c] =
        std::tie(place.lanes.corners.corner_a, place.lanes.corners.corner_b, place.lanes.corners.corner_c);
    Batch width = size;
    if (settings[0] > 0.0f) {
        const auto seen = [&](const Vec3b& d) { return length(d - dot(d, place.lanes.wo) * place.lanes.wo); };
        const auto [x, y] = bump_directions(place.normal_geometric);
        width = size * place.lanes.footprint_m * Batch(0.5f) * (seen(x) + seen(y));
    }
    const Batch half2 = sqr(Batch(0.5f) * width);
    const std::array corners{world_from_object_point(place, a), world_from_object_point(place, b),
                             world_from_object_point(place, c)};
    BatchMask near(false);
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3b edge = corners[(i + 1) % 3] - corners[i];
        near = near || length_squared(cross(edge, place.position - corners[i])) < length_squared(edge) * half2;
    }
    return select(near, Batch(1.0f), Batch(0.0f));
}

constexpr std::array ops{
    op<[](const Place& place) { return place.position; }>("position"),
    op<[](const Place& place) { return place.position_object; }>("position_object"),
    op<position_in>("position_in"),
    op<position_camera>("position_camera"),
    op<window>("window"),
    op<camera_data>("camera_data"),
    op<[](const Place& place) { return place.normal; }>("normal"),
    op<normal_object>("normal_object"),
    op<[](const Place& place) { return place.normal_geometric; }>("true_normal"),
    op<[](const Place& place) { return place.lanes.wo; }>("incoming"),
    op<reflection>("reflection"),
    op<[](const Place& place) {
        const Vec2b& b = place.barycentric;
        return Vec3b(Batch(1.0f) - b.x - b.y, b.x, Batch(0.0f));
    }>("parametric"),
    op<[](const Place& place) { return select(place.lanes.front < Batch(0.0f), Batch(1.0f), Batch(0.0f)); }>(
        "backfacing"),
    op<wireframe>("wireframe"),
    op<world_from_object_point>("world_from_object_point"),
    op<world_from_object_vector>("world_from_object_vector"),
    op<world_from_object_normal>("world_from_object_normal"),
    op<object_from_world_point>("object_from_world_point"),
    op<object_from_world_vector>("object_from_world_vector"),
    op<object_from_world_normal>("object_from_world_normal"),
    op<camera_from_world_point>("camera_from_world_point"),
    op<camera_from_world_vector>("camera_from_world_vector"),
    op<world_from_camera_point>("world_from_camera_point"),
    op<world_from_camera_vector>("world_from_camera_vector"),
};

}  // namespace

std::span<const OpKind> geometry_ops() { return ops; }

}  // namespace pivot
