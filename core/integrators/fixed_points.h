// The analytic integrator's point sets: the same for every pixel and on every run, so that what they leave out does not
// flicker.
#pragma once

#include "core/integrators/settings.h"
#include "core/sampling/sobol.h"

namespace pivot {

/// Which of the fixed sets a point belongs to.
enum class PointSet : std::uint32_t {
    light_diffuse = 1,
    light_glossy = 2,
    world_diffuse = 3,
    world_glossy = 4,
    lobe_light = 5,
    lobe_direction = 6,
    lobe_world = 7,
    fog_place = 8,
    fog_lamp = 9,
};

/// The part of the sets that one camera sample takes: all samples together take enough that a penumbra's steps stay
/// below the error budget.
class FixedPoints {
   public:
    FixedPoints(const RenderSettings& settings, std::uint32_t sample_index)
        : FixedPoints(100.0f / settings.error_budget_percent, even_samples(settings), sample_index) {}

    std::uint32_t count() const { return at_least_one(pixel_count_ / static_cast<float>(samples_)); }

    /// How many of them tell whether a light is seen in full, in part or not at all. To take what they agree on for the
    /// whole light makes an error of at most one in as many, so that they are a part of the pixel's points, and not of
    /// the sample's, which many samples make few.
    std::uint32_t first_count() const { return std::min(count(), at_least_one(0.25f * pixel_count_)); }

    /// Something small in front of the world, half a point's worth, is missed by all: the variance of the share seen.
    float missed_variance() const {
        const auto n = static_cast<float>(count());
        return 0.5f / (static_cast<float>(samples_) * n) / (n * std::sqrt(n));
    }

    /// For a light that gives this share of all light: its steps are that much smaller.
    FixedPoints for_share(float share) const { return {pixel_count_ * std::min(share, 1.0f), samples_, sample_index_}; }

    /// Point k of `count` points of a set.
    Vec2f point(PointSet set, std::uint32_t k, std::uint32_t count) const {
        return Sampler{0u, sample_index_ * count + k}.point(static_cast<std::uint32_t>(set));
    }

   private:
    FixedPoints(float pixel_count, std::uint32_t samples, std::uint32_t sample_index)
        : pixel_count_(pixel_count), samples_(samples), sample_index_(sample_index) {}

    static std::uint32_t at_least_one(float count) {
        return std::max(1u, static_cast<std::uint32_t>(std::ceil(count)));
    }

    float pixel_count_;  ///< of all samples together
    std::uint32_t samples_, sample_index_;
};

}  // namespace pivot
