// A lamp in fog: what the media scatter of it along a ray, and samples of phase function times light.
#pragma once

#include <optional>

#include "core/integrators/distance_map.h"
#include "core/integrators/fog_area.h"
#include "core/integrators/media_ray.h"
#include "core/integrators/settings.h"
#include "core/lights/light.h"
#include "core/simd/batch.h"

namespace pivot {

/// An interval of a ray, and what it is typically made of.
struct FogPart {
    const MediaRay& ray;
    std::size_t interval;
    const MediumMix& mix;
};

/// From where to where a lamp may light the interval; nothing where it lights none of it.
std::optional<std::pair<float, float>> lit_part(const Light& lamp, const FogPart& part);

/// Under which what the lamp scatters from near_m to far_m is smooth.
DistanceMap distance_map(const Light& lamp, const FogPart& part, float near_m, float far_m);

/// About the radiance that each m of the ray scatters towards its origin where the interval is as is typical, if
/// nothing is in the lamp's way: without what the media take along the ray. precisely: to half a percent, of lamps that
/// shine alike over all they cover.
Vec3b scattered_light(const Light& lamp, const FogPart& part, const Batch& distance_m, bool precisely = false);

/// About what the media leave of the lamp's light up to places of the ray, as if they filled the boxes around them.
Vec3b transmittance_to_lamp(const Light& lamp, const FogPart& part, const Batch& distance_m);

/// Whether some phase function is so much narrower than an area lamp that joint samples may miss it from this near.
bool is_sharp_beside(const AreaLight& light, const MediumMix& mix, float distance_m);

/// What each of a batch of places samples of a lamp.
struct LampSamples {
    Vec3b wi;
    Batch pdf_omega;
    Batch distance_m;
    Vec3b radiance;  ///< if nothing is in the way
};
/// Jointly with the first lobe's phase function; an area lamp with that of all.
LampSamples sample_lamp(const Light& lamp, const MediumMix& mix, const Vec3b& position, const Vec3b& direction,
                        const Vec2b& u);

/// Samples of a lamp from a place in fog. By strategies joint and sptd a cap-shaped lamp is drawn jointly with the
/// pivot phase functions that stand for the lobes, and an area lamp by what is scattered of its parts, so that samples
/// of the phase function need not share, but where it is very sharp; else evenly.
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
    static constexpr std::size_t max_lobes = 8;

    void weigh_lobes(const MediumMix& mix);

    const Light& lamp_;
    Vec3f position_, direction_;
    bool is_sampled_, shares_;
    std::optional<Cap<float>> cap_;
    std::array<PivotPhase<float>, max_lobes> proxies_;
    std::array<float, max_lobes> probability_;  ///< of each
    std::size_t count_ = 0;
    std::optional<FogAreaSampler<float>> area_;
};

}  // namespace pivot
