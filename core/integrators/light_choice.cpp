#include "core/integrators/light_choice.h"

namespace pivot {
namespace {

/// An upper estimate: above 0 for every light that reaches the point from above its horizon.
float irradiance_estimate(const Light& light, const SurfacePoint& point) {
    if (const auto cap = cap_from(light, point.position)) {
        const float sin_half_angle = std::sqrt(sin2_half_angle(*cap));
        const float cos_nearest = dot(cap->axis, point.frame.z) + (cap->versine > 1.0f ? 1.0f : sin_half_angle);
        if (cos_nearest <= 0.0f) return 0.0f;
        const LightPoint center = light_point_in_cap(light, *cap, point.position, cap->axis);
        // A spot's falloff differs over its cap: where its axis is dark its rim may be lit.
        const auto* spot = std::get_if<SpotLight>(&light);
        const Rgb radiance = spot ? max(center.radiance, 0.01f * spot->sphere.radiance) : center.radiance;
        return max_component(radiance) * solid_angle(*cap) * std::min(cos_nearest, 1.0f);
    }
    const auto& area = std::get<AreaLight>(light);
    const Vec3f d = point.position - area.center;
    const float reach = length(area.half_u) + length(area.half_v);
    const float along = dot(d, area.normal);
    if (along <= 0.0f) return 0.0f;
    const float distance = length(d);
    const float cos_light = along / distance;
    const float cos_surface = std::min(1.0f, (reach - dot(d, point.frame.z)) / distance);
    if (cos_surface <= 0.0f) return 0.0f;
    const float angle = std::min(area.area_m2 * cos_light / sqr(distance), 2.0f * pi<float>);
    return max_component(area.radiance) * angle * cos_surface;
}

}  // namespace

std::optional<LightChoice> choose_light(const std::vector<Light>& lights, const SurfacePoint& point, float u) {
    float total = 0.0f;
    for (const Light& light : lights) total += irradiance_estimate(light, point);
    if (!(total > 0.0f)) return std::nullopt;
    float left = u * total;
    std::optional<LightChoice> choice;
    for (std::size_t i = 0; i < lights.size(); ++i) {
        const float estimate = irradiance_estimate(lights[i], point);
        if (estimate <= 0.0f) continue;
        choice = LightChoice{i, estimate / total};
        left -= estimate;
        if (left < 0.0f) break;
    }
    return choice;
}

float choice_probability(const std::vector<Light>& lights, const SurfacePoint& point, std::size_t light) {
    float total = 0.0f;
    for (const Light& other : lights) total += irradiance_estimate(other, point);
    return total > 0.0f ? irradiance_estimate(lights[light], point) / total : 0.0f;
}

}  // namespace pivot
