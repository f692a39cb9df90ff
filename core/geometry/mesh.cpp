#include "core/geometry/mesh.h"

#include <cmath>
#include <stdexcept>

#include "core/math/moving_transform.h"

namespace pivot {

void require_steps(const Mesh& mesh) {
    const auto is_like_mesh = [&](const MeshStep& step) {
        return step.positions.size() == mesh.positions.size() &&
               step.corner_normals.size() == mesh.corner_normals.size() &&
               step.vertex_normals.size() == mesh.vertex_normals.size();
    };
    if (mesh.steps.size() < 2 || mesh.steps.size() > MovingTransform::max_steps ||
        !std::ranges::all_of(mesh.steps, is_like_mesh))
        throw std::invalid_argument("mesh '" + mesh.name +
                                    "': its motion needs 2 to 129 steps of as many vertices and corners as it has");
    const auto is_finite = [](const Vec3f& v) {
        return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
    };
    for (const MeshStep& step : mesh.steps)
        if (!std::ranges::all_of(step.positions, is_finite))
            throw std::invalid_argument("mesh '" + mesh.name + "': a vertex is not finite as it moves");
}

}  // namespace pivot
