// Lights of finite size. A point sees a sphere, a spot and a sun as a spherical cap, an area light as its outline.
// World space; wi points from the lit point towards the light.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <variant>

#include "core/distributions/cap.h"

namespace pivot {

/// A sphere that shines alike in all directions, or, with Blender's soft falloff, the disk of that radius turned to
/// whichever point it lights. Radius 0 is a very small sphere of the same intensity.
struct SphereLight {
    Vec3f center;
    float radius_m;
    Rgb radiance;
    bool is_facing_disk;
};

/// A sphere whose radiance falls off from its axis to the edge of a cone; Blender's spot.
struct SpotLight {
    SphereLight sphere;
    Vec3f direction;  ///< where it shines, unit
    float cos_half_angle;
    float blend;     ///< 0: hard edge, 1: falls off from the axis on
    bool is_cosine;  ///< the radiance also falls off by the cosine from the axis, as in Blender before 4.0
};

/// Light from a cap of directions, the same everywhere.
struct SunLight {
    Cap<float> cap;
    Rgb radiance;
};

/// Which places center + x half_u + y half_v of an area light shine: |x| <= 1 and |y| at most 1, sqrt(1 - x^2) or
/// (1 + x) / 2.
enum class AreaShape : std::uint8_t { parallelogram, ellipse, triangle };

/// A flat light. A triangle of a mesh shines from both sides, others from one. With a spread, slats before it hide the
/// more of it the further one looks from the normal, as Cycles has it: of its radiance 1 - tan / tan(spread / 2) is
/// left.
struct AreaLight {
    Vec3f center;
    Vec3f half_u, half_v;
    Vec3f normal;  ///< the side that shines, unit
    float area_m2;
    AreaShape shape;
    Rgb radiance;                     ///< along the normal
    float inverse_tan_spread = 0.0f;  ///< 1 / tan(spread / 2); 0: it shines alike to all sides

