// Which light a path's later vertices sample: one, in proportion to the irradiance it could give if nothing were in its
// way. (The first vertex samples them all: there each light's noise is seen.)
#pragma once

#include <vector>

#include "core/lights/light.h"
#include "core/scene/surface_point.h"

namespace pivot {

struct LightChoice {
    std::size_t light;
    float probability;
};

/// u in [0, 1). Nothing when no light can reach the point.
std::optional<LightChoice> choose_light(const std::vector<Light>& lights, const SurfacePoint& point, float u);

/// With which probability choose_light takes this light.
float choice_probability(const std::vector<Light>& lights, const SurfacePoint& point, std::size_t light);

}  // namespace pivot
