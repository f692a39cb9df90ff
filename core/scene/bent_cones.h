// Bent cones: the share of directions that a vertex sees free of all geometry, as one spherical cap about their mean.
//   [Dupuy17]  "A Spherical Cap Preserving Parameterization for Spherical Distributions", Sec 5.4
//   [Landis02] "Production-Ready Global Illumination"
//
// A vertex has a cone for each normal and each side, over the hemisphere about it: where nothing is near, a cone is
// that hemisphere. Nothing beyond the farthest light occludes: the walls of a room do not darken it.
#pragma once

#include <array>
#include <functional>
#include <memory>

#include "core/distributions/cap.h"
#include "core/geometry/surface_point.h"
#include "core/scene/ray_tracer.h"

namespace pivot {

/// The places of a mesh that get cones: those of its vertices, once per normal.
struct BentConeSites {
    struct Site {
        std::uint32_t vertex;
        Vec3f normal;              ///< object space
        std::uint32_t first, end;  ///< of its triangles
    };
    std::vector<Site> sites;
    std::vector<std::uint32_t> triangles;  ///< of all sites, one after the other
    std::vector<Triangle> triangle_sites;  ///< the sites of each triangle's corners

    explicit BentConeSites(const Mesh& mesh);
};

/// Where the lights are: what lies farther away does not occlude.
struct LightReach {
    std::vector<Vec3f> positions;
    bool is_infinite = false;

    float from(const Vec3f& point) const;
    bool operator==(const LightReach&) const = default;
};

/// Of one instance of a mesh.
class BentCones {
   public:
    /// Traces from every site, on all cores; the same scene gives the same cones. They are of no use once should_stop
    /// has returned true.
    BentCones(const RayTracer& ray_tracer, const Mesh& mesh, std::shared_ptr<const BentConeSites> sites,
              const Transform& world_from_object, const LightReach& reach, const std::function<bool()>& should_stop);

    /// Interpolated, in world space. front: on the side that the triangle's geometric normal points to.
    Cap<float> at(const RayHit& hit, bool front) const;

   private:
    std::shared_ptr<const BentConeSites> sites_;
    std::vector<std::array<Cap<float>, 2>> cones_;  ///< of each site: front, back
};

}  // namespace pivot
