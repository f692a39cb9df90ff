// A sphere, spot or sun over a batch of surfaces: closed forms for what the lobes reflect, and visibility apart.
#pragma once

#include "core/integrators/shadow_points.h"
#include "core/shading/spot_beam.h"

namespace pivot {

/// Writes the glossy half of a reflection: the lobe's sums under each lane's Fresnel curve.
void put_glossy(const SurfaceBatch& batch, const LobeIntegral<Batch>& integral, const Rgb& radiance,
                Reflection& reflection);

/// What a spot's beam leaves of its radiance towards each lane; nothing is lost of other lights.
struct BeamFalloff {
    const SpotLight* spot = nullptr;
    Vec3b direction_local{};

    Batch operator()(const Vec3b& wi_local) const {
        return spot ? spot_falloff(*spot, -dot(direction_local, wi_local)) : Batch(1.0f);
    }
    friend BeamFalloff permute(const BeamFalloff& falloff, const LaneIndex& index) {
        return {falloff.spot, permute(falloff.direction_local, index)};
    }
};

/// Of light that nothing hides. `light` must not be an area light.
class CapLightShading {
   public:
    CapLightShading(const Light& light, const SurfaceBatch& batch, const RenderSettings& settings);

    const Reflection& reflection() const { return reflection_; }
    /// To be told what its rules leave.
    Reflection& reflection() { return reflection_; }

    /// Multiplies in the share of the light that each lane sees, by rays towards the fixed points. The diffuse lobe's
    /// points are spread over the light, the glossy lobe's by the lobe. totals: each lane's light from all lights.
    Reflection seen_by_rays(const Scene& scene, const ShadowPoints& points, std::span<const float> totals) const;

   private:
    void reflect_glossy(const RenderSettings& settings);
    void reflect_diffuse();
    /// Writes over the lanes of the exact core's integral in which the light crosses the beam's edge.
    void cut_by_beam(LobeIntegral<Batch>& integral) const;
    /// The diffuse lobe's share of such lanes; whole: of the light without its beam.
    Batch cosine_in_beam(Batch whole) const;

    const Light& light_;
    const SurfaceBatch& batch_;
    Cap<Batch> cap_;  // shading frame
    BeamFalloff falloff_;
    Batch budget_;
    BeamSpan<Batch> span_{};             // of a spot
    Batch falloff_error_ = Batch(0.0f);  // what points on the light make of its falloff, relative
    BatchMask falloff_varies_;           // over the light
    BatchMask has_edge_;                 // so that points on the light miss the budget
    std::optional<GgxCapLight<Batch>> exact_;
    Reflection reflection_{};
};

}  // namespace pivot
