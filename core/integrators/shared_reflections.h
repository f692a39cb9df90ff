// What is reflected of light that bounced, shared by a pixel's samples where they meet one surface: it varies little
// over a pixel, and its colours, which may not, are each sample's own.
#pragma once

#include "core/integrators/virtual_light_shading.h"

namespace pivot {

/// So many successive samples of a pixel share what is known of light that bounced.
inline constexpr std::uint32_t bounced_samples_shared = 4;

class SharedReflections {
   public:
    explicit SharedReflections(std::size_t pixel_count) : newest_(pixel_count, none) {}

    /// Of each surface, in the pixel that it is seen in: what is known of one that is as it is, else anew. turn: see
    /// reflect_virtual_lights().
    std::vector<VirtualReflection> reflect(const Scene& scene, const RenderSettings& settings,
                                           const VirtualLights& lights, std::span<const ShadingPoint> shading,
                                           std::span<const std::uint32_t> pixels, std::uint32_t turn);

   private:
    static constexpr std::uint32_t none = ~0u;

    struct Known {
        Vec3f position, normal, normal_bumped, wo;  ///< world
        float alpha;                                ///< 0: no glossy lobe
        bool has_diffuse;
        VirtualReflection reflection;
        std::uint32_t next;  ///< of the same pixel
    };

    static bool is_like(const Known& known, const ShadingPoint& at, float reach_m);
    const VirtualReflection* find(std::size_t pixel, const ShadingPoint& at, float reach_m) const;
    void add(std::size_t pixel, const ShadingPoint& at, const VirtualReflection& reflection);

    std::vector<std::uint32_t> newest_;  ///< of each pixel, among known_
    std::vector<Known> known_;
};

}  // namespace pivot
