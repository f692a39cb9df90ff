// A mesh where it stands: its transform, its materials, and what its shaders may ask of it.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "core/scene/light_links.h"
#include "core/shaders/place.h"

namespace pivot {

/// Of what shines: none of those that passes show apart.
inline constexpr std::uint32_t no_light_group = ~0u;

struct Instance {
    std::string name;
    std::uint32_t mesh;
    Transform world_from_object;
    std::vector<std::uint32_t> materials;  ///< per slot; a slot past the end uses the last
    std::uint32_t visibility;
    float matte_object = 0.0f, matte_asset = 0.0f;  ///< ids of mattes
    bool is_holdout = false;                        ///< a camera sees a hole in its place
    std::uint32_t light_group = no_light_group;     ///< that the light which leaves it of its own is of
    LightLinks links{};                             ///< of that light
    LinkSets link_sets{};                           ///< by which other lights find it
    bool is_shadow_catcher = false;                 ///< a real thing's stand-in, for what others do to its light
    ObjectFacts facts{};
    Mat3<float> normal_matrix{1.0f};  ///< of world_from_object; the scene sets it
};

/// own: the instance's mesh, here and below.
inline std::uint32_t material_of(const Instance& instance, const Mesh& own, std::uint32_t triangle) {
    const std::size_t slot = own.triangle_slots.empty() ? 0 : own.triangle_slots[triangle];
    return instance.materials[std::min(slot, instance.materials.size() - 1)];
}

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

}  // namespace pivot
