#include "core/media/voxel_grid.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace pivot {

VoxelGrid::VoxelGrid(const std::array<int, 3>& size, int channels, std::vector<float> values,
                     const Transform& grid_from_object)
    : size_(size), channels_(channels), values_(std::move(values)), grid_from_object_(grid_from_object) {
    if (channels != 1 && channels != 3) throw std::invalid_argument("voxel grid: values have one channel or three");
    if (std::ranges::min(size) < 1) throw std::invalid_argument("voxel grid: values must not be empty");
    if (!std::ranges::all_of(values_, [](float v) { return std::isfinite(v) && v >= 0.0f; }))
        throw std::invalid_argument("voxel grid: values must be finite and not negative");
    most_ = std::ranges::max(values_);
}

Rgb VoxelGrid::at(const Vec3f& point) const {
    const Vec3f low(std::floor(point.x), std::floor(point.y), std::floor(point.z));
    Rgb sum(0.0f);
    for (int corner = 0; corner < 8; ++corner) {
        float weight = 1.0f;
        std::size_t place = 0;
        for (int axis = 2; axis >= 0; --axis) {
            const bool upper = (corner >> axis & 1) != 0;
            const float along = point[axis] - low[axis], at = low[axis] + (upper ? 1.0f : 0.0f);
            const int n = size_[static_cast<std::size_t>(axis)];
            weight *= upper ? along : 1.0f - along;
            if (!(at >= 0.0f && at < static_cast<float>(n)))
                weight = 0.0f;
            else
                place = place * static_cast<std::size_t>(n) + static_cast<std::size_t>(at);
        }
        if (weight == 0.0f) continue;
        const float* value = &values_[place * static_cast<std::size_t>(channels_)];
        sum += weight * (channels_ == 3 ? Rgb(value[0], value[1], value[2]) : Rgb(value[0]));
    }
    return sum;
}

}  // namespace pivot
