// An area lamp in cells, as a place in fog sees them: their directions and solid angles. Over float or batches; lanes
// may be places or cells.
#pragma once

#include "core/lights/light.h"

namespace pivot {

/// Cells are even in (u, v) over [0, 1]^2, which is even in area: the sides of a parallelogram, or the squared radius
/// and the turns of an ellipse.
struct AreaCells {
    std::size_t columns, rows;  ///< by u, by v
};
inline constexpr std::size_t area_cell_count = 16;
constexpr AreaCells cells_of(AreaShape shape) {
    return shape == AreaShape::ellipse ? AreaCells{2, 8} : AreaCells{4, 4};
}

/// The place that (u, v) has along half_u and half_v; radius_factor: of an ellipse, what its radius is multiplied by.
template <class T>
Vec2<T> area_place(AreaShape shape, const Vec2<T>& uv, float radius_factor = 1.0f) {
    if (shape != AreaShape::ellipse) return {T(2) * uv.x - T(1), T(2) * uv.y - T(1)};
    const T radius = T(radius_factor) * sqrt(uv.x), angle = T(2) * pi<T> * uv.y;
    return {radius * cos(angle), radius * sin(angle)};
}
/// And back.
inline Vec2f area_uv(AreaShape shape, const Vec2f& place) {
    if (shape != AreaShape::ellipse) return {0.5f * (place.x + 1.0f), 0.5f * (place.y + 1.0f)};
    const float turns = std::atan2(place.y, place.x) / (2.0f * pi<float>);
    return {length_squared(Vec3f(place.x, place.y, 0.0f)), turns < 0.0f ? turns + 1.0f : turns};
}

template <class T>
struct SeenCell {
    Vec3<T> wi;     ///< unit, towards its middle
    T solid_angle;  ///< exact of a parallelogram's; 0 where the light's back is seen
};

/// The cell between two places (u, v).
template <class T>
SeenCell<T> see_cell(const AreaLight& light, const Vec3<T>& position, const Vec2<T>& low, const Vec2<T>& high) {
    // Chords of an ellipse's eight sectors, so far out that the area between them is the sectors'.
    constexpr float chord_radius = 1.0538f;
    const auto of = [](const Vec3f& v) { return Vec3<T>(T(v.x), T(v.y), T(v.z)); };
    const Vec3<T> to_center = of(light.center) - position;
    const auto towards = [&](const T& u, const T& v) {
        const Vec2<T> place = area_place(light.shape, Vec2<T>(u, v), chord_radius);
        const Vec3<T> d = to_center + place.x * of(light.half_u) + place.y * of(light.half_v);
        return d * inverse_sqrt(max(length_squared(d), tiny<T>));
    };
    const Vec3<T> a = towards(low.x, low.y), b = towards(high.x, low.y), c = towards(high.x, high.y),
                  d = towards(low.x, high.y);
    // [Van Oosterom and Strackee 1983]
    const auto triangle = [](const Vec3<T>& p, const Vec3<T>& q, const Vec3<T>& r) {
        return T(2) * atan2(abs(dot(p, cross(q, r))), T(1) + dot(p, q) + dot(q, r) + dot(r, p));
    };
    const Vec3<T> sum = a + b + c + d;
    const T solid_angle = triangle(a, b, c) + triangle(a, c, d);
    return {sum * inverse_sqrt(max(length_squared(sum), tiny<T>)),
            select(dot(to_center, of(light.normal)) < T(0), solid_angle, T(0))};
}

}  // namespace pivot
