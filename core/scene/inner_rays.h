// Rays inside one instance, which see nothing else: for light that walks beneath its surface. Its mesh is traced in its
// own space.
#pragma once

#include "core/scene/instance.h"
#include "core/scene/ray_tracer.h"

namespace pivot {

class InnerRays {
   public:
    /// shared: BVHs of meshes; none: it has its own.
    explicit InnerRays(std::shared_ptr<MeshBvhs> shared = nullptr);
    ~InnerRays();
    InnerRays(const InnerRays&) = delete;
    InnerRays& operator=(const InnerRays&) = delete;

    /// Makes ready those instances that have an inside, by their place, and forgets the others. Throws std::bad_alloc,
    /// or std::runtime_error with Embree's message.
    void set(std::span<const std::shared_ptr<const Mesh>> meshes, std::span<const std::optional<Instance>> instances,
             const std::vector<bool>& has_inside);
    bool is_empty() const { return insides_.empty(); }

    /// Of curves, and of what is scaled flat, there is none.
    bool has_inside(std::uint32_t instance) const { return !insides_.empty() && insides_[instance].bvh; }
    /// Where a ray next meets the surface of an instance that has an inside.
    std::optional<RayHit> intersect(const Ray& ray, std::uint32_t instance) const;

   private:
    struct Inside {
        std::shared_ptr<const MeshBvh> bvh;  ///< none: there is no inside
        Transform object_from_world;
        std::shared_ptr<const MovingTransform> world_from_moving;  ///< none: it stays where it is
    };
    std::shared_ptr<MeshBvhs> bvhs_;
    std::vector<Inside> insides_;  ///< of each instance; empty: none has any
};

}  // namespace pivot
