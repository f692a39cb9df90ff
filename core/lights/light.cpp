#include "core/lights/light.h"

#include <stdexcept>

#include "core/sampling/warp.h"

namespace pivot {
namespace {

// Directions to a light of radius 0 still need a density: it becomes a sphere no picture can tell from a point.
constexpr float min_radius_m = 1e-5f;
constexpr float min_sun_half_angle_rad = 1e-5f;
constexpr float infinity = std::numeric_limits<float>::infinity();

void require(bool ok, const char* message) {
    if (!ok) throw std::invalid_argument(message);
}

bool is_finite(const Vec3f& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

bool is_unit(const Vec3f& v) { return std::abs(length_squared(v) - 1.0f) < 1e-3f; }

std::optional<LightPoint> sample_area(const AreaLight& light, const Vec3f& point, const Vec2f& u) {
    const Vec3f d = place_on(light, u) - point;
    const float distance_m = length(d);
    if (!(distance_m > 0.0f)) return std::nullopt;
    return light_point(light, d / distance_m, distance_m);
}

std::optional<LightPoint> intersect_area(const AreaLight& light, const Vec3f& point, const Vec3f& wi) {
    const Vec3f normal = normal_towards(light, point);
    const float cos_light = -dot(wi, normal);
    if (cos_light <= 0.0f) return std::nullopt;
    const float distance_m = dot(point - light.center, normal) / cos_light;
    if (!is_on_light(light, area_coordinates(light, point + distance_m * wi))) return std::nullopt;
    return light_point(light, wi, distance_m);
}

}  // namespace

SphereLight make_sphere_light(const Vec3f& center, float radius_m, const Rgb& intensity, bool is_facing_disk) {
    require(is_finite(center), "position must be finite");
    require(std::isfinite(radius_m) && radius_m >= 0.0f, "radius_m must be finite and not negative");
    require(is_finite(intensity), "intensity must be finite");
    const float radius = std::max(radius_m, min_radius_m);
    return {center, radius, intensity / (pi<float> * sqr(radius)), is_facing_disk};
}

SpotLight make_spot_light(const SphereLight& sphere, const Vec3f& direction, float cos_half_angle, float blend,
                          bool is_cosine) {
    require(is_unit(direction), "direction must be a unit vector");
    require(cos_half_angle >= -1.0f && cos_half_angle < 1.0f, "cos_half_angle must be in [-1, 1)");
    require(blend >= 0.0f && blend <= 1.0f, "blend must be in [0, 1]");
    return {sphere, direction, cos_half_angle, blend, is_cosine};
}

SunLight make_sun_light(const Vec3f& direction, float half_angle_rad, const Rgb& irradiance) {
    require(is_unit(direction), "direction must be a unit vector");
    require(half_angle_rad >= 0.0f && half_angle_rad <= pi<float> / 2.0f, "half_angle_rad must be in [0, pi/2]");
    require(is_finite(irradiance), "irradiance must be finite");
    const float half_angle = std::max(half_angle_rad, min_sun_half_angle_rad);
    const Cap<float> cap{normalize(direction), 2.0f * sqr(sin(0.5f * half_angle))};
    return {cap, irradiance / (pi<float> * sqr(sin(half_angle)))};
}

AreaLight make_area_light(const Vec3f& center, const Vec3f& half_u, const Vec3f& half_v, const Rgb& radiance,
                          bool ellipse, float spread_rad) {
    require(is_finite(center), "center must be finite");
    require(is_finite(half_u) && is_finite(half_v), "half_u and half_v must be finite");
    require(is_finite(radiance), "radiance must be finite");
    require(spread_rad >= 0.0f && spread_rad <= 1.001f * pi<float>, "spread_rad must be in [0, pi]");
    const Vec3f normal = cross(half_u, half_v);
    const float quarter_area = length(normal);
    require(quarter_area > 0.0f, "half_u and half_v must span an area");
    const AreaShape shape = ellipse ? AreaShape::ellipse : AreaShape::parallelogram;
    AreaLight light{center, half_u,  half_v, normal / quarter_area, quarter_area * relative_area(shape),
                    shape,  radiance};
    if (spread_rad >= 0.9999f * pi<float>) return light;
    // In double: the difference is of the third power of the angle.
    const double half = 0.5 * static_cast<double>(std::max(spread_rad, least_spread_rad)), tangent = std::tan(half);
    light.radiance *= static_cast<float>(tangent / (tangent - half));
    light.inverse_tan_spread = static_cast<float>(1.0 / tangent);
    return light;
}

std::optional<AreaLight> make_triangle_light(const std::array<Vec3f, 3>& corners, const Rgb& radiance) {
    const auto& [a, b, c] = corners;
    const Vec3f middle = 0.5f * (b + c), half_u = 0.5f * (middle - a), half_v = 0.5f * (c - b);
    const Vec3f normal = cross(half_u, half_v);
    const float half_area = length(normal);
    if (!(half_area > 0.0f)) return std::nullopt;
    constexpr AreaShape shape = AreaShape::triangle;
    return AreaLight{
        0.5f * (a + middle), half_u, half_v, normal / half_area, half_area * relative_area(shape), shape, radiance};
}

bool is_on_light(const AreaLight& light, const Vec2f& at) {
    const float x = std::abs(at.x), y = std::abs(at.y);
    switch (light.shape) {
        case AreaShape::parallelogram:
            return std::max(x, y) <= 1.0f;
        case AreaShape::ellipse:
            return x * x + y * y <= 1.0f;
        case AreaShape::triangle:
            return at.x <= 1.0f && 2.0f * y <= 1.0f + at.x;
    }
    return false;
}

Vec2f area_coordinates(const AreaLight& light, const Vec3f& place) {
    const Vec3f offset = place - light.center;
    // half_u and half_v need not be perpendicular.
    const Vec3f across_u = cross(light.half_v, light.normal);
    const Vec3f across_v = cross(light.normal, light.half_u);
    return {dot(offset, across_u) / dot(light.half_u, across_u), dot(offset, across_v) / dot(light.half_v, across_v)};
}

const SphereLight* sphere_of(const Light& light) {
    if (const auto* spot = std::get_if<SpotLight>(&light)) return &spot->sphere;
    return std::get_if<SphereLight>(&light);
}

Vec3f place_on(const AreaLight& light, const Vec2f& u) {
    Vec2f place = 2.0f * u - 1.0f;
    if (light.shape == AreaShape::ellipse) place = sample_disk(u);
    if (light.shape == AreaShape::triangle) place = place_in_triangle(u);
    return light.center + place.x * light.half_u + place.y * light.half_v;
}

std::optional<Cap<float>> cap_from(const Light& light, const Vec3f& point) {
    if (const auto* sun = std::get_if<SunLight>(&light)) return sun->cap;
    if (const SphereLight* sphere = sphere_of(light)) return cap_from(*sphere, point);
    return std::nullopt;
}

std::optional<LightPoint> light_point(const AreaLight& light, const Vec3f& wi, float distance_m) {
    const float cosine = dot(wi, light.normal), cos_light = light.is_two_sided() ? std::abs(cosine) : -cosine;
    if (cos_light <= 0.0f || distance_m <= 0.0f) return std::nullopt;
    Rgb radiance = light.radiance;
    if (light.inverse_tan_spread > 0.0f) radiance *= spread_falloff(light.inverse_tan_spread, cos_light);
    return LightPoint{wi, distance_m, radiance, sqr(distance_m) / (cos_light * light.area_m2)};
}

std::optional<LightPoint> sample_light(const Light& light, const Vec3f& point, const Vec2f& u) {
    if (const auto* area = std::get_if<AreaLight>(&light)) return sample_area(*area, point, u);
    const Cap<float> cap = *cap_from(light, point);
    return light_point_in_cap(light, cap, point, sample(cap, u));
}

std::optional<LightPoint> intersect_light(const Light& light, const Vec3f& point, const Vec3f& wi) {
    if (const auto* area = std::get_if<AreaLight>(&light)) return intersect_area(*area, point, wi);
    const Cap<float> cap = *cap_from(light, point);
    if (!contains(cap, wi)) return std::nullopt;
    return light_point_in_cap(light, cap, point, wi);
}

float distance_to_light(const Light& light, const Vec3f& point, const Vec3f& wi) {
    const SphereLight* sphere = sphere_of(light);
    if (!sphere) return infinity;
    const Vec3f to_center = sphere->center - point;
    return sphere->is_facing_disk ? distance_to_facing_disk(to_center, wi)
                                  : distance_to_sphere(to_center, sphere->radius_m, wi);
}

LightPoint light_point_in_cap(const Light& light, const Cap<float>& cap, const Vec3f& point, const Vec3f& wi) {
    const float pdf_omega = 1.0f / solid_angle(cap);
    if (const auto* sun = std::get_if<SunLight>(&light)) return {wi, infinity, sun->radiance, pdf_omega};
    const SphereLight& sphere = *sphere_of(light);
    const auto* spot = std::get_if<SpotLight>(&light);
    const Rgb radiance = spot ? sphere.radiance * spot_falloff(*spot, -dot(wi, spot->direction)) : sphere.radiance;
    return {wi, distance_to_light(light, point, wi), radiance, pdf_omega};
}

}  // namespace pivot
