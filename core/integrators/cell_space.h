// Where an object's cells of light lie.
#pragma once

#include "core/lights/virtual_lights.h"
#include "core/math/transform.h"

namespace pivot {

/// Where an object's cells lie: its own space, as large as it stands in the world.
class CellSpace {
   public:
    explicit CellSpace(const Transform& world_from_object) {
        if (!world_from_object.is_invertible()) return;
        object_from_world_ = world_from_object.inverse();
        scale_ = std::cbrt(std::abs(
            dot(world_from_object.linear[0], cross(world_from_object.linear[1], world_from_object.linear[2]))));
        axis_from_world_ = glm::transpose(world_from_object.linear);
    }
    LightDeposit deposit(std::uint32_t id, std::uint32_t owner, const LightPlace& place, const Vec3f& axis,
                         const Rgb& power_w) const {
        const Vec3f normal = abs(axis_from_world_ * place.normal);
        const int flat_axis = normal.x >= normal.y && normal.x >= normal.z ? 0 : normal.y >= normal.z ? 1 : 2;
        return {place,
                axis,
                power_w,
                id,
                owner,
                object_from_world_.point(place.position) * scale_,
                normalize(axis_from_world_ * axis),
                flat_axis};
    }

   private:
    Transform object_from_world_{};
    Mat3<float> axis_from_world_{1.0f};
    float scale_ = 1.0f;
};

}  // namespace pivot
