// What media let through.
#pragma once

#include "core/scene/medium_mix.h"
#include "core/scene/scene.h"

namespace pivot {

/// What is left of light along a ray, from its origin to far_m, by the media alone.
Rgb transmittance(const Media& media, const Ray& ray, MediaAlong& along, MediumMix& mix);

/// Of each ray of a batch.
Vec3b transmittance(const Media& media, const RayOf<Batch>& rays);

}  // namespace pivot
