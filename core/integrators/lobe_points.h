// What lobes without closed forms reflect, for the analytic integrator: by fixed points that Monte Carlo's samplers
// place, on the light and along the lobe, weighted against each other.
#pragma once

#include "core/bsdf/surface.h"
#include "core/integrators/shadow_points.h"
#include "core/scene/scene.h"

namespace pivot {

struct LobeReflection {
    Rgb radiance{0.0f};
    float error = 0.0f;            ///< predicted, relative
    float shadow_variance = 0.0f;  ///< what the rays leave of the share that is seen: radiance squared
};

/// lobe: a surface of that lobe alone.
LobeReflection reflect_light(const Scene& scene, const RenderSettings& settings, const ShadowPoints& points,
                             const Light& light, const LightRules& rules, const SurfacePoint& point,
                             const Surface& lobe);

/// The same of the world, where it is one colour all around.
LobeReflection reflect_world(const Scene& scene, const RenderSettings& settings, const ShadowPoints& points,
                             const SurfacePoint& point, const Surface& lobe);

}  // namespace pivot
