#include "core/media/voxel_grid.h"

#include <tbb/parallel_for.h>

#include <stdexcept>

namespace pivot {
namespace {

void require(bool ok, const char* message) {
    if (!ok) throw std::invalid_argument(message);
}

}  // namespace

VoxelGrid::VoxelGrid(const std::array<int, 3>& size, int channels, std::span<const float> values,
                     const Transform& grid_from_object)
    : channels_(channels), grid_from_object_(grid_from_object) {
    require(channels == 1 || channels == 3, "voxel grid: values have one channel or three");
    require(std::ranges::min(size) >= 1, "voxel grid: values must not be empty");
    double brick_count = 1.0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const int cells = size[axis] + 1;
        cells_[static_cast<int>(axis)] = static_cast<float>(cells);
        brick_counts_[axis] = (cells + brick_cells - 1) / brick_cells;
        brick_count *= brick_counts_[axis];
    }
    constexpr int most_size = 1 << 20;  // places among so many are exact to 1/8 in float
    require(std::ranges::max(size) <= most_size && brick_count < std::numeric_limits<std::int32_t>::max(),
            "voxel grid: values are too many");

    /// Calls visit(voxel in its brick, value) with each of a brick's numbers that the values have.
    const auto for_each_value = [&](std::size_t brick, const auto& visit) {
        std::array<int, 3> first, from, to;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto count = static_cast<std::size_t>(brick_counts_[axis]);
            first[axis] = static_cast<int>(brick % count) * brick_cells - 1;
            from[axis] = std::max(first[axis], 0);
            to[axis] = std::min(first[axis] + brick_edge, size[axis]);
            brick /= count;
        }
        for (int z = from[2]; z < to[2]; ++z)
            for (int y = from[1]; y < to[1]; ++y) {
                const auto row =
                    (static_cast<std::size_t>(z) * static_cast<std::size_t>(size[1]) + static_cast<std::size_t>(y)) *
                    static_cast<std::size_t>(size[0]);
                const int row_of_brick = ((z - first[2]) * brick_edge + y - first[1]) * brick_edge;
                for (int x = from[0]; x < to[0]; ++x)
                    for (int channel = 0; channel < channels; ++channel)
                        visit(static_cast<std::size_t>(row_of_brick + x - first[0] + channel * brick_voxels),
                              values[(row + static_cast<std::size_t>(x)) * static_cast<std::size_t>(channels) +
                                     static_cast<std::size_t>(channel)]);
            }
    };

    scales_.resize(static_cast<std::size_t>(brick_count));
    starts_.resize(scales_.size());
    constexpr float bad = -1.0f;
    tbb::parallel_for(std::size_t{0}, scales_.size(), [&](std::size_t brick) {
        float most = 0.0f;
        bool is_good = true;
        for_each_value(brick, [&](std::size_t, float value) {
            is_good = is_good && value >= 0.0f && value <= std::numeric_limits<float>::max();
            most = max(most, value);
        });
        const float scale = most / steps;
        scales_[brick] = !is_good ? bad : scale >= tiny<float> ? scale : 0.0f;
    });
    require(std::ranges::min(scales_) != bad, "voxel grid: values must be finite and not negative");
    most_ = majorant_of(std::ranges::max(scales_));

    const std::size_t stride = static_cast<std::size_t>(channels) * brick_voxels;
    std::size_t end = stride;  // the first brick is that of zeros
    for (std::size_t brick = 0; brick < scales_.size(); ++brick) {
        if (scales_[brick] == 0.0f) continue;
        require(end + stride <= static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()),
                "voxel grid: values are too many");
        starts_[brick] = static_cast<std::int32_t>(end);
        end += stride;
    }
    voxels_.resize(end);
    tbb::parallel_for(std::size_t{0}, scales_.size(), [&](std::size_t brick) {
        if (starts_[brick] == 0) return;
        std::uint16_t* voxels = &voxels_[static_cast<std::size_t>(starts_[brick])];
        for_each_value(brick, [&](std::size_t voxel, float value) {
            voxels[voxel] = static_cast<std::uint16_t>(min(value / scales_[brick] + 0.5f, steps));
        });
    });
}

}  // namespace pivot
