#include "core/integrators/specular_occlusion.h"

#include "core/distributions/spherical_polygon.h"
#include "core/distributions/sptd.h"
#include "core/tables/ggx_sptd.h"

namespace pivot {
namespace {

const Cap<float> horizon{Vec3f(0.0f, 0.0f, 1.0f), 1.0f};

float share(float part, float whole) { return whole > 0.0f ? clamp01(part / whole) : 0.0f; }

/// Both caps in the shading frame.
SeenShare seen_share_of_cap(const Cap<float>& light, const Cap<float>& bent_cone, const Base& surface) {
    SeenShare seen{};
    if (surface.has_diffuse()) {
        const std::array<Cap<float>, 2> both{light, bent_cone};
        seen.diffuse = share(clamped_cosine_integral(both, horizon.axis), clamped_cosine_integral(light, horizon.axis));
    }
    if (surface.has_glossy()) {
        const GgxSptd lobe = ggx_sptd(surface.alpha, surface.wo_local);
        const Pivot<float> pivot{lobe.pivot_local, lobe.delta};
        seen.glossy =
            share(integrate_uniform(pivot, {light, bent_cone, horizon}), integrate_uniform(pivot, light, horizon));
    }
    return seen;
}

Cap<float> to_local(const Frame<float>& frame, const Cap<float>& cap) {
    return {normalize(frame.to_local(cap.axis)), cap.versine};
}

Cap<float> cap_like(const AreaLight& light, const Vec3f& position) {
    const Vec3f center = light.center - position;
    const std::array<Vec3f, 4> corners{
        normalize(center - light.half_u - light.half_v), normalize(center + light.half_u - light.half_v),
        normalize(center + light.half_u + light.half_v), normalize(center - light.half_u + light.half_v)};
    const float covered = abs(solid_angle<float>(corners)) * 0.25f * relative_area(light.shape);
    return {normalize(center), covered / (2.0f * pi<float>)};
}

}  // namespace

Cap<float> local_cap(const Light& light, const SurfacePoint& point) {
    const auto cap = cap_from(light, point.position);
    return to_local(point.frame, cap ? *cap : cap_like(std::get<AreaLight>(light), point.position));
}

SeenShare seen_share(const Light& light, const Cap<float>& bent_cone, const SurfacePoint& point, const Base& surface) {
    return seen_share_of_cap(local_cap(light, point), to_local(point.frame, bent_cone), surface);
}

SeenShare seen_share_of_world(const Cap<float>& bent_cone, const SurfacePoint& point, const Base& surface) {
    return seen_share_of_cap(horizon, to_local(point.frame, bent_cone), surface);
}

}  // namespace pivot
