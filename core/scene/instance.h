// A mesh where it stands: its transform, its materials, and what its shaders may ask of it.
#pragma once

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "core/math/moving_transform.h"
#include "core/shaders/place.h"

namespace pivot {

struct Instance {
    std::string name;
    std::uint32_t mesh;
    Transform world_from_object;
    std::vector<std::uint32_t> materials;  ///< per slot; a slot past the end uses the last
    std::uint32_t visibility;
    float matte_object = 0.0f, matte_asset = 0.0f;  ///< ids of mattes
    bool is_holdout = false;                        ///< a camera sees a hole in its place
    ObjectFacts facts{};
    Mat3<float> normal_matrix{1.0f};                  ///< of world_from_object; the scene sets it
    std::shared_ptr<const MovingTransform> motion{};  ///< null: it stays where it is
};

/// own: the instance's mesh, here and below.
inline std::uint32_t material_of(const Instance& instance, const Mesh& own, std::uint32_t triangle) {
    const std::size_t slot = own.triangle_slots.empty() ? 0 : own.triangle_slots[triangle];
    return instance.materials[std::min(slot, instance.materials.size() - 1)];
}

/// In the middle of all times.
inline HitTriangleOf<float> triangle_of(const Instance& instance, const Mesh& own, std::uint32_t triangle) {
    const Triangle& t = own.triangles[triangle];
    const std::array<Vec3f, 3> normals = own.normals(triangle);
    return {.corner_a = own.positions[t.x],
            .corner_b = own.positions[t.y],
            .corner_c = own.positions[t.z],
            .normal_a = normals[0],
            .normal_b = normals[1],
            .normal_c = normals[2],
            .world_from_object = instance.world_from_object,
            .normal_matrix = instance.normal_matrix};
}

inline HitTriangleOf<float> triangle_at(const Instance& instance, const Mesh& own, std::uint32_t triangle, float time) {
    HitTriangleOf<float> at = triangle_of(instance, own, triangle);
    at.time = time;
    if (instance.motion) {
        at.world_from_object = instance.motion->at(time);
        at.normal_matrix = at.world_from_object.normal_matrix();
    }
    if (own.steps.empty()) return at;
    const BetweenSteps between(time, own.steps.size());
    const MeshStep &a = own.steps[between.first], &b = own.steps[between.first + 1];
    const Triangle& t = own.triangles[triangle];
    at.corner_a = between.of(a.positions[t.x], b.positions[t.x]);
    at.corner_b = between.of(a.positions[t.y], b.positions[t.y]);
    at.corner_c = between.of(a.positions[t.z], b.positions[t.z]);
    const std::array<Vec3f, 3> first = own.normals(triangle, a), second = own.normals(triangle, b);
    at.normal_a = between.of(first[0], second[0]);
    at.normal_b = between.of(first[1], second[1]);
    at.normal_c = between.of(first[2], second[2]);
    return at;
}

}  // namespace pivot
