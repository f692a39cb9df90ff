// A lamp in fog: what the media scatter of it along a ray, and samples of phase function times light.
#pragma once

#include <optional>

#include "core/integrators/distance_map.h"
#include "core/integrators/settings.h"
#include "core/lights/light.h"
#include "core/scene/medium_mix.h"
#include "core/simd/batch.h"

namespace pivot {

/// A part of a ray where media and lamp are the same.
struct FogPart {
    const Media& media;
    std::span<const std::uint32_t> ids;
    const MediumMix& mix;  ///< there, or typical of it
    const Ray& ray;
    float near_m, far_m;
};

/// What of the part the lamp may light; nothing where it lights none.
std::optional<std::pair<float, float>> lit_part(const Light& lamp, const FogPart& part);

/// Under which what the lamp scatters from near_m to far_m is smooth.
DistanceMap distance_map(const Light& lamp, const FogPart& part, float near_m, float far_m);

/// About the radiance that each m of the ray scatters towards its origin, if nothing is in the lamp's way but the
/// media of the part: without what they take along the ray.
Vec3b scattered_light(const Light& lamp, const FogPart& part, const Batch& distance_m);

/// Samples of a lamp from a place in fog. By strategies joint and sptd a cap-shaped lamp is drawn jointly with the
/// pivot phase functions that stand for the lobes, so that BSDF samples need not share; else evenly.
class FogLampSampler {
   public:
    FogLampSampler(const Light& lamp, const MediumMix& mix, const Vec3f& position, const Vec3f& direction,
                   LightSampling strategy);

    /// Whether samples of the phase function take part.
    bool shares_with_phase() const { return shares_; }
    /// Nothing where the lamp does not reach the place, or by strategy bsdf.
    std::optional<LightPoint> sample(const Vec2f& u) const;
    float pdf_omega(const LightPoint& place) const;

   private:
    const Light& lamp_;
    const MediumMix& mix_;
    Vec3f position_, direction_;
    bool is_joint_ = false, shares_ = true, is_sampled_ = true;
    std::optional<Cap<float>> cap_;
    struct Lobe {
        PivotPhase<float> proxy;
        float probability;
    };
    static constexpr std::size_t max_lobes = 8;
    std::array<Lobe, max_lobes> lobes_;  ///< the joint ones
    std::size_t lobe_count_ = 0;
};

}  // namespace pivot
