// A tree over the scene's lights, eight children to a node. To a point that chooses among them, a child is a sphere of
// even radiance: a light itself, or the bounds of those below it with the sum of what they shine.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/lights/light.h"
#include "core/simd/batch.h"

namespace pivot {

inline constexpr std::size_t light_tree_width = 8;

/// Lights, or groups of lights, each a sphere with the mean radiance over colours. A flat light or patch is the sphere
/// of its area, seen at its slant; a sun is a cap.
struct LightProxy {
    Vec3b center;
    Batch radius_m, radiance;
    Vec3b normal;
    Batch cos_cone, least_lit, two_sided, sun_versine;
};

/// Eight of them as a node keeps them.
struct LightProxies {
    using Values = std::array<float, light_tree_width>;
    Values center_x{}, center_y{}, center_z{};  ///< of a sun: the direction towards it
    Values radius_m{};
    Values radiance{};                          ///< of either sign, as a magnitude; 0: there is no such child
    Values normal_x{}, normal_y{}, normal_z{};  ///< where a flat light or a spot shines; else 0
    Values cos_cone{};                          ///< of a spot's half-angle; 0 of a flat light
    Values least_lit{};                         ///< the falloff towards any point is at least this
    Values two_sided{};                         ///< 1 of a flat light that shines from both sides
    Values sun_versine{};                       ///< above 0: this is a sun

    /// From child `first` on, one a lane.
    LightProxy batch(std::size_t first) const {
        return read([&](const Values& values) { return Batch::load_unaligned(&values[first]); });
    }
    /// A child in every lane.
    LightProxy broadcast(std::size_t child) const {
        return read([&](const Values& values) { return Batch(values[child]); });
    }

    void set_sphere(std::size_t child, const Vec3f& center, float radius, float mean_radiance);
    void set_flat(std::size_t child, const AreaLight& light);

   private:
    template <class Of>
    LightProxy read(const Of& of) const {
        return {{of(center_x), of(center_y), of(center_z)},
                of(radius_m),
                of(radiance),
                {of(normal_x), of(normal_y), of(normal_z)},
                of(cos_cone),
                of(least_lit),
                of(two_sided),
                of(sun_versine)};
    }
};

class LightTree {
   public:
    struct Node {
        LightProxies proxies;
        std::array<std::int32_t, light_tree_width> child;  ///< a node, or ~light
        std::size_t count = 0;
        std::int32_t parent = -1;
        std::size_t place_in_parent = 0;
    };
    struct Leaf {
        std::int32_t node;
        std::size_t place;
    };

    explicit LightTree(std::span<const Light> lights = {});

    /// The root comes first. Empty without lights.
    const std::vector<Node>& nodes() const { return nodes_; }
    /// Where a light hangs.
    const Leaf& leaf(std::size_t light) const { return leaves_[light]; }

   private:
    std::int32_t build(std::span<const Light> lights, std::span<std::uint32_t> indices);

    std::vector<Node> nodes_;
    std::vector<Leaf> leaves_;
};

}  // namespace pivot
