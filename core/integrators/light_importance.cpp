#include "core/integrators/light_importance.h"

namespace pivot {

LightReceiver light_receiver(const VertexOf<Batch>& vertices) {
    const JointSurface<Batch> surface = joint_surface(vertices.surface);
    const LobeAlbedoOf<Batch> lobes = lobe_albedo(vertices.surface);
    const Vec3b& wo = surface.wo_local;
    const Frame<Batch>& frame = vertices.point.frame;
    // Turned about the normal until the viewer lies above x.
    const Batch across2 = wo.x * wo.x + wo.y * wo.y, least(1e-12f);
    const auto is_along = across2 < least;
    const Batch inverse_across = inverse_sqrt(max(across2, least));
    const Batch x = select(is_along, Batch(1.0f), wo.x * inverse_across);
    const Batch y = select(is_along, Batch(0.0f), wo.y * inverse_across);
    const Batch alpha2 = surface.alpha * surface.alpha, wide = Batch(0.25f) * (Batch(1.0f) - alpha2);
    return {.position = vertices.point.position,
            .frame = {x * frame.x + y * frame.y, x * frame.y - y * frame.x, frame.z},
            .wo_x = sqrt(across2),
            .wo_z = wo.z,
            .alpha2 = alpha2,
            .wide = wide,
            .across = wide / max(wo.z * wo.z, Batch(1e-6f)),
            .diffuse = surface.diffuse,
            .fresnel_f0 = surface.fresnel_f0,
            .fresnel_f90 = surface.fresnel_f90,
            .above = lobes.above,
            .below = lobes.below,
            .around = Batch(0.0f)};
}

LightReceiver light_receiver(const Vec3f& position) {
    const Batch zero(0.0f), one(1.0f);
    return {.position = broadcast(position),
            .frame = {{one, zero, zero}, {zero, one, zero}, {zero, zero, one}},
            .wo_x = zero,
            .wo_z = one,
            .alpha2 = one,
            .wide = zero,
            .across = zero,
            .diffuse = zero,
            .fresnel_f0 = zero,
            .fresnel_f90 = zero,
            .above = zero,
            .below = zero,
            .around = one};
}

}  // namespace pivot
