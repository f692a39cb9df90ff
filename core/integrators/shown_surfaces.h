// What rays show to the analytic integrator: the first surfaces, and what is seen through these.
#pragma once

#include "core/film/film.h"
#include "core/integrators/group_light.h"
#include "core/integrators/look_rays.h"
#include "core/integrators/passage.h"
#include "core/integrators/settings.h"

namespace pivot {

/// A surface that a ray shows.
struct Shown {
    Arrival arrival;
    std::size_t sample;
    Rgb worth;
    float spread;
    bool is_spread = false;            ///< see LookRay
    bool is_told = true;               ///< whether passes tell of it, not of another
    bool only_shines = false;          ///< it is too far behind others
    std::uint32_t from = no_instance;  ///< see LookRay
};

/// What rays show after so many bounces, the first of which are the camera's: of each surface some, by what those
/// before it let through. hits: of the rays, the first. Adds to the samples what comes from no surface. groups: of
/// these; null: nobody asks.
std::vector<Shown> shown_surfaces(const Scene& scene, const RenderSettings& settings, std::uint32_t bounce,
                                  std::span<const LookRay> rays, std::span<const std::optional<RayHit>> hits,
                                  ProgramMemory& memory, std::span<Sample> samples, GroupLight* groups);

}  // namespace pivot
