// Closest hits and occlusion over instanced meshes. The only place that knows Embree.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/geometry/mesh.h"
#include "core/math/transform.h"
#include "core/simd/batch.h"

namespace pivot {

/// Over float, or a batch of rays.
template <class T>
struct RayOf {
    Vec3<T> origin;
    Vec3<T> direction;  ///< unit
    T near_m = T(0);
    T far_m = std::numeric_limits<T>::infinity();  ///< of a batch; not above 0: there is no such ray
};

template <class T>
struct RayHitOf {
    T distance_m;
    Word<T> instance;  ///< of a batch; no_instance: the ray met nothing
    Word<T> triangle;
    Vec2<T> barycentric;  ///< weights of the triangle's second and third corner
};

using Ray = RayOf<float>;
using RayHit = RayHitOf<float>;
inline constexpr std::uint32_t no_instance = ~0u;

/// Who sees an instance.
enum Visibility : std::uint32_t { visible_to_camera = 1, visible_to_light = 2, visible_to_all = 3 };

/// Where a ray passes through a surface.
struct Crossing {
    float distance_m;
    std::uint32_t instance, triangle;
};

class RayTracer {
   public:
    /// finds_crossings: it serves crossings() alone.
    explicit RayTracer(bool finds_crossings = false);
    ~RayTracer();
    RayTracer(const RayTracer&) = delete;
    RayTracer& operator=(const RayTracer&) = delete;

    /// The mesh's vectors are read in place: they must outlive the tracer and keep their addresses.
    void set_mesh(std::uint32_t mesh_id, const Mesh& mesh);
    void set_instance(std::uint32_t instance_id, std::uint32_t mesh_id, const Transform& world_from_object,
                      std::uint32_t visibility);
    /// Who sees an instance; at once, and without a build.
    void set_visibility(std::uint32_t instance_id, std::uint32_t visibility);
    void remove_instance(std::uint32_t instance_id);
    /// Builds what has changed. Throws std::bad_alloc, or std::runtime_error with Embree's message.
    void commit();

    std::optional<RayHit> intersect(const Ray& ray, Visibility from) const;
    bool occluded(const Ray& ray) const;

    /// Many at once, in batches of neighbours in the span. hits: one per ray.
    void intersect(std::span<const Ray> rays, Visibility from, std::span<std::optional<RayHit>> hits) const;
    void occluded(std::span<const Ray> rays, std::span<std::uint8_t> occluded_rays) const;

    /// The lowest and the highest corner of a box around all; the lowest is above the highest where there is nothing.
    std::array<Vec3f, 2> bounds() const;

    /// Appends every surface along a ray, in no order, whoever sees it.
    void crossings(const Ray& ray, std::vector<Crossing>& found) const;

    RayHitOf<Batch> intersect(const RayOf<Batch>& rays, Visibility from) const;
    /// 1 for each ray that meets nothing, else 0.
    Batch visibility(const RayOf<Batch>& rays) const;

   private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation_;
};

}  // namespace pivot
