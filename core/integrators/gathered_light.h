// What surfaces send to the viewer of all light, within the analytic integrator's error budget: lamps and the world in
// closed form, times the share of them that fixed rays see; virtual lights; and lobes without closed forms by points.
#pragma once

#include "core/integrators/analytic_lights.h"
#include "core/integrators/group_light.h"
#include "core/integrators/look_rays.h"
#include "core/integrators/shadow_points.h"
#include "core/integrators/shared_reflections.h"
#include "core/shading/method.h"

namespace pivot {

/// A surface's light so far, the methods weighted by what they contribute.
struct Gathered {
    Rgb radiance{0.0f}, indirect{0.0f}, method{0.0f};
    float size = 0.0f;  ///< of the light, whatever its sign
    float error = 0.0f, shadow_variance = 0.0f;

    void add(const Rgb& light, Method how, float relative_error);
    void add(const Gathered& part);
};

/// Of each surface, after so many bounces. pixels: of each sample. sample_index: of all these. shared: what is known of
/// virtual lights in these pixels, of each of lights.bounced. groups: of the samples; null: nobody asks.
std::vector<Gathered> gather_light(const Scene& scene, const RenderSettings& settings, const AnalyticLights& lights,
                                   const ShadowPoints& points, std::uint32_t bounce, std::span<const LookedAt> surfaces,
                                   std::span<const std::uint32_t> pixels, std::uint32_t sample_index,
                                   std::span<SharedReflections> shared, GroupLight* groups);

}  // namespace pivot
