// An area light as a lit point sees it: its places, and what they take of the directions. Shading frame about the
// point, over float or SIMD batches.
#pragma once

#include "core/geometry/surface_point.h"
#include "core/lights/light.h"

namespace pivot {

/// An area light from a lit point: places are center + x half_u + y half_v. Of one with a narrow spread, the part
/// around what shines on the point.
template <class T>
struct AreaView {
    Vec3<T> center, half_u, half_v;
    Vec3<T> normal;      ///< of the side towards the point, if that shines
    T parallelogram_m2;  ///< |half_u x half_v|
    Mask<T> ellipse, triangle;
    T inverse_tan_spread;
    Vec2<T> part_middle = Vec2<T>(T(0), T(0)), part_size = Vec2<T>(T(1), T(1));  ///< of the light's own places
    Mask<T> may_miss = T(1) < T(0);  ///< whether places of the part may lie beside the light: an ellipse

    /// A place of the view, from the light's own.
    Vec2<T> from_own(const Vec2<T>& own) const {
        return {(own.x - part_middle.x) / part_size.x, (own.y - part_middle.y) / part_size.y};
    }
    /// Whether the light is there, at a place of the view.
    Mask<T> is_on(const Vec2<T>& place) const {
        if (!any(may_miss)) return T(0) < T(1);
        const T x = part_middle.x + place.x * part_size.x, y = part_middle.y + place.y * part_size.y;
        return !may_miss || sqr(x) + sqr(y) <= T(1);
    }

    /// About what a spread leaves of the light, never nothing: for samples to be drawn by.
    T spread_weight(const Vec3<T>& wi) const {
        if (!any(inverse_tan_spread > T(0))) return T(1);
        return max(spread_falloff(inverse_tan_spread, -dot(wi, normal)), T(0.02f));
    }
};

/// A place for u in [0, 1)^2, even by area.
template <class T>
Vec2<T> even_place(const AreaView<T>& light, const Vec2<T>& u) {
    Vec2<T> place(T(2) * u.x - T(1), T(2) * u.y - T(1));
    const auto put = [&](const Mask<T>& is_shape, const Vec2<T>& other) {
        place = {select(is_shape, other.x, place.x), select(is_shape, other.y, place.y)};
    };
    if (any(light.ellipse)) {
        const T radius = sqrt(u.x), angle = T(2) * pi<T> * u.y;
        put(light.ellipse, {radius * cos(angle), radius * sin(angle)});
    }
    if (any(light.triangle)) put(light.triangle, place_in_triangle(u));
    return place;
}

/// Area over the parallelogram's quarter.
template <class T>
T relative_area(const AreaView<T>& light) {
    return select(
        light.triangle, T(relative_area(AreaShape::triangle)),
        select(light.ellipse, T(relative_area(AreaShape::ellipse)), T(relative_area(AreaShape::parallelogram))));
}

/// An area light as numbers.
template <class T>
struct AreaLightOf {
    Vec3<T> center, half_u, half_v, normal;
    Vec3<T> radiance;
    T parallelogram_m2;
    T is_ellipse, is_triangle;  ///< 0 or 1
    T surface_error_m;
    T inverse_tan_spread;
};

inline AreaLightOf<float> numbers_of(const AreaLight& light) {
    return {light.center,
            light.half_u,
            light.half_v,
            light.normal,
            light.radiance,
            parallelogram_m2(light),
            light.shape == AreaShape::ellipse ? 1.0f : 0.0f,
            light.shape == AreaShape::triangle ? 1.0f : 0.0f,
            surface_error_m(light),
            light.inverse_tan_spread};
}

/// Leaves of the view of a light with a spread the parallelogram around the circle that shines on the point.
template <class T>
void narrow(AreaView<T>& view) {
    const T height = -dot(view.center, view.normal), radius = height / max(view.inverse_tan_spread, tiny<T>);
    const Vec3<T> to_foot = -height * view.normal - view.center;
    const Vec3<T> across_u = cross(view.half_v, view.normal), across_v = cross(view.normal, view.half_u);
    const T per_u = inverse(dot(view.half_u, across_u)), per_v = inverse(dot(view.half_v, across_v));
    struct Span {
        T middle, size;
    };
    const auto span = [&](const Vec3<T>& across, const T& per) {
        const T at = dot(to_foot, across) * per, reach = radius * length(across) * abs(per);
        const T low = max(at - reach, T(-1)), high = min(at + reach, T(1));
        return Span{T(0.5f) * (low + high), T(0.5f) * (high - low)};
    };
    const Span x = span(across_u, per_u), y = span(across_v, per_v);
    // Where all of an ellipse is fewer places than the part, it stays an ellipse; where none shines, it stays all.
    const T most =
        select(view.ellipse, T(relative_area(AreaShape::ellipse) / relative_area(AreaShape::parallelogram)), T(1));
    const Mask<T> is_narrower = view.inverse_tan_spread > T(0) && !view.triangle && x.size > T(1e-6f) &&
                                y.size > T(1e-6f) && x.size * y.size < most;
    view.part_middle = {select(is_narrower, x.middle, T(0)), select(is_narrower, y.middle, T(0))};
    view.part_size = {select(is_narrower, x.size, T(1)), select(is_narrower, y.size, T(1))};
    view.may_miss = view.ellipse && is_narrower;
    view.ellipse = view.ellipse && !is_narrower;
    view.center += view.part_middle.x * view.half_u + view.part_middle.y * view.half_v;
    view.half_u = view.half_u * view.part_size.x;
    view.half_v = view.half_v * view.part_size.y;
    view.parallelogram_m2 *= view.part_size.x * view.part_size.y;
}

template <class T>
AreaView<T> view_from(const AreaLightOf<T>& light, const SurfacePointOf<T>& point) {
    AreaView<T> view{.center = point.frame.to_local(light.center - point.position),
                     .half_u = point.frame.to_local(light.half_u),
                     .half_v = point.frame.to_local(light.half_v),
                     .normal = point.frame.to_local(light.normal),
                     .parallelogram_m2 = light.parallelogram_m2,
                     .ellipse = light.is_ellipse > T(0),
                     .triangle = light.is_triangle > T(0),
                     .inverse_tan_spread = light.inverse_tan_spread};
    if (any(light.inverse_tan_spread > T(0))) narrow(view);
    // A triangle has two sides.
    view.normal = select(view.triangle && dot(view.center, view.normal) > T(0), -view.normal, view.normal);
    return view;
}

/// A place on the light as the lit point sees it.
template <class T>
struct SeenPlace {
    Vec3<T> wi;
    T distance_m;
    T omega_per_xy;  ///< solid angle by (x, y)
};
template <class T>
SeenPlace<T> see(const AreaView<T>& light, const Vec2<T>& place) {
    const Vec3<T> d = light.center + place.x * light.half_u + place.y * light.half_v;
    const T distance2 = dot(d, d), per_distance = inverse_sqrt(max(distance2, tiny<T>));
    const Vec3<T> wi = d * per_distance;
    return {wi, distance2 * per_distance,
            max(-dot(wi, light.normal), T(0)) * sqr(per_distance) * light.parallelogram_m2};
}

}  // namespace pivot
