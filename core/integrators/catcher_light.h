// What pictures with shadow catchers are made of, beside the picture of all.
#pragma once

#include "core/film/film.h"
#include "core/integrators/settings.h"
#include "core/sampling/sobol.h"
#include "core/scene/scene.h"

namespace pivot {

/// Sets catcher_pass's colours of each ray. catchers: the scene of these alone. samples: of trace_paths() among all.
/// A ray that meets a catcher behind something transparent counts as one that meets none.
void tell_catchers(const Scene& scene, const Scene& catchers, const RenderSettings& settings, std::span<const Ray> rays,
                   std::span<const Sampler> samplers, std::span<const Sample> samples, std::span<Rgb> named);

}  // namespace pivot
