// Numbers on a regular grid, interpolated linearly: the density of smoke, the glow of fire.
//
// They are kept in bricks of 8^3 cells, each with the 9^3 voxels at the cells' corners: a lookup reads one brick, no
// lookup is above its brick's largest voxel, and all bricks of zeros are one. A voxel has 16 bits, in parts of the
// largest of its brick. Bricks of 4^3 are as large in memory, and make rays through smoke a third slower and their
// estimates half as noisy, where noise is small already; those of 16^3 take more memory.
#pragma once

#include <span>
#include <vector>

#include "core/math/transform.h"
#include "core/media/grid_walk.h"
#include "core/simd/batch.h"

namespace pivot {

class VoxelGrid {
   public:
    static constexpr int brick_cells = 8;

    /// size: in x, y, z. values: at least 0, x fastest, of `channels` numbers, 1 or 3. Voxel (i, j, k) has its value at
    /// the point (i, j, k) of grid space; beyond the outermost voxels values fall to 0 within one voxel. Throws
    /// std::invalid_argument naming the argument that cannot be.
    VoxelGrid(const std::array<int, 3>& size, int channels, std::span<const float> values,
              const Transform& grid_from_object);

    int channels() const { return channels_; }
    const Transform& grid_from_object() const { return grid_from_object_; }
    /// The box in grid space outside of which all values are 0.
    Vec3f low() const { return Vec3f(-1.0f); }
    Vec3f high() const { return low() + cells_; }

    /// The value at a point of grid space; of one channel, the same thrice. Over float or batches.
    template <class T>
    Vec3<T> at(const Vec3<T>& point) const {
        const Place<T> place = find(point);
        const T x = value(place, 0);
        return channels_ == 1 ? Vec3<T>(x) : Vec3<T>(x, value(place, 1), value(place, 2));
    }
    /// The value, of three channels the first.
    template <class T>
    T density(const Vec3<T>& point) const {
        return value(find(point), 0);
    }
    /// No value is above it.
    float most() const { return most_; }

    /// Calls visit(near_m, far_m, majorant) with each brick in order that a ray crosses and that is not empty, until it
    /// returns false. No value of any channel in [near_m, far_m] is above the majorant; what no visit covers is 0.
    /// Grid space; direction: per metre, of any length.
    template <class Visit>
    void for_each_cell(const Vec3f& origin, const Vec3f& direction, float near_m, float far_m,
                       const Visit& visit) const {
        constexpr float bricks_per_cell = 1.0f / brick_cells;
        walk_grid((origin - low()) * bricks_per_cell, direction * bricks_per_cell, near_m, far_m,
                  cells_ * bricks_per_cell, [&](float from_m, float to_m, const std::array<int, 3>& brick) {
                      const float majorant = majorant_of(scales_[brick_number(brick)]);
                      return majorant == 0.0f || visit(from_m, to_m, majorant);
                  });
    }

    std::size_t memory_bytes() const {
        return voxels_.size() * sizeof(voxels_[0]) + scales_.size() * (sizeof(scales_[0]) + sizeof(starts_[0]));
    }

   private:
    static constexpr int brick_edge = brick_cells + 1, brick_voxels = brick_edge * brick_edge * brick_edge;
    static constexpr float steps = 65535.0f;  // of a voxel's 16 bits

    /// Where a point is.
    template <class T>
    struct Place {
        Index<T> first;  ///< of its cell's voxels, in the first channel
        T scale;
        Vec3<T> along;  ///< within the cell, 0 to 1
    };

    std::size_t brick_number(const std::array<int, 3>& brick) const {
        return static_cast<std::size_t>((brick[2] * brick_counts_[1] + brick[1]) * brick_counts_[0] + brick[0]);
    }
    /// With room for what rounding adds to an interpolated value.
    static float majorant_of(float scale) { return scale * (steps * (1.0f + 1e-6f)); }

    template <class T>
    Place<T> find(const Vec3<T>& point) const {
        Index<T> brick(0), voxel(0);
        Vec3<T> along;
        for (int axis = 2; axis >= 0; --axis) {
            const T cells(cells_[axis]), from_low = point[axis] - T(low()[axis]);
            const T inside = select(from_low > T(0.0f), min(from_low, cells), T(0.0f));  // a NaN is at 0
            const T cell = min(floor(inside), cells - T(1.0f));
            const T of_brick = floor(cell * T(1.0f / brick_cells));
            brick = brick * Index<T>(brick_counts_[static_cast<std::size_t>(axis)]) + to_index(of_brick);
            voxel = voxel * Index<T>(brick_edge) + to_index(cell - of_brick * T(brick_cells));
            along[axis] = inside - cell;
        }
        return {fetch(starts_.data(), brick) + voxel, fetch(scales_.data(), brick), along};
    }
    template <class T>
    T value(const Place<T>& place, int channel) const {
        const auto row = [&](int y, int z) {
            const int offset = channel * brick_voxels + (z * brick_edge + y) * brick_edge;
            const Vec2<T> ends = fetch_pair<T>(voxels_.data(), place.first + Index<T>(offset));
            return lerp(ends.x, ends.y, place.along.x);
        };
        const T low_z = lerp(row(0, 0), row(1, 0), place.along.y), high_z = lerp(row(0, 1), row(1, 1), place.along.y);
        return lerp(low_z, high_z, place.along.z) * place.scale;
    }

    Vec3f cells_;  ///< how many there are, with those that fall to 0 around the voxels
    int channels_;
    Transform grid_from_object_;
    std::array<int, 3> brick_counts_;
    std::vector<float> scales_;         ///< by brick: what a voxel's number counts
    std::vector<std::int32_t> starts_;  ///< by brick: its first voxel; those of each channel follow each other
    std::vector<std::uint16_t> voxels_;
    float most_ = 0.0f;
};

}  // namespace pivot
