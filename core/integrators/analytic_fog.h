// Single scattering in media without noise: along each ray what a lamp scatters is integrated at fixed nodes, over the
// lamp in closed form, and the share of it that is seen is traced to fixed points.
#pragma once

#include "core/integrators/analytic_lights.h"
#include "core/integrators/cap_light_shading.h"
#include "core/integrators/fog_lamp.h"

namespace pivot {

/// What the media bring along a ray.
struct FogLight {
    Rgb scattered{0.0f}, emitted{0.0f};
    float error = 0.0f;            ///< predicted of the closed forms, as radiance
    float shadow_variance = 0.0f;  ///< what the rays leave of the share that is seen: radiance squared
};

/// Is told what a light group adds.
using OnFogLight = std::function<void(std::uint32_t group, const Rgb& light)>;

/// After so many bounces. ray: followed without a stream of numbers. on_light: may be empty.
FogLight scatter_analytic(const Scene& scene, const RenderSettings& settings, const AnalyticLights& lights,
                          std::uint32_t bounce, const ShadowPoints& points, const MediaRay& ray,
                          const OnFogLight& on_light);

/// What media leave of a lamp's light to a place: by its centre, an area lamp by four places on it.
Rgb transmittance_from(const Light& lamp, const Vec3f& position, MediaRay& ray);

/// Takes from a light's reflection what media take of the light on its way to each lane.
void apply_media(const Scene& scene, const Light& light, const SurfaceBatch& batch, Reflection& reflection);

}  // namespace pivot
