// A rectangle, disk, ellipse, or a triangle of a mesh, which shines from both sides, over a batch of surfaces.
#pragma once

#include "core/integrators/cap_light_shading.h"

namespace pivot {

class AreaLightShading {
   public:
    AreaLightShading(const AreaLight& light, const SurfaceBatch& batch, const RenderSettings& settings);

    /// Of light that nothing hides.
    const Reflection& reflection() const { return reflection_; }
    /// To be told what its rules leave.
    Reflection& reflection() { return reflection_; }

    /// The same times the share of the light that each lane sees, by rays to fixed points of it, which each lobe weighs
    /// by what it reflects of them. totals: each lane's light from all lights.
    Reflection seen_by_rays(const Scene& scene, const ShadowPoints& points, std::span<const float> totals) const {
        return left_by_points(scene, points, totals, true);
    }

    /// What a spread leaves of it, which has no closed form, if nothing is in the light's way.
    Reflection spread(const Scene& scene, const ShadowPoints& points, std::span<const float> totals) const {
        return light_.inverse_tan_spread > 0.0f ? left_by_points(scene, points, totals, false) : reflection_;
    }

   private:
    Reflection left_by_points(const Scene& scene, const ShadowPoints& points, std::span<const float> totals,
                              bool traces_rays) const;

    const AreaLight& light_;
    const SurfaceBatch& batch_;
    Reflection reflection_{};
};

}  // namespace pivot