    bool is_two_sided() const { return shape == AreaShape::triangle; }
};

/// All emit linear RGB radiance; a negative one is subtracted.
using Light = std::variant<SphereLight, SpotLight, SunLight, AreaLight>;

// Each throws std::invalid_argument naming the argument that cannot be.

/// intensity: W/(sr) of the whole sphere towards any side, Blender's power / (4 pi).
SphereLight make_sphere_light(const Vec3f& center, float radius_m, const Rgb& intensity, bool is_facing_disk);
SpotLight make_spot_light(const SphereLight& sphere, const Vec3f& direction, float cos_half_angle, float blend,
                          bool is_cosine);
/// direction: towards the sun, unit. irradiance: of a surface that faces it.
SunLight make_sun_light(const Vec3f& direction, float half_angle_rad, const Rgb& irradiance);
/// half_u, half_v: from the centre to the middle of two sides. Shines towards cross(half_u, half_v). radiance: without
/// spread; a narrower one, of at least least_spread_rad, leaves the power as it is.
AreaLight make_area_light(const Vec3f& center, const Vec3f& half_u, const Vec3f& half_v, const Rgb& radiance,
                          bool ellipse, float spread_rad);
inline constexpr float least_spread_rad = pi<float> / 180.0f;
/// Of a mesh, with these corners. Nothing where they span no area.
std::optional<AreaLight> make_triangle_light(const std::array<Vec3f, 3>& corners, const Rgb& radiance);

/// A place in the light's plane along half_u and half_v.
Vec2f area_coordinates(const AreaLight& light, const Vec3f& place);

/// The range of cosines over which a spot falls off.
inline float spot_falloff_width(const SpotLight& spot) {
    return std::max((1.0f - spot.cos_half_angle) * spot.blend, 1e-6f);
}

/// Falloff of a spot, 0..1, at a part of that range from its edge.
template <class T>
T falloff_of(T part) {
    const T t = clamp01(part);
    return t * t * (T(3.0f) - T(2.0f) * t);
}

/// Falloff of a spot, 0..1, towards a point; cosine: of the angle between there and where the spot shines.
template <class T>
T spot_falloff(const SpotLight& spot, T cosine) {
    const T falloff = falloff_of((cosine - T(spot.cos_half_angle)) / T(spot_falloff_width(spot)));
    return spot.is_cosine ? falloff * max(cosine, T(0)) : falloff;
}

/// What a spread leaves of the radiance at that cosine from the normal.
template <class T>
T spread_falloff(const T& inverse_tan_spread, const T& cosine) {
    const T tangent = safe_sqrt(T(1) - cosine * cosine) / max(cosine, T(1e-6f));
    return max(T(1) - inverse_tan_spread * tangent, T(0));
}

/// Along wi to the disk about to_center that faces the origin.
template <class T>
T distance_to_facing_disk(const Vec3<T>& to_center, const Vec3<T>& wi) {
    return length_squared(to_center) / max(dot(to_center, wi), tiny<T>);
}

/// Along wi to the near side of the sphere about to_center, or to its far side from within.
template <class T>
T distance_to_sphere(const Vec3<T>& to_center, T radius, const Vec3<T>& wi) {
    const T along = dot(to_center, wi), radius2 = radius * radius;
    const T half_chord = safe_sqrt(radius2 - length_squared(to_center - along * wi));
    const T distance = select(length_squared(to_center) > radius2, along - half_chord, along + half_chord);
    return max(distance, T(0));  // a receiver that touches the sphere
}

/// Area of a shape over |half_u x half_v|.
constexpr float relative_area(AreaShape shape) {
    switch (shape) {
        case AreaShape::parallelogram:
            return 4.0f;
        case AreaShape::ellipse:
            return pi<float>;
        case AreaShape::triangle:
            return 2.0f;
    }
    return 0.0f;
}

/// |half_u x half_v|.
inline float parallelogram_m2(const AreaLight& light) { return light.area_m2 / relative_area(light.shape); }

/// Lamps end their shadow rays a little early, lest a mesh that touches one become an occluder by rounding.
inline constexpr float shadow_reach = 1.0f - 1e-5f;

/// Bound of the rounding error of where rays meet a mesh's triangle, along its normal. 0 of lamps, which rays do not
/// see.
inline float surface_error_m(const AreaLight& light) {
    if (light.shape != AreaShape::triangle) return 0.0f;
    constexpr float error_per_magnitude = 0x1p-19f;
    return error_per_magnitude * max_component(abs(light.center) + abs(light.half_u) + abs(light.half_v));
}

/// The side that a point sees of the light, unit.
inline Vec3f normal_towards(const AreaLight& light, const Vec3f& point) {
    return light.is_two_sided() && dot(point - light.center, light.normal) < 0.0f ? -light.normal : light.normal;
}

bool is_on_light(const AreaLight& light, const Vec2f& coordinates);

/// The sphere of a sphere light or a spot; nothing for others.
const SphereLight* sphere_of(const Light& light);

/// Coordinates on a triangle for u in [0, 1)^2, uniform by area.
template <class T>
Vec2<T> place_in_triangle(const Vec2<T>& u) {
    const T along = sqrt(u.x);
    return {T(2) * along - T(1), (T(2) * u.y - T(1)) * along};
}

/// Weights of a triangle's second and third corner at coordinates on it.
template <class T>
Vec2<T> barycentric_in_triangle(const Vec2<T>& place) {
    const T across = T(0.25f) + T(0.25f) * place.x;
    return {across - T(0.5f) * place.y, across + T(0.5f) * place.y};
}

/// A place on an area light for u in [0, 1)^2, uniform by area.
Vec3f place_on(const AreaLight& light, const Vec2f& u);

/// The cap that a light covers from a point; nothing for an area light.
std::optional<Cap<float>> cap_from(const Light& light, const Vec3f& point);

/// A place on a light as a point sees it.
struct LightPoint {
    Vec3f wi;
    float distance_m;  ///< infinite for a sun
    Rgb radiance;
    float pdf_omega;  ///< of sample_light
};

/// The place that wi meets on an area light this far off. Nothing where it meets a side that does not shine.
std::optional<LightPoint> light_point(const AreaLight& light, const Vec3f& wi, float distance_m);

/// Uniform over the cap, or over the area for an area light. Nothing where the light does not reach the point.
std::optional<LightPoint> sample_light(const Light& light, const Vec3f& point, const Vec2f& u);

/// The cap that a sphere light covers from a point, over float or batches.
template <class T>
Cap<T> cap_from(const SphereLight& light, const Vec3<T>& point) {
    const Vec3<T> to_center = Vec3<T>(T(light.center.x), T(light.center.y), T(light.center.z)) - point;
    return light.is_facing_disk ? cap_of_facing_disk(to_center, T(light.radius_m))
                                : cap_of_sphere(to_center, T(light.radius_m));
}

/// What a ray from a point meets of the light.
std::optional<LightPoint> intersect_light(const Light& light, const Vec3f& point, const Vec3f& wi);

/// How far a cap-shaped light is along a wi that lies in its cap; infinite for a sun.
float distance_to_light(const Light& light, const Vec3f& point, const Vec3f& wi);

/// The place on a cap-shaped light along a wi that lies in its cap.
LightPoint light_point_in_cap(const Light& light, const Cap<float>& cap, const Vec3f& point, const Vec3f& wi);

}  // namespace pivot
