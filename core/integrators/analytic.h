// Direct light in closed form: no random numbers, the same picture on every run and any number of threads.
//
// Each light is integrated over each lobe by the cheapest method that meets the error budget (core/shading), eight
// points at a time; visibility is traced to a fixed set of points on the light, the same for every pixel. Mirrors and
// glass are followed by rays; other light between surfaces is that of virtual lights, or left to Monte Carlo.
#pragma once

#include <span>

#include "core/film/film.h"
#include "core/integrators/analytic_lights.h"
#include "core/integrators/group_light.h"
#include "core/integrators/shared_reflections.h"

namespace pivot {

/// Camera rays, best neighbours, and the pixel of each, counted as `shared` does. sample_index: which part of the fixed
/// point sets these rays use; all samples of a pixel together use them whole. lights: of gather_lights(). shared: of
/// the same samples / bounced_samples_shared, for each of lights.bounced. samples: one per ray. groups: of these; null:
/// nobody asks.
void shade_analytic(const Scene& scene, const RenderSettings& settings, const AnalyticLights& lights,
                    std::span<const Ray> camera_rays, std::span<const std::uint32_t> pixels, std::uint32_t sample_index,
                    std::span<SharedReflections> shared, std::span<Sample> samples, GroupLight* groups);

}  // namespace pivot
