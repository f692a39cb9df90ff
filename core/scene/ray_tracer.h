// Closest hits and occlusion over instanced meshes.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/geometry/mesh.h"
#include "core/math/moving_transform.h"
#include "core/scene/mesh_bvhs.h"
#include "core/scene/visibility.h"
#include "core/simd/batch.h"

namespace pivot {

/// Over float, or a batch of rays.
template <class T>
struct RayOf {
    Vec3<T> origin;
    Vec3<T> direction;  ///< unit
    T near_m = T(0);
    T far_m = std::numeric_limits<T>::infinity();  ///< of a batch; not above 0: there is no such ray
    T time = T(middle_time);                       ///< at which it meets what moves
};

template <class T>
struct RayHitOf {
    T distance_m;
    Word<T> instance;  ///< of a batch; no_instance: the ray met nothing
    Word<T> triangle;
    Vec2<T> barycentric;      ///< weights of the triangle's second and third corner
    T time = T(middle_time);  ///< the ray's
};

using Ray = RayOf<float>;
using RayHit = RayHitOf<float>;
inline constexpr std::uint32_t no_instance = ~0u;

/// Where a ray passes through a surface.
struct Crossing {
    float distance_m;
    std::uint32_t instance, triangle;
};

class InstanceBvhs;

class RayTracer {
   public:
    /// shared: BVHs of large meshes, which it then traces each in its own space. finds_crossings: it serves
    /// crossings() alone.
    explicit RayTracer(std::shared_ptr<MeshBvhs> shared = nullptr, bool finds_crossings = false);
    ~RayTracer();
    RayTracer(const RayTracer&) = delete;
    RayTracer& operator=(const RayTracer&) = delete;

    /// Also in place of another, of whose instances it is then.
    void set_mesh(std::uint32_t mesh_id, std::shared_ptr<const Mesh> mesh);
    void set_instance(std::uint32_t instance_id, std::uint32_t mesh_id, const Transform& world_from_object,
                      std::uint32_t visibility);
    /// Where an instance is at each time; until it is set again. Not of one that is scaled flat.
    void set_instance_motion(std::uint32_t instance_id, std::shared_ptr<const MovingTransform> motion);
    /// Who sees an instance; at once, and without a build.
    void set_visibility(std::uint32_t instance_id, std::uint32_t visibility);
    void remove_instance(std::uint32_t instance_id);
    /// Builds what has changed. Throws std::bad_alloc, or std::runtime_error with Embree's message.
    void commit();

    std::optional<RayHit> intersect(const Ray& ray, Visibility from) const;
    /// Whether anything that casts shadows is there, even if it filters light.
    bool occluded(const Ray& ray) const;

    /// Many at once, in batches of neighbours in the span. hits: one per ray.
    void intersect(std::span<const Ray> rays, Visibility from, std::span<std::optional<RayHit>> hits) const;
    void occluded(std::span<const Ray> rays, std::span<std::uint8_t> occluded_rays) const;

    /// The lowest and the highest corner of a box around all; the lowest is above the highest where there is nothing.
    std::array<Vec3f, 2> bounds() const;

    /// Appends every surface along a ray, in no order, whoever sees it.
    void crossings(const Ray& ray, std::vector<Crossing>& found) const;

    /// from: of each ray, a Visibility.
    RayHitOf<Batch> intersect(const RayOf<Batch>& rays, const WordBatch& from) const;
    void intersect(std::span<const Ray> rays, std::span<const std::uint32_t> from,
                   std::span<std::optional<RayHit>> hits) const;
    /// 1 for each ray that meets nothing that hides light, else 0.
    Batch visibility(const RayOf<Batch>& rays) const;

    /// A ray of a batch, and where it meets what filters light.
    struct Filtered {
        std::size_t lane;
        RayHit hit;
    };
    /// Whether a triangle of what filters light does not: a mesh has many materials.
    using IsOpaque = std::function<bool(std::uint32_t instance, std::uint32_t triangle)>;
    /// Appends all that filters light along the rays, in no order. Returns 1 for each ray that meets nothing opaque
    /// among it, nor more surfaces than `most` of its lane; of the others it may not have found all.
    Batch filtered(const RayOf<Batch>& rays, const std::array<std::uint32_t, batch_size>& most,
                   const IsOpaque& is_opaque, std::vector<Filtered>& found) const;

   private:
    std::unique_ptr<InstanceBvhs> bvhs_;
};

}  // namespace pivot
