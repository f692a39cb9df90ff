// How far light goes through a medium whose density is a grid: distances of collisions, and transmittance.
//
// Bricks of the grid that are thin along the ray are crossed by null collisions against the brick's majorant; dense
// ones cell by cell, in closed form: along a ray the density of one cell is a cubic, which two Gauss points integrate.
// So the time is bounded by the grid's size whatever the density.
//
// [Novak14]  Residual Ratio Tracking for Estimating Attenuation in Participating Media
// [Kutz17]   Spectral and Decomposition Tracking for Rendering Heterogeneous Volumes
#pragma once

#include <optional>

#include "core/media/voxel_grid.h"
#include "core/sampling/random_stream.h"

namespace pivot {

/// Part of a ray in a grid's space.
struct GridRay {
    Vec3f origin, direction;  ///< direction: per metre, of any length
    float near_m, far_m;

    Vec3f at(float distance_m) const { return origin + distance_m * direction; }
};

/// The integral of the density along a ray, exact but for rounding. Without noise.
float density_integral(const VoxelGrid& density, const GridRay& ray);

/// An unbiased estimate of exp(-sigma_t density_integral), at least 0. sigma_t: 1/m where the density is 1.
Rgb transmittance(const VoxelGrid& density, const GridRay& ray, const Rgb& sigma_t, RandomStream& stream);

struct Collision {
    std::optional<float> distance_m;  ///< none: the ray goes through
    /// What the path carries on: in the mean over samples, the given times sigma_t density T at a collision per metre,
    /// and times T where the ray goes through. The sum of its channels stays as it was.
    Rgb throughput;
};

/// Samples where a path of a throughput, not negative, meets the medium.
Collision sample_collision(const VoxelGrid& density, const GridRay& ray, const Rgb& sigma_t, const Rgb& throughput,
                           RandomStream& stream);

}  // namespace pivot
