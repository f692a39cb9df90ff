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

/// What a surface's lobes reflect of virtual lights, before its colours.
struct VirtualReflection {
    std::array<float, 3> diffuse{};  ///< irradiance
    std::array<LobeSums<float>, 3> glossy{};
    float error = 0.0f;             ///< predicted for the closed forms and for lights taken together, relative
    float shadow_deviation = 0.0f;  ///< of what the rays say, relative

    Rgb radiance(const Base& surface) const;
};

/// Of each lane; either tree may be empty. turn: which of a light's places shadow rays ask first. links: of what
/// shines.
std::array<VirtualReflection, batch_size> reflect_virtual_lights(const Scene& scene, const RenderSettings& settings,
                                                                 const VirtualLightTree& diffuse,
                                                                 const VirtualLightTree& glossy,
                                                                 const SurfaceBatch& batch, std::uint32_t turn,
                                                                 const LightLinks& links = {});

}  // namespace pivot
