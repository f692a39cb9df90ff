// Paths on their straight ways: the camera's rays, and those between two vertices.
#pragma once

#include "core/integrators/fog.h"

namespace pivot {

/// The ways of a batch's rays, and the passages that these hold.
struct BatchWays {
    std::vector<Passage> passages;
    std::vector<WayOn> ways;  ///< empty: the scene has no transparent surfaces
};

/// Has the rays of a batch of paths go straight on from what they first met: sets that, and their kinds, to what they
/// are at the end. spread: how much footprints grow on the way, m for each m.
BatchWays go_on(const Work& work, std::uint32_t bounce, std::span<const Path> paths, const RayOf<Batch>& rays,
                const Batch& spread, RayHitOf<Batch>& hit, WordBatch& ray_kind);

/// The camera's rays, up to what they show; those that meet nothing end here.
void start_paths(const Work& work, Fog* fog, std::span<const Ray> camera_rays, Paths& paths);

}  // namespace pivot
