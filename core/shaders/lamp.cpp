#include "core/shaders/lamp.h"

namespace pivot {
namespace {

/// Where a ray meets a lamp.
struct LampPlace {
    Vec3b position, normal;
    Vec2b uv;  ///< [0, 1] over an area light
    Batch distance_m;
};

LampPlace place_on(const SphereLight& sphere, const Vec3b& from, const Vec3b& wi) {
    const Vec3b to_center = broadcast(sphere.center) - from;
    if (sphere.is_facing_disk) {
        const Batch distance_m = distance_to_facing_disk(to_center, wi);
        return {from + distance_m * wi, -wi, {}, distance_m};
    }
    const Batch distance_m = distance_to_sphere(to_center, Batch(sphere.radius_m), wi);
    const Vec3b outward = distance_m * wi - to_center;
    const Batch size = length(outward);
    const Vec3b normal = select(size > Batch(tiny<float>), outward / max(size, Batch(tiny<float>)), -wi);
    return {from + distance_m * wi, normal, {}, distance_m};
}

LampPlace place_on(const SpotLight& spot, const Vec3b& from, const Vec3b& wi) {
    return place_on(spot.sphere, from, wi);
}

LampPlace place_on(const SunLight&, const Vec3b&, const Vec3b& wi) {
    return {wi, -wi, {}, std::numeric_limits<Batch>::max()};
}

LampPlace place_on(const AreaLight& light, const Vec3b& from, const Vec3b& wi) {
    const Vec3b normal = broadcast(light.normal);
    const Batch distance_m = dot(broadcast(light.center) - from, normal) / dot(wi, normal);
    const Vec3b position = from + distance_m * wi, offset = position - broadcast(light.center);
    // The sides of a lamp that its object shears need not be at right angles.
    const Vec3f across_v = cross(light.half_v, light.normal), across_u = cross(light.half_u, light.normal);
    const Batch u = dot(offset, broadcast(across_v / dot(across_v, light.half_u)));
    const Batch v = dot(offset, broadcast(across_u / dot(across_u, light.half_v)));
    const Batch half(0.5f);
    return {position, normal, {half * v + half, half * u + half}, distance_m};
}

}  // namespace

Vec3b lamp_share(const LampView& lamp, const Light& light, const Vec3b& from, const Vec3b& wi, std::uint32_t bounce,
                 Registers& registers) {
    if (lamp.shader.is_constant()) return broadcast(lamp.shader.constants.emission);
    const LampPlace met = std::visit([&](const auto& kind) { return place_on(kind, from, wi); }, light);
    const PlaceLanes lanes{.meshes = {},
                           .objects = {},
                           .triangles = {},
                           .corners = {},
                           .wo = -wi,
                           .front = Batch(1.0f),
                           .ray_length_m = met.distance_m,
                           .ray_kind = WordBatch(0u),
                           .bounce = WordBatch(bounce),
                           .camera = &lamp.camera,
                           .footprint_m = Batch(0.0f)};
    const Place place{.lanes = lanes,
                      .position = met.position,
                      .normal = met.normal,
                      .normal_geometric = met.normal,
                      .barycentric = {met.uv.y, Batch(1.0f) - met.uv.x - met.uv.y},
                      .position_object = met.position};
    const std::array places{place, place, place};
    lamp.shader.program.run(places, registers);
    return material_at(lamp.shader, registers).emission;
}

Rgb lamp_share(const LampView& lamp, const Light& light, const Vec3f& from, const Vec3f& wi, std::uint32_t bounce,
               Registers& registers) {
    const Vec3b share = lamp_share(lamp, light, broadcast(from), broadcast(wi), bounce, registers);
    return {store(share.x)[0], store(share.y)[0], store(share.z)[0]};
}

}  // namespace pivot
