// Photons: fixed, evenly spread paths of light from every kind of light, and what they leave on surfaces. The same for
// every picture of a scene, wherever its camera is.
#pragma once

#include "core/integrators/settings.h"
#include "core/lights/virtual_lights.h"
#include "core/scene/scene.h"

namespace pivot {

/// Traces them on all cores; the same scene and settings give the same lights, whatever the number of threads. What
/// comes of each light group that is asked for is apart.
std::vector<VirtualLights> trace_virtual_lights(const Scene& scene, const RenderSettings& settings);

}  // namespace pivot
