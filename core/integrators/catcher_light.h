// What pictures with shadow catchers are made of, beside the picture of all.
#pragma once

#include <functional>

#include "core/film/film.h"
#include "core/integrators/settings.h"
#include "core/sampling/sobol.h"
#include "core/scene/scene.h"

namespace pivot {

/// Follows those of the rays through the scene of shadow catchers alone.
using FollowAlone = std::function<void(std::span<const std::size_t> which, std::span<Sample> samples)>;

/// Sets catcher_pass's colours of each ray. samples: of the rays among all. A ray that meets a catcher behind something
/// transparent counts as one that meets none. What media scatter before a catcher is not the catcher's, and hides it.
void tell_catchers(const Scene& scene, const RenderSettings& settings, std::span<const Ray> rays,
                   std::span<const Sampler> samplers, std::span<const Sample> samples, const FollowAlone& follow_alone,
                   std::span<Rgb> named);

/// What is followed alone tells of nothing but its light.
RenderSettings settings_of_catchers(const RenderSettings& settings);

}  // namespace pivot
