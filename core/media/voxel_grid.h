// Numbers on a regular grid, interpolated linearly: the density of smoke, the glow of fire.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/math/transform.h"

namespace pivot {

class VoxelGrid {
   public:
    /// size: in x, y, z. values: at least 0, x fastest, of `channels` numbers, 1 or 3. Voxel (i, j, k) has its value at
    /// the point (i, j, k) of grid space; beyond the outermost voxels values fall to 0 within one voxel. Throws
    /// std::invalid_argument naming the argument that cannot be.
    VoxelGrid(const std::array<int, 3>& size, int channels, std::vector<float> values,
              const Transform& grid_from_object);

    int channels() const { return channels_; }
    const Transform& grid_from_object() const { return grid_from_object_; }

    /// The value at a point of grid space; of one channel, the same thrice.
    Rgb at(const Vec3f& point) const;
    float density(const Vec3f& point) const { return at(point).x; }
    /// No density() is above it.
    float most() const { return most_; }

   private:
    std::array<int, 3> size_;
    int channels_;
    std::vector<float> values_;
    Transform grid_from_object_;
    float most_;
};

}  // namespace pivot
