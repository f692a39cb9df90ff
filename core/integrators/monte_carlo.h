// Path tracing with next-event estimation; unbiased with every light sampling strategy.
#pragma once

#include "core/film/film.h"
#include "core/integrators/settings.h"
#include "core/sampling/sobol.h"
#include "core/scene/scene.h"

namespace pivot {

/// One camera sample. The scene is committed; sampler dimension 0 is the caller's.
Sample trace_path(const Scene& scene, const RenderSettings& settings, const Ray& camera_ray, const Sampler& sampler);

}  // namespace pivot
