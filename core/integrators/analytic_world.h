// A world of one colour, for the analytic integrator: each lobe reflects it by its albedo, times the share of it that
// the lobe's fixed directions see.
#pragma once

#include "core/integrators/shadow_points.h"

namespace pivot {

struct WorldReflection {
    Rgb diffuse{0.0f}, glossy{0.0f};
    float bump_error = 0.0f;       ///< predicted of the diffuse half, relative to it
    float cone_error = 0.0f;       ///< of what a bent cone says is seen, as radiance
    float shadow_variance = 0.0f;  ///< what the rays leave of the share that is seen: radiance squared
};

/// Of a world that nothing hides.
WorldReflection reflect_whole_world(const Scene& scene, const ShadingPoint& shading);

/// What is left of it where the scene is in front. total: the point's light from the world and all lights.
WorldReflection world_seen_by_rays(const WorldReflection& whole, const Scene& scene, const ShadowPoints& points,
                                   const ShadingPoint& shading, float total);
WorldReflection world_seen_by_cone(const WorldReflection& whole, const ShadingPoint& shading);

/// How far off a share that a cone sees may be: of a light seen in part, the cone may leave any part.
float error_of_bent_cone(const Rgb& whole, float seen);

}  // namespace pivot
