// Single scattering in media without noise: along each ray what a lamp scatters is integrated at fixed nodes, over the
// lamp in closed form, and the share of it that is seen is traced to fixed points.
#pragma once

#include "core/integrators/fixed_points.h"
#include "core/integrators/fog_lamp.h"

namespace pivot {

/// What the media bring along a ray.
struct FogLight {
    Rgb scattered{0.0f}, emitted{0.0f};
    float error = 0.0f;            ///< predicted of the closed forms, as radiance
    float shadow_variance = 0.0f;  ///< what the rays leave of the share that is seen: radiance squared
};

/// ray: followed without a stream of numbers.
FogLight scatter_analytic(const Scene& scene, const RenderSettings& settings, const FixedPoints& points,
                          const MediaRay& ray);

/// What media leave of a lamp's light to a place, by its centre.
Rgb transmittance_from(const Light& lamp, const Vec3f& position, MediaRay& ray);

}  // namespace pivot
