// What bent cones leave of a light, lobe by lobe.
//   [Dupuy17] "A Spherical Cap Preserving Parameterization for Spherical Distributions", Sec 5.4
//
// Lobe, light and visibility integrated at once: the lobe's mass in light, bent cone and horizon [Dupuy17 (23)]. Given
// as a share of its mass in light and horizon, it serves whatever integrates the light better than one SPTD does.
#pragma once

#include "core/bsdf/surface.h"
#include "core/distributions/cap.h"
#include "core/geometry/surface_point.h"
#include "core/lights/light.h"

namespace pivot {

/// Shares of the light that each lobe reflects, 0..1.
struct SeenShare {
    float diffuse, glossy;
};

/// The cap of the shading frame that a light covers, or that an area light counts as: of its direction and solid angle.
Cap<float> local_cap(const Light& light, const SurfacePoint& point);

/// bent_cone: world space, of Scene::bent_cone. An area light counts as its local_cap.
SeenShare seen_share(const Light& light, const Cap<float>& bent_cone, const SurfacePoint& point, const Base& surface);

/// The same of light from all around.
SeenShare seen_share_of_world(const Cap<float>& bent_cone, const SurfacePoint& point, const Base& surface);

}  // namespace pivot
