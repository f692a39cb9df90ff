#include "core/integrators/area_sampling.h"

namespace pivot {

bool needs_bsdf_samples(const AreaLight& light, const SurfacePoint& point) {
    if (light.shape == AreaShape::triangle) return true;
    const float reach_m = 1.2f * (length(light.half_u) + length(light.half_v));
    return length_squared(light.center - point.position) < sqr(reach_m) || point.wo_local.z < 0.05f;
}

AreaView<float> view_from(const AreaLight& light, const SurfacePoint& point) {
    return {.center = point.frame.to_local(light.center - point.position),
            .half_u = point.frame.to_local(light.half_u),
            .half_v = point.frame.to_local(light.half_v),
            .normal = point.frame.to_local(normal_towards(light, point.position)),
            .parallelogram_m2 = parallelogram_m2(light),
            .ellipse = light.shape == AreaShape::ellipse,
            .triangle = light.shape == AreaShape::triangle};
}

JointSurface<float> joint_surface(const Surface& surface) {
    return {.wo_local = surface.wo_local,
            .alpha = surface.alpha,
            .diffuse = mean_component(surface.diffuse),
            .fresnel_f0 = mean_component(surface.fresnel.schlick_f0 + surface.fresnel.dielectric_f0),
            .fresnel_f90 = mean_component(surface.fresnel.schlick_f90 + surface.fresnel.dielectric_f90)};
}

}  // namespace pivot
