// Direct light in closed form: no random numbers, the same picture on every run and any number of threads.
//
// GGX under a cap-shaped light is one SPTD lobe of the table, clipped at the horizon [Dupuy17, Sec. 5]; the diffuse
// lobe is the exact clamped cosine. Visibility is traced to a fixed set of points on the light, the same for every
// pixel; an area light is summed over such a set. Light between surfaces is left to Monte Carlo. [Dupuy17]  A Spherical
// Cap Preserving Parameterization for Spherical Distributions
#pragma once

#include "core/film/film.h"
#include "core/integrators/settings.h"
#include "core/scene/scene.h"

namespace pivot {

/// One camera ray. sample_index: which part of the fixed point sets this ray uses; all samples together use them whole.
Sample shade_analytic(const Scene& scene, const RenderSettings& settings, const Ray& camera_ray,
                      std::uint32_t sample_index);

}  // namespace pivot
