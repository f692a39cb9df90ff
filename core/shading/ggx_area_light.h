// GGX under a rectangle, disk, ellipse or triangle: a rule on the light itself, spread as the lobe sees it. Shading
// frame, z the normal; places relative to the shaded point.
//   [Heitz16] "Real-Time Polygonal-Light Shading with Linearly Transformed Cosines"
//
// What of a light is above the surface is convex: it is the triangles between its brightest place and the pieces of its
// outline, closed along the horizon. On a straight line p(t) the stretched half vector M^-1 (p + |p| wo), of which GGX
// is a cosine, is nearly a line too, whose direction turns evenly in the arc tangent of the distance from the line's
// nearest point. So points are Gauss and Legendre's in that angle, along the outline and from the brightest place to
// it: as many per radian of the lobe, however sharp it is.
//
// What else was tried: the contour integral of ggx_contour.h with masking at sectors' points among the half vectors,
// which is exact in D with the fewest points; but a light beside a sharp lobe is a thin crescent there, its sectors
// leave it and cancel, and one case in a hundred was off by more than 40 %.
#pragma once

#include "core/shading/area_outline.h"
#include "core/shading/ggx_cap_light.h"

namespace pivot {
namespace detail {

/// An even turn for `stretch` of the point: first evenly as seen from here, which leaves a curve without the distance's
/// bend, then along that curve's chord.
template <class T>
struct StretchedTurn {
    EvenTurn<T> seen, stretched;

    typename EvenTurn<T>::Place at(T x) const {
        const auto [s, ds] = stretched.at(x);
        const auto [t, dt] = seen.at(s);
        return {t, dt * ds};
    }
};

/// stretch0, stretch1: of a and a + b.
template <class T>
StretchedTurn<T> stretched_turn(const Vec3<T>& a, const Vec3<T>& b, const Vec3<T>& stretch0, const Vec3<T>& stretch1) {
    const EvenTurn<T> seen = even_turn(a, b);
    const Vec3<T> w0 = (T(1) - sqr(seen.q0)) * stretch0, w1 = (T(1) - sqr(seen.q1)) * stretch1;
    return {seen, even_turn(w0, w1 - w0)};
}

/// Coordinates along half_u and half_v, which need not be perpendicular, of places in the light's plane.
template <class T>
struct PlaneCoordinates {
    Vec3<T> x, y;

