// The analytic integrator's point sets: the same for every pixel and on every run, so that what they leave out does not
// flicker.
#pragma once

#include "core/integrators/settings.h"
#include "core/sampling/sobol.h"

namespace pivot {

/// Which of the fixed sets a point belongs to.
enum class PointSet : std::uint32_t { light_diffuse = 1, light_glossy = 2, world_diffuse = 3, world_glossy = 4 };

/// The part of the sets that one camera sample takes: all samples together take enough that a penumbra's steps stay
/// below the error budget.
class FixedPoints {
   public:
    FixedPoints(const RenderSettings& settings, std::uint32_t sample_index)
        : count_(std::max(1u, static_cast<std::uint32_t>(std::ceil(
                                  100.0f / (settings.error_budget_percent * static_cast<float>(settings.samples)))))),
          sample_index_(sample_index) {}

    std::uint32_t count() const { return count_; }

    /// For a light that gives this share of all light: its steps are that much smaller.
    FixedPoints for_share(float share) const {
        FixedPoints fewer = *this;
        const float needed = std::ceil(static_cast<float>(count_) * std::min(share, 1.0f));
        fewer.count_ = std::max(1u, static_cast<std::uint32_t>(needed));
        return fewer;
    }

    /// Point k of `count` points of a set.
    Vec2f point(PointSet set, std::uint32_t k, std::uint32_t count) const {
        return Sampler{0u, sample_index_ * count + k}.point(static_cast<std::uint32_t>(set));
    }

   private:
    std::uint32_t count_, sample_index_;
};

}  // namespace pivot
