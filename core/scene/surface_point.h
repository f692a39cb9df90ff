// A ray's hit made ready for shading: place, frame, and where rays may start from it.
#pragma once

#include "core/bsdf/surface.h"
#include "core/math/frame.h"

namespace pivot {

struct SurfacePoint {
    Vec3f position;
    Vec3f normal_geometric;  ///< towards the viewer
    Frame<float> frame;      ///< z: the shading normal, towards the viewer
    float error_m;           ///< bound of position's rounding error
    bool is_front;           ///< whether normal_geometric is the triangle's own, not turned
    const Material* material;
    Vec3f wo_local;

    /// Whether both the shading and the true surface face a direction.
    bool faces(const Vec3f& wi) const { return dot(wi, normal_geometric) > 0.0f && dot(wi, frame.z) > 0.0f; }

    /// A start for rays that leave towards wi without meeting this surface again.
    Vec3f ray_origin(const Vec3f& wi) const {
        return position + normal_geometric * (dot(wi, normal_geometric) > 0.0f ? error_m : -error_m);
    }
};

}  // namespace pivot
