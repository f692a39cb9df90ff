// A tree over the scene's lights, eight children to a node, neighbours in space next to each other. A child is a light,
// or stands for those below it by their statistics: a Gaussian of places about their mean, that shines like one of
// directions about their mean direction [Tokuyoshi24].
//   [Tokuyoshi24] "Hierarchical Light Sampling with Accurate Spherical Gaussian Lighting"
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "core/lights/light.h"
#include "core/simd/batch.h"

namespace pivot {

inline constexpr std::size_t light_tree_width = 8;

/// A light, or lights together, as a point that chooses among them knows them; what they emit is a mean over colours,
/// of either sign, as a magnitude. A sun stands one metre off along its direction, from wherever it is seen.
template <class T>
struct LightProxyOf {
    Vec3<T> mean;   ///< place, or direction of suns
    T is_placed;    ///< 0: a sun's, or suns'
    T variance_m2;  ///< of places, about the mean across any line of sight
    T bound_m;      ///< no part is further from the mean
    T intensity;    ///< W/sr at most, towards any side; 0: there is no such child
    Vec3<T> axis;   ///< where a flat light, a spot or lights together shine; 0: everywhere
    T sharpness;    ///< of lights together: of their Gaussian of directions
    T radius_m;     ///< of a light: of the disk, facing the point, that has its area; 0: lights together
    T cos_edge;     ///< a light falls off to nothing there, as cosines from its axis
    T inverse_falloff_width;
    T is_smooth;     ///< 1: it falls off like a spot; 0: linearly
    T is_two_sided;  ///< 1 of a flat light that shines from both sides
};

/// Eight of them as a node keeps them.
class LightProxies {
   public:
    /// From child `first` on, one a lane.
    LightProxyOf<Batch> batch(std::size_t first) const {
        return read([&](const auto& values) { return Batch::load_unaligned(&values[first]); });
    }
    /// A child in every lane.
    LightProxyOf<Batch> broadcast(std::size_t child) const {
        return read([&](const auto& values) { return Batch(values[child]); });
    }
    LightProxyOf<float> operator[](std::size_t child) const;
    void set(std::size_t child, const LightProxyOf<float>& proxy);

   private:
    using Values = std::array<float, light_tree_width>;
    static constexpr std::size_t numbers = sizeof(LightProxyOf<float>) / sizeof(float);

    template <class Of>
    LightProxyOf<Batch> read(const Of& of) const {
        LightProxyOf<Batch> proxy;
        for (std::size_t i = 0; i < numbers; ++i) {
            const Batch number = of(values_[i]);
            std::memcpy(reinterpret_cast<std::byte*>(&proxy) + i * sizeof(Batch), &number, sizeof(Batch));
        }
        return proxy;
    }

    std::array<Values, numbers> values_{};  ///< each number of a proxy, of all children
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
    class Builder;

    std::vector<Node> nodes_;
    std::vector<Leaf> leaves_;
};

}  // namespace pivot
