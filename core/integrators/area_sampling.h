// Samples of an area light in proportion to what a surface reflects of its parts: the light is cut into eight patches,
// one is chosen by the closed form's integral over each, and cut again while it is large beside the lobe. Uniform by
// area within the last.
#pragma once

#include "core/lights/light.h"
#include "core/scene/surface_point.h"

namespace pivot {

/// Whether the last patches are no larger than the lobe; else BSDF samples must share.
bool area_patches_suffice(const AreaLight& light, const SurfacePoint& point, const Surface& surface);

/// Nothing where the light does not reach the point.
std::optional<LightPoint> sample_area_jointly(const AreaLight& light, const SurfacePoint& point, const Surface& surface,
                                              const Vec2f& u);

/// Density of sample_area_jointly at a place on the light.
float pdf_omega_area_jointly(const AreaLight& light, const SurfacePoint& point, const Surface& surface,
                             const LightPoint& place);

}  // namespace pivot
