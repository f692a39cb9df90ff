// What lights the analytic integrator's picture, made ready before the first sample.
#pragma once

#include "core/integrators/settings.h"
#include "core/lights/virtual_lights.h"
#include "core/scene/scene.h"

namespace pivot {

/// A light in closed form.
struct ExactLight {
    Light light;
    LightRules rules{};
    std::uint32_t group = no_light_group;
};

/// Triangles of meshes that have rules and a light group in common.
struct EmittedLights {
    LightRules rules{};
    std::uint32_t group = no_light_group;
    /// On their normals' side, and on the other, of which closed meshes hide one.
    std::array<VirtualLightTree, 2> sides;
};

struct AnalyticLights {
    std::vector<ExactLight> exact;  ///< the scene's lamps, then triangles of meshes that give much of what they all do
    std::vector<EmittedLights> emitted;  ///< the other triangles
    std::vector<VirtualLights> bounced;  ///< if asked for: of each light group that is told apart, and of the rest
};

/// Works on all cores; the same scene and settings give the same lights.
AnalyticLights gather_lights(const Scene& scene, const RenderSettings& settings);

/// Whether, of one scene, that is the same by both settings.
bool gather_the_same(const RenderSettings& settings, const RenderSettings& others);

}  // namespace pivot
