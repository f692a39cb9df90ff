// Directions of the surface, and normals that textures turn.
#include "core/shaders/ops/spaces.h"
#include "core/shaders/ops/tables.h"

namespace pivot {
namespace {

const Batch zero(0.0f), one(1.0f);

/// Across the normal, of a direction in object space; a tangent is turned as normals are. [Cycles 4.5 svm/tex_coord.h]
Vec3b tangent(const Place& place, const Vec3b& direction) {
    const Vec3b along = world_from_object_normal(place, direction);
    return cross(place.normal, unit(cross(along, place.normal)));
}

/// [0, 1] stands for [-1, 1].
Vec3b decoded(const Vec3b& colour) { return Batch(2.0f) * colour - Vec3b(one); }

Vec3b or_own(const Place& place, const Vec3b& normal) {
    return select(dot(normal, normal) > zero, normal, place.normal);
}

/// sign: of the bitangent; 0 where the mesh has no tangents. [Cycles 4.5 svm/tex_coord.h:260-305]
Vec3b normal_map_tangent(const Place& place, const Vec3b& colour, Batch strength, const Vec3b& along, Batch sign) {
    if (place.lanes.is_world()) return place.normal;
    const HitTriangleOf<Batch>& t = place.lanes.corners;
    const Vec2b& b = place.barycentric;
    const Vec3b n = (one - b.x - b.y) * t.normal_a + b.x * t.normal_b + b.y * t.normal_c;
    const Vec3b flat = object_from_world_normal(place, place.lanes.front * place.normal_geometric);
    const Vec3b up = select(dot(n, n) > zero, n, flat);
    const Vec3b c = decoded(colour);
    const Vec3b turned = c.x * strength * along + c.y * strength * sign * cross(up, along) +
                         (one + (c.z - one) * clamp01(strength)) * up;
    const Vec3b world = world_from_object_normal(place, turned) * place.lanes.front;
    return select(sign != zero, or_own(place, world), place.normal);
}

/// From the surface's own normal, so much of the way to another.
Vec3b normal_part(const Place& place, const Vec3b& normal, Batch strength) {
    const Vec3b part = unit(place.normal + (normal - place.normal) * max(strength, zero));
    return or_own(place, select(strength == one, normal, part));
}

Vec3b normal_map_object(const Place& place, const Vec3b& colour, Batch strength) {
    return normal_part(place, place.lanes.front * world_from_object_normal(place, decoded(colour)), strength);
}

Vec3b normal_map_world(const Place& place, const Vec3b& colour, Batch strength) {
    return normal_part(place, place.lanes.front * unit(decoded(colour)), strength);
}

/// Heights here and at the two places beside that the filter width tells. settings: that, whether the height is
/// measured in object space, whether the normal is kept from mirroring below the surface. [Cycles 4.5 svm/displace.h;
/// Mikkelsen10, Bump Mapping Unparametrized Surfaces on the GPU]
Vec3b bump(Settings<3> settings, const Place& place, const Vec3b& normal, const Vec3b& heights, Batch strength,
           Batch distance) {
    if (place.lanes.is_world()) return normal;
    const Batch width(settings[0]);
    const bool in_object = settings[1] > 0.0f;
    auto [x, y] = bump_directions(place.normal_geometric);
    x *= place.lanes.footprint_m, y *= place.lanes.footprint_m;
    const Vec3b n = in_object ? object_from_world_normal(place, normal) : normal;
    if (in_object) x = object_from_world_vector(place, x), y = object_from_world_vector(place, y);
    const Vec3b across_x = cross(y, n), across_y = cross(n, x);
    const Batch area = dot(x, across_x);
    const Vec3b slope = (heights.y - heights.x) * across_x + (heights.z - heights.x) * across_y;
    const Batch rise = select(area < zero, -distance, distance);
    const Vec3b bumped = unit(width * abs(area) * n - rise * slope);
    const Batch share = max(strength, zero);
    const Vec3b turned = select(dot(bumped, bumped) > zero, unit(share * bumped + (one - share) * n), n);
    const Vec3b world = in_object ? world_from_object_normal(place, turned) : turned;
    return settings[2] > 0.0f ? reflecting_normal(place.normal_geometric, place.lanes.wo, world) : world;
}

constexpr std::array ops{
    op<tangent>("tangent"),
    op<normal_part>("normal_part"),
    op<normal_map_tangent>("normal_map_tangent"),
    op<normal_map_object>("normal_map_object"),
    op<normal_map_world>("normal_map_world"),
    op<bump>("bump"),
};

}  // namespace

std::span<const OpKind> normal_ops() { return ops; }

}  // namespace pivot
