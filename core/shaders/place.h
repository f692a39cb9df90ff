// Where a shader's program runs: a batch of places on surfaces, and what their rays and objects tell of them.
#pragma once

#include <functional>
#include <memory>
#include <span>

#include "core/geometry/mesh.h"
#include "core/geometry/projection.h"
#include "core/geometry/surface_point.h"
#include "core/simd/batch.h"

namespace pivot {

/// Numbers of an object by a name of its own.
struct ObjectAttribute {
    std::uint32_t id;  ///< of its name, in the scene
    std::array<float, 4> value;
};

/// What a shader may ask of an object.
struct ObjectFacts {
    std::shared_ptr<const std::vector<ObjectAttribute>> attributes;  ///< null: none
    Rgb color{1.0f};                                                 ///< Blender's own of the object
    float alpha = 1.0f;
    float random = 0.0f;  ///< [0, 1)
    float pass_index = 0.0f;
    float particle_index = 0.0f;
    Vec3f generated{0.0f};  ///< of the instance, where its instancer gives one
    Vec2f uv{0.0f};         ///< likewise
};

/// What a shader may ask of the camera.
struct CameraFacts {
    Transform world_from_camera;  ///< camera space is the projection's; unit axes
    Transform camera_from_world;
    Projection projection;
    Vec2f window_scale{1.0f};  ///< from a place of the projection to [0, 1] over the full frame
    Vec2f window_offset{0.0f};
    float clip_start_m = 0.0f;
};

/// By what kind of ray, Blender's Light Path tells them apart.
enum RayKind : std::uint32_t { camera_ray = 1, diffuse_ray = 2, glossy_ray = 4, transmission_ray = 8, shadow_ray = 16 };

/// Beside its kind, a ray's word tells how many transparent surfaces its path has passed so far.
inline constexpr std::uint32_t ray_kinds = 31, passed_one = 32;

/// What of the half space about a normal is open within a distance, as rays find it.
struct OpennessQuestion {
    Vec3b normal;  ///< world, unit
    Batch distance_m;
    std::uint32_t ray_count;
    bool only_own;  ///< what other objects hide counts as open
};

/// Answers with [0, 1] for the lanes' places, whichever neighbour asks.
using Openness = std::function<Batch(const OpennessQuestion&)>;

/// What the lanes' places have of their own, and their rays.
struct PlaceLanes {
    std::array<const Mesh*, batch_size> meshes;  ///< null: the world, at a direction, or a lamp
    std::array<const ObjectFacts*, batch_size> objects;
    std::array<std::uint32_t, batch_size> triangles;
    HitTriangleOf<Batch> corners;
    Vec3b wo;     ///< world, towards where the ray came from
    Batch front;  ///< 1, or -1 where the back is seen
    Batch ray_length_m;
    WordBatch ray_kind;  ///< with what it passed
    WordBatch bounce;
    const CameraFacts* camera;
    Batch footprint_m;                   ///< how wide the ray's part of a pixel is there
    const Openness* openness = nullptr;  ///< null: all is open

    /// Or a lamp, which has no object either.
    bool is_world() const { return meshes[0] == nullptr; }
};

/// One place of each lane, or its neighbour by a part of a pixel. The geometric normal is that of the triangle.
struct Place {
    const PlaceLanes& lanes;
    Vec3b position;          ///< world, m; of the world: the direction
    Vec3b normal;            ///< world, unit, of the side that is seen
    Vec3b normal_geometric;  ///< world, unit, towards the viewer
    Vec2b barycentric;       ///< weights of the second and third corner
    Vec3b position_object;
};

/// What a program takes differences of: the place itself, its neighbours along two directions of the surface at the
/// edges of the ray's footprint, and two more for each filter width of its bump mapping.
using Places = std::span<const Place>;

}  // namespace pivot