    explicit PlaneCoordinates(const AreaOutline<T>& light) {
        const Vec3<T> normal = cross(light.half_u, light.half_v);
        const T scale = T(1) / max(length_squared(normal), tiny<T>);
        x = cross(light.half_v, normal) * scale;
        y = cross(normal, light.half_u) * scale;
    }
    Vec2<T> of(const Vec3<T>& from_center) const { return {dot(from_center, x), dot(from_center, y)}; }
};

/// The light's place nearest to where it meets a direction, above the surface.
template <class T>
Vec3<T> brightest_place(const Vec3<T>& mirror, const AreaOutline<T>& light, const Vec3<T>& highest) {
    const Vec3<T> normal = cross(light.half_u, light.half_v);
    const T facing = dot(mirror, normal), height = dot(light.center, normal);
    // A mirror ray that misses the plane meets it far out, on the side it goes to.
    const T sign = select(height < T(0), T(-1), T(1));
    const T distance = abs(height) / max(facing * sign, T(1e-3) * length(normal));
    const Vec2<T> place = PlaneCoordinates<T>(light).of(distance * mirror - light.center);
    T x = place.x, y = place.y;
    if (light.is_ellipse()) {
        const T shrink = T(0.99) / sqrt(max(sqr(x) + sqr(y), T(0.99 * 0.99)));
        x *= shrink;
        y *= shrink;
    } else {
        const T least = light.is_triangle() ? T(-0.95) : T(-0.99);
        x = min(max(x, least), T(0.99));
        const T most = light.is_triangle() ? T(0.495) * (T(1) + x) : T(0.99);
        y = min(max(y, -most), most);
    }
    const Vec3<T> nearest = light.center + x * light.half_u + y * light.half_v;
    const auto hidden = nearest.z < T(0.05) * highest.z;
    const T back = select(hidden, T(0.95) * highest.z / select(hidden, highest.z - nearest.z, T(1)), T(1));
    return highest + back * (nearest - highest);
}

/// Calls visit(p, 1 / |p|, solid_angle) for places spread evenly over the turn of `stretch`(p), which is a direction:
/// of what of the light lies between its brightest place and an arc of its outline.
template <bool curved, int Steps, int Radial, class T, class Stretch, class Visit>
void for_each_place(const AreaOutline<T>& light, const OutlineArc<T>& arc, const Vec3<T>& brightest,
                    const Stretch& stretch, const Visit& visit) {
    const Vec3<T> normal = cross(light.half_u, light.half_v);
    const T inverse_normal = inverse_sqrt(max(length_squared(normal), tiny<T>));
    const T height = abs(dot(light.center, normal)) * sqr(inverse_normal);
    const Vec3<T> w_brightest = stretch(brightest), p0 = at<curved>(arc, T(0)).p, p1 = at<curved>(arc, T(1)).p;
    const StretchedTurn<T> along = stretched_turn(p0, p1 - p0, stretch(p0), stretch(p1));
    for (const GaussNode& step : gauss_rule<Steps>) {
        const auto [t, dt] = along.at(T(step.x));
        const OutlinePoint<T> rim = at<curved>(arc, t);
        const Vec3<T> radius = rim.p - brightest;
        const T area = abs(dot(cross(radius, rim.dp_dt), normal)) * height * dt * T(step.weight);
        const StretchedTurn<T> outwards = stretched_turn(brightest, radius, w_brightest, stretch(rim.p));
        for (const GaussNode& node : gauss_rule<Radial>) {
            const auto [s, ds] = outwards.at(T(node.x));
            const Vec3<T> p = brightest + s * radius;
            const T inverse_distance = inverse_sqrt(max(length_squared(p), T(1e-30f)));
            visit(p, inverse_distance, area * s * ds * T(node.weight) * sqr(inverse_distance) * inverse_distance);
        }
    }
}

/// What the arcs of several lanes need of their lanes.
struct ArcLanes {
    Vec3b center, half_u, half_v, brightest, wo_local;
    Batch alpha, ior;
    IsotropicG2<Batch> g2;
};

}  // namespace detail

/// As many points as Pieces x Steps x Radial x 4, and a quarter more where the light is cut; 0 where not wanted.
template <int Pieces, int Steps, int Radial>
LobeSums<Batch> sum_area_light(const GgxLobe<Batch>& lobe, const AreaOutline<Batch>& light, const BatchMask& wanted) {
    const auto above = outline_above<Pieces>(light);
    const Vec3b& wo = lobe.wo_local;
    const Vec3b brightest = detail::brightest_place(Vec3b(-wo.x, -wo.y, wo.z), light, above.highest);
    const detail::ArcLanes all{light.center, light.half_u, light.half_v, brightest,
                               wo,           lobe.alpha,   lobe.ior,     IsotropicG2<Batch>(wo, lobe.alpha)};
    LaneSums sums;
    const auto sum = [&]<bool curved>(std::bool_constant<curved>, const ArcBatch& batch) {
        const detail::ArcLanes l = permute(all, batch.lane);
        const GgxLobe<Batch> own{l.wo_local, l.alpha, l.ior, lobe.has_dielectric};
        const Batch inverse_alpha = inverse(l.alpha), inverse_alpha2 = sqr(inverse_alpha);
        const Vec3b m_inverse(inverse_alpha, inverse_alpha, Batch(1.0f));
        const Batch scale = Batch(0.25f / pi<float>) * inverse_alpha2 * inverse(l.wo_local.z);
        LobeSums<Batch> part;
        detail::for_each_place<curved, Steps, Radial>(
            {l.center, l.half_u, l.half_v, light.shape}, batch.arc, l.brightest,
            [&](const Vec3b& p) { return m_inverse * (p + length(p) * l.wo_local); },
            [&](const Vec3b& p, const Batch& inverse_distance, const Batch& solid_angle) {
                const Vec3b half = l.wo_local + p * inverse_distance;
                const Batch across2 = sqr(half.x) + sqr(half.y), half2 = max(across2 + sqr(half.z), Batch(1e-30f));
                const Batch stretched2 = max(across2 * inverse_alpha2 + sqr(half.z), Batch(1e-30f));
                const Batch ndf = sqr(half2 * inverse(stretched2));
                add(part, own, dot(l.wo_local, half) * inverse_sqrt(half2),
                    scale * ndf * solid_angle * l.g2(p.z * inverse_distance));
            });
        sums.add(part, batch.lane, batch.count);
    };
    if (light.is_ellipse()) {
        for_each_batch<true>(above.outline, wanted, [&](const ArcBatch& b) { sum(std::true_type(), b); });
    } else {
        for_each_batch<false>(above.outline, wanted, [&](const ArcBatch& b) { sum(std::false_type(), b); });
    }
    for_each_batch<false>(above.horizon, wanted, [&](const ArcBatch& b) { sum(std::false_type(), b); });
    return sums.load();
}

/// By directions of the lobe that meet the light: for a sharp lobe at a point that all but touches the light, whose
/// outline is nowhere near the highlight. The error is what two halves of the directions differ by.
template <class T>
LobeIntegral<T> integrate_by_lobe(const GgxLobe<T>& lobe, const AreaOutline<T>& light) {
    constexpr int count = 512;
    const Vec3<T> normal = cross(light.half_u, light.half_v);
    const detail::PlaneCoordinates<T> coordinates(light);
    const T height = dot(light.center, normal);
    const IsotropicG2<T> g2(lobe.wo_local, lobe.alpha);
    const T share = (g2.view_weight + T(1)) * T(0.5f / float(count));  // 1 / G1, a direction's share
    std::array<T, 2> halves{T(0), T(0)};
    LobeSums<T> sums;
    for (int i = 0; i < count; ++i) {
        const float golden = 0.61803399f * float(i);
        const Vec2<T> u(T((float(i) + 0.5f) / float(count)), T(golden - floor(golden)));
        const Vec3<T> half = ggx_sample_normal(lobe.wo_local, lobe.alpha, lobe.alpha, u);
        const T cos_oh = dot(lobe.wo_local, half);
        const Vec3<T> omega_i = T(2) * cos_oh * half - lobe.wo_local;
        const T facing = dot(omega_i, normal), distance = height / select(abs(facing) > tiny<T>, facing, tiny<T>);
        const Vec2<T> place = coordinates.of(distance * omega_i - light.center);
        const T reach = light.is_ellipse()    ? dot(place, place)
                        : light.is_triangle() ? max(place.x, T(2) * abs(place.y) - place.x)
                                              : max(abs(place.x), abs(place.y));
        const T value = select(distance > T(0) && reach < T(1), share * g2(omega_i.z), T(0));
        halves[static_cast<size_t>(i % 2)] += value;
        add(sums, lobe, cos_oh, value);
    }
    const T difference = abs(halves[0] - halves[1]) / max(sums.plain, T(least_value));
    return {sums, difference + T(2e-3), detail::number_of<T>(Method::lobe_directions)};
}

/// By finer and finer rules, until two of them agree to the budget; their difference is the predicted error.
inline LobeIntegral<Batch> integrate(const GgxLobe<Batch>& lobe, const AreaOutline<Batch>& light, Batch budget) {
    const BatchMask above = is_above(light);
    const Batch zero(0.0f), one(1.0f);
    LobeIntegral<Batch> result{sum_area_light<1, 2, 2>(lobe, light, above), select(above, one, zero),
                               select(above, detail::number_of<Batch>(Method::area_points), zero)};
    BatchMask pending = above;
    const auto refine = [&](const LobeSums<Batch>& finer, float room) {
        // `room` times the coarser rule's error, so that the finer one's is below it in 19 cases of 20: few points may
        // agree by chance. A floor for roundings.
        const Batch difference =
            Batch(room) * abs(finer.plain - result.sums.plain) * inverse(max(finer.plain, Batch(least_value))) +
            Batch(3e-4f);
        result.sums = select<Batch>(pending, finer, result.sums);
        result.predicted_error = select(pending, difference, result.predicted_error);
        pending = pending && difference > budget;
    };
    if (any(pending)) refine(sum_area_light<1, 3, 3>(lobe, light, pending), 12.0f);
    if (any(pending)) refine(sum_area_light<2, 4, 4>(lobe, light, pending), 1.2f);
    if (any(pending)) refine(sum_area_light<4, 6, 6>(lobe, light, pending), 1.2f);
    if (any(pending)) refine(sum_area_light<12, 8, 8>(lobe, light, pending), 1.2f);
    if (any(pending)) {
        const LobeIntegral<Batch> by_lobe = integrate_by_lobe(lobe, light);
        const BatchMask better = pending && by_lobe.predicted_error < result.predicted_error;
        result.sums = select<Batch>(better, by_lobe.sums, result.sums);
        result.predicted_error = select(better, by_lobe.predicted_error, result.predicted_error);
        result.method = select(better, by_lobe.method, result.method);
    }
    return result;
}

}  // namespace pivot
