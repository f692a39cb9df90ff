// What passes tell of the surfaces that camera rays show, whichever integrator lights them.
#pragma once

#include "core/film/film.h"
#include "core/integrators/settings.h"
#include "core/sampling/sobol.h"
#include "core/scene/scene.h"

namespace pivot {

/// samplers: of each ray. Sets all but the light that surfaces reflect. passes: one per ray, or none; mattes: appended
/// to if they are asked for, by ray; named: of each ray what the settings say of named passes, of which AOVs are added
/// to. By an integrator that tells the environment itself that is left as it is.
void see_surfaces(const Scene& scene, const RenderSettings& settings, std::span<const Ray> camera_rays,
                  std::span<const Sampler> samplers, std::span<SurfacePasses> passes, std::vector<SeenMatte>& mattes,
                  std::span<Rgb> named);

}  // namespace pivot
