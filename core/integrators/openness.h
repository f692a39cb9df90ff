// What shaders learn of the surfaces around theirs by rays: Blender's Ambient Occlusion node.
#pragma once

#include "core/scene/scene.h"

namespace pivot {

/// The share of rays, by the cosine about the question's normal, that meet nothing which casts shadows. The rays of a
/// place are turned by its bits, so that samples of a pixel see others. instances: that the points are of.
Batch openness_around(const Scene& scene, const SurfacePointOf<Batch>& point,
                      const std::array<std::uint32_t, batch_size>& instances, const OpennessQuestion& question);

}  // namespace pivot
