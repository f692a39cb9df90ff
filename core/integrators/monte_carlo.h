// Path tracing with next-event estimation; unbiased with every light sampling strategy.
#pragma once

#include "core/film/film.h"
#include "core/integrators/settings.h"
#include "core/sampling/sobol.h"
#include "core/scene/scene.h"

namespace pivot {

/// Camera samples, best of neighbouring pixels: they are traced in packets. The scene is committed; sampler dimension 0
/// is the caller's. samples: one per ray, overwritten.
/// passes: likewise, of see_surfaces(), or none: added to. named: of each ray what the settings say of named passes, of
/// which those of light groups are added to.
void trace_paths(const Scene& scene, const RenderSettings& settings, std::span<const Ray> camera_rays,
                 std::span<const Sampler> samplers, std::span<Sample> samples, std::span<SurfacePasses> passes = {},
                 std::span<Rgb> named = {});

}  // namespace pivot
