// What camera rays show to the analytic integrator: the first surfaces, and what is seen through these.
#pragma once

#include "core/film/film.h"
#include "core/integrators/passage.h"
#include "core/integrators/settings.h"

namespace pivot {

/// A surface that a camera ray shows.
struct Shown {
    Arrival arrival;
    std::size_t sample;
    Rgb worth{1.0f};
    bool is_told = true;       ///< whether passes tell of it, not of another
    bool only_shines = false;  ///< it is too far behind others
};

/// What camera rays show: of each surface some, by what those before it let through. Samples: of the rays, set to what
/// comes from no surface.
std::vector<Shown> shown_surfaces(const Scene& scene, const RenderSettings& settings, std::span<const Ray> camera_rays,
                                  std::span<const std::optional<RayHit>> hits, const PixelWidth& width,
                                  ProgramMemory& memory, std::span<Sample> samples);

}  // namespace pivot
