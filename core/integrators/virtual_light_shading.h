// What surfaces reflect of virtual lights: a cut through their trees for each point, each light of it in closed form
// over both lobes, and fixed shadow rays.
//
// Lights together stand for those below them where they look small; between that and where they do not, both count in
// part, so that nothing jumps from one point to the next.
#pragma once

#include "core/integrators/surface_batch.h"
#include "core/lights/virtual_lights.h"
#include "core/scene/scene.h"

namespace pivot {

/// Of each lane.
struct VirtualReflection {
    std::array<Rgb, batch_size> radiance{};
    Lanes error{};            ///< predicted for the closed forms and for lights taken together, as radiance
    Lanes shadow_variance{};  ///< of what the rays say, radiance squared
};

/// Either tree may be empty.
VirtualReflection reflect_virtual_lights(const Scene& scene, const RenderSettings& settings,
                                         const VirtualLightTree& diffuse, const VirtualLightTree& glossy,
                                         const SurfaceBatch& batch, std::uint32_t sample_index);

}  // namespace pivot
