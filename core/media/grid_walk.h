// The cells of a regular grid that a ray crosses, one after the other.
//
// [Amanatides87]  A Fast Voxel Traversal Algorithm for Ray Tracing
//
// Departure: where a ray leaves a cell is computed from the cell's number, not summed up, so that errors do not grow.
#pragma once

#include <array>

#include "core/math/vector.h"

namespace pivot {

/// Cells are unit cubes in the box from 0 to extent, the last of each axis cut off by it. Calls
/// visit(near_m, far_m, cell) with each cell in order until it returns false; the parts meet, and cover what of
/// [near_m, far_m] is in the box. direction: in cells per metre, of any length. A ray that never leaves the box is
/// taken to miss it.
template <class Visit>
void walk_grid(const Vec3f& origin, const Vec3f& direction, float near_m, float far_m, const Vec3f& extent,
               const Visit& visit) {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    float enter = near_m, leave = far_m;
    for (int axis = 0; axis < 3; ++axis) {
        const float o = origin[axis], d = direction[axis];
        if (d == 0.0f) {
            if (!(o >= 0.0f && o <= extent[axis])) return;
            continue;
        }
        const float at_low = -o / d, at_high = (extent[axis] - o) / d;
        enter = max(enter, min(at_low, at_high));
        leave = min(leave, max(at_low, at_high));
    }
    if (!(enter < leave && leave < infinity && dot(direction, direction) < infinity)) return;

    std::array<int, 3> cell, count;
    const auto boundary = [&](int axis) {
        const float d = direction[axis], beyond = d > 0.0f ? 1.0f : 0.0f;
        const auto i = static_cast<std::size_t>(axis);
        return d == 0.0f ? infinity : (static_cast<float>(cell[i]) + beyond - origin[axis]) / d;
    };
    Vec3f next;
    for (int axis = 0; axis < 3; ++axis) {
        const auto i = static_cast<std::size_t>(axis);
        const float last = std::ceil(extent[axis]) - 1.0f, at = floor(origin[axis] + enter * direction[axis]);
        count[i] = static_cast<int>(last) + 1;
        cell[i] = static_cast<int>(at > 0.0f ? min(at, last) : 0.0f);
        next[axis] = boundary(axis);
    }
    while (enter < leave) {
        const int axis = next.x <= next.y && next.x <= next.z ? 0 : next.y <= next.z ? 1 : 2;
        const float end = min(next[axis], leave);
        if (end > enter) {
            if (!visit(enter, end, cell)) return;
            enter = end;
        }
        const auto i = static_cast<std::size_t>(axis);
        cell[i] += direction[axis] > 0.0f ? 1 : -1;
        if (cell[i] < 0 || cell[i] >= count[i]) return;
        next[axis] = boundary(axis);
    }
}

}  // namespace pivot
