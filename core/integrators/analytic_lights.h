// What lights the analytic integrator's picture, made ready before the first sample.
#pragma once

#include "core/integrators/settings.h"
#include "core/lights/virtual_lights.h"
#include "core/scene/scene.h"

namespace pivot {

struct AnalyticLights {
    std::vector<Light> exact;       ///< the scene's lamps, then triangles of meshes that give much of what they all do
    std::vector<LightRules> rules;  ///< of each of these; empty: there are none
    /// By the other triangles: on their normals' side, and on the other, of which closed meshes hide one.
    std::array<VirtualLightTree, 2> emitted;
    VirtualLights bounced;  ///< if asked for
};

/// Works on all cores; the same scene and settings give the same lights.
AnalyticLights gather_lights(const Scene& scene, const RenderSettings& settings);

/// Whether, of one scene, that is the same by both settings.
bool gather_the_same(const RenderSettings& settings, const RenderSettings& others);

}  // namespace pivot
