// A lamp in fog: what the media scatter of it along a ray, and samples of phase function times light.
#pragma once

#include <optional>

#include "core/integrators/area_cells.h"
#include "core/integrators/distance_map.h"
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

/// A cap-shaped lamp from a batch of places.
struct LampLanes {
    LampLanes(const Light& lamp, const Vec3b& position);

    Batch distance_m(const Vec3b& wi) const;
    Vec3b radiance(const Vec3b& wi) const;

    const SphereLight* sphere;  ///< null: a sun
    const SpotLight* spot;      ///< null: not a spot
    Vec3b to_center;            ///< of the sphere
    Rgb full_radiance;
    Cap<Batch> cap;
};

/// Samples of a lamp from a place in fog. By strategies joint and sptd a cap-shaped lamp is drawn jointly with the
/// pivot phase functions that stand for the lobes, so that samples of the phase function need not share, and an area
/// lamp cell by cell, by what is scattered of each; else evenly.
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
    void weigh_cells(const AreaLight& light, const MediumMix& mix);
    void normalize_probabilities();

    const Light& lamp_;
    Vec3f position_, direction_;
    bool is_sampled_, shares_;
    std::optional<Cap<float>> cap_;
    std::array<PivotPhase<float>, max_lobes> proxies_;
    std::array<float, area_cell_count> probability_;  ///< of each joint lobe, or of each cell
    std::size_t count_ = 0;
};

}  // namespace pivot
