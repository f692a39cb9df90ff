// Paths of one material at their vertices, a batch of them at a time, and what these tell samples and passes.
#pragma once

#include "core/integrators/path.h"

namespace pivot {

/// Up to a batch of paths at their vertices.
struct PathBatch {
    std::span<const Path> paths;
    PathOf<Batch> lanes;
    Vec3b emission;
    VertexBatch vertices;
};

/// What paths do at their vertices: they arrive from outside, or come out from beneath the surface.
enum class Vertices { arrivals, exits };

/// As many of the paths as a batch can take, of those from the first on.
PathBatch make_batch(const Work& work, std::uint32_t bounce, std::span<const Path> paths, Vertices kind);

/// What the passes tell of the first hits, and their own light.
void see_first_hits(const Work& work, const PathBatch& batch);

/// What a denoiser goes by, up to the first surface that is not like a mirror or clear glass; of paths that meet none,
/// the last.
void see_features(const Work& work, std::uint32_t bounce, const PathBatch& batch);

/// Adds the light that paths, of that throughput, bring by way of their vertices, and of it what was noted of groups.
void add_light(const Work& work, std::uint32_t bounce, const PathBatch& batch, const Vec3b& throughput,
               const Vec3b& radiance);

/// Notes by what the paths' first vertices reflect what is added next.
void set_pass_shares(const Work& work, const PathBatch& batch, const LightSharesOf<Batch>& shares);

}  // namespace pivot
