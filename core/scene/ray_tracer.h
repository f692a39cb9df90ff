// Closest hits and occlusion over instanced meshes. The only place that knows Embree.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "core/math/transform.h"
#include "core/scene/mesh.h"

namespace pivot {

struct Ray {
    Vec3f origin;
    Vec3f direction;  ///< unit
    float near_m = 0.0f;
    float far_m = std::numeric_limits<float>::infinity();
};

struct RayHit {
    float distance_m;
    std::uint32_t instance;
    std::uint32_t triangle;
    Vec2f barycentric;  ///< weights of the triangle's second and third corner
};

/// Rays side by side, as SIMD makes them.
struct RayPacket {
    static constexpr std::size_t width = 16;
    using Values = std::array<float, width>;
    alignas(64) Values origin_x, origin_y, origin_z, direction_x, direction_y, direction_z;
    Values far_m;  ///< not above 0: there is no such ray
};

/// Who sees an instance.
enum Visibility : std::uint32_t { visible_to_camera = 1, visible_to_light = 2, visible_to_all = 3 };

class RayTracer {
   public:
    RayTracer();
    ~RayTracer();
    RayTracer(const RayTracer&) = delete;
    RayTracer& operator=(const RayTracer&) = delete;

    /// The mesh's vectors are read in place: they must outlive the tracer and keep their addresses.
    void set_mesh(std::uint32_t mesh_id, const Mesh& mesh);
    void set_instance(std::uint32_t instance_id, std::uint32_t mesh_id, const Transform& world_from_object,
                      std::uint32_t visibility);
    void remove_instance(std::uint32_t instance_id);
    /// Builds what has changed. Throws std::bad_alloc, or std::runtime_error with Embree's message.
    void commit();

    std::optional<RayHit> intersect(const Ray& ray, Visibility from) const;
    bool occluded(const Ray& ray) const;

    /// Many at once, in SIMD packets of neighbours in the span: up to 3 times the rate. hits: one per ray.
    void intersect(std::span<const Ray> rays, Visibility from, std::span<std::optional<RayHit>> hits) const;
    void occluded(std::span<const Ray> rays, std::span<std::uint8_t> occluded_rays) const;
    /// 1 for each ray of the packet that meets nothing, else 0.
    RayPacket::Values visibility(const RayPacket& rays) const;

   private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation_;
};

}  // namespace pivot
