// A rectangle, disk or ellipse over a batch of surfaces.
#pragma once

#include "core/integrators/cap_light_shading.h"

namespace pivot {

/// What each lane reflects of the light, and what hides it.
Reflection shade_area_light(const Scene& scene, const AreaLight& light, const SurfaceBatch& batch,
                            const RenderSettings& settings, const FixedPoints& points);

}  // namespace pivot
