// A sphere, spot or sun over a batch of surfaces: closed forms for what the lobes reflect, and visibility apart.
#pragma once

#include "core/integrators/fixed_points.h"
#include "core/integrators/surface_batch.h"
#include "core/scene/scene.h"
#include "core/shading/spot_beam.h"

namespace pivot {

/// What each lane reflects of a light towards the viewer, and how far off that may be.
struct Reflection {
    std::array<Rgb, batch_size> diffuse, glossy;
    Lanes diffuse_error, glossy_error;  ///< predicted, relative to each
    Lanes shadow_variance;              ///< what the rays leave of the share that is seen: radiance squared
    std::array<Method, batch_size> method;
};

/// Writes the glossy half of a reflection: the lobe's sums under each lane's Fresnel curve.
void put_glossy(const SurfaceBatch& batch, const LobeIntegral<Batch>& integral, const Rgb& radiance,
                Reflection& reflection);

/// The share of a light that is seen, so far.
struct VisibleShare {
    float seen = 0.0f, all = 0.0f, squares = 0.0f;

    void add(float weight, bool is_seen) {
        all += weight;
        squares += weight * weight;
        if (is_seen) seen += weight;
    }
    float value() const { return all > 0.0f ? seen / all : 1.0f; }
    bool is_mixed() const { return seen > 0.0f && seen < all; }
    /// Variance of value() by evenly spread points, whose error falls like count^(-3/4) at an edge.
    float variance() const {
        if (!is_mixed()) return 0.0f;
        const float inverse_count = squares / (all * all);
        return value() * (1.0f - value()) * inverse_count * sqrt(inverse_count);
    }
};

/// Of one lane, by each lobe's points.
struct LaneShares {
    VisibleShare diffuse, glossy;
    bool is_mixed() const {
        return diffuse.is_mixed() || glossy.is_mixed() || (diffuse.seen > 0.0f) != (glossy.seen > 0.0f);
    }
};

/// What is left of a reflection where each lane's lobes see these shares.
Reflection seen_in_part(const Reflection& whole, std::span<const LaneShares> shares);

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

    /// Multiplies in the share of the light that each lane sees, by rays towards the fixed points. The diffuse lobe's
    /// points are spread over the light, the glossy lobe's by the lobe.
    Reflection seen_by_rays(const Scene& scene, const FixedPoints& points) const;

   private:
    /// Points begin..end of `all` of each camera sample.
    struct PointRange {
        std::uint32_t begin, end, all;
    };
    void trace(const Scene& scene, const FixedPoints& points, bool wants_diffuse, bool wants_glossy,
               const PointRange& range, std::array<LaneShares, batch_size>& shares) const;
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
