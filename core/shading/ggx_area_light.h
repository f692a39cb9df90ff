// GGX under a rectangle, disk or ellipse: a rule on the light itself, spread as the lobe sees it. Shading frame, z the
// normal; places relative to the shaded point. One body for a float and for a batch.
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

#include "core/shading/ggx_cap_light.h"

namespace pivot {

/// Relative to the shaded point, in the shading frame. `ellipse` is one for all lanes.
template <class T>
struct AreaOutline {
    Vec3<T> center, half_u, half_v;
    bool ellipse;
};

namespace detail {

/// A point that runs from a to a + b so that its direction turns evenly: where it is, t, when s of the turn is done.
template <class T>
struct EvenTurn {
    T q0, q1;  // tangents of half the angle from the nearest point of the line

    struct Place {
        T t, dt_ds;
    };

    /// Without differences of near values, so that a small turn keeps its bits.
    Place at(T s) const {
        const T q = q0 + s * (q1 - q0), inverse = T(1) / ((T(1) + q1 * q0) * (T(1) - sqr(q)));
        const T end = T(1) - sqr(q1);
        return {s * (T(1) + q * q0) * end * inverse,
                (T(1) + sqr(q)) * (T(1) - sqr(q0)) * end * inverse / (T(1) - sqr(q))};
    }
};

template <class T>
EvenTurn<T> even_turn(const Vec3<T>& a, const Vec3<T>& b) {
    const T distance = max(length(cross(a, b)), T(1e-5) * length(a) * length(b));  // times |b|
    const T scale = T(1) / max(distance, tiny<T>);
    const auto half_tangent = [](T x) { return x / (T(1) + sqrt(T(1) + sqr(x))); };
    return {half_tangent(dot(a, b) * scale), half_tangent((dot(a, b) + length_squared(b)) * scale)};
}

/// The same for `stretch` of the point: first evenly as seen from here, which leaves a curve without the distance's
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

/// A piece of an outline: p(t) = from + t edge, or from + cos(angle) u + sin(angle) v.
template <class T>
struct Arc {
    Vec3<T> from, edge;    // ends of the chord
    Vec3<T> center, u, v;  // of an ellipse
    T first_angle, angle_step;
    bool curved;
};

template <class T>
struct ArcPoint {
    Vec3<T> p, dp_dt;
};

template <class T>
ArcPoint<T> at(const Arc<T>& arc, T t) {
    if (!arc.curved) return {arc.from + t * arc.edge, arc.edge};
    const T angle = arc.first_angle + t * arc.angle_step, c = cos(angle), s = sin(angle);
    return {arc.center + c * arc.u + s * arc.v, arc.angle_step * (c * arc.v - s * arc.u)};
}

/// Fills `pieces` arcs with a straight edge.
template <class T>
void put_edge(Arc<T>* arcs, const Vec3<T>& from, const Vec3<T>& to, int pieces) {
    // What the distance to a line's points does is even in the angle as seen from here.
    const EvenTurn<T> turn = even_turn(from, to - from);
    Vec3<T> last = from;
    for (int i = 1; i <= pieces; ++i) {
        const Vec3<T> next = i == pieces ? to : from + turn.at(T(float(i) / float(pieces))).t * (to - from);
        arcs[i - 1] = {last, next - last, last, last, last, T(0), T(0), false};
        last = next;
    }
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
    if (light.ellipse) {
        const T shrink = T(0.99) / sqrt(max(sqr(x) + sqr(y), T(0.99 * 0.99)));
        x *= shrink;
        y *= shrink;
    } else {
        x = min(max(x, T(-0.99)), T(0.99));
        y = min(max(y, T(-0.99)), T(0.99));
    }
    const Vec3<T> nearest = light.center + x * light.half_u + y * light.half_v;
    const auto hidden = nearest.z < T(0.05) * highest.z;
    const T back = select(hidden, T(0.95) * highest.z / select(hidden, highest.z - nearest.z, T(1)), T(1));
    return highest + back * (nearest - highest);
}

}  // namespace detail

/// What of an area light is above the surface: its outline in pieces, closed along the horizon. A piece that does not
/// exist in a lane has no length there.
template <size_t Pieces, class T>
struct AreaArcs {
    std::array<detail::Arc<T>, 5 * Pieces> arcs;
    Vec3<T> highest;
};

/// Whether any of it is above the surface.
template <class T>
Mask<T> is_above(const AreaOutline<T>& light) {
    const T reach =
        light.ellipse ? sqrt(sqr(light.half_u.z) + sqr(light.half_v.z)) : abs(light.half_u.z) + abs(light.half_v.z);
    return light.center.z + reach > T(0);
}

/// Pieces: of an edge, or of a quarter of an ellipse.
template <size_t Pieces, class T>
AreaArcs<Pieces, T> outline_above(const AreaOutline<T>& light) {
    constexpr int pieces = static_cast<int>(Pieces);
    AreaArcs<Pieces, T> result;
    auto* arcs = result.arcs.data();
    Vec3<T>& highest = result.highest;
    if (light.ellipse) {
        // z along the rim is center.z + reach cos(angle - peak)
        const T reach = sqrt(sqr(light.half_u.z) + sqr(light.half_v.z));
        const T peak = atan2(light.half_v.z, select(reach > T(0), light.half_u.z, T(1)));
        const T ratio = min(max(-light.center.z / max(reach, tiny<T>), T(-1)), T(1));
        const T half = select(light.center.z >= reach, T(pi<float>), acos(ratio));
        const T step = half * T(2.0f / float(4 * pieces));
        const Vec3<T>& c = light.center;
        for (int i = 0; i < 4 * pieces; ++i)
            arcs[i] = {c, c, c, light.half_u, light.half_v, peak - half + T(float(i)) * step, step, true};
        detail::put_edge(arcs + 4 * pieces, detail::at(arcs[4 * pieces - 1], T(1)).p, detail::at(arcs[0], T(0)).p,
                         pieces);
        highest = detail::at(arcs[2 * pieces], T(0)).p;
        return result;
    }
    const std::array<Vec3<T>, 4> corners{
        light.center - light.half_u - light.half_v, light.center + light.half_u - light.half_v,
        light.center + light.half_u + light.half_v, light.center - light.half_u + light.half_v};
    highest = corners[0];
    Vec3<T> left = corners[0], entered = corners[0];
    for (size_t i = 0; i < 4; ++i) {
        const Vec3<T>&a = corners[i], &b = corners[(i + 1) % 4];
        highest = select(b.z > highest.z, b, highest);
        const auto a_above = a.z > T(0), b_above = b.z > T(0);
        const auto leaves = a_above && !b_above, enters = !a_above && b_above;
        const T t = select(leaves || enters, a.z / select(leaves || enters, a.z - b.z, T(1)), T(0));
        const Vec3<T> crossing = a + t * (b - a), from = select(a_above, a, crossing);
        left = select(leaves, crossing, left);
        entered = select(enters, crossing, entered);
        detail::put_edge(arcs + static_cast<int>(i) * pieces, from, select(b_above, b, select(a_above, crossing, from)),
                         pieces);
    }
    detail::put_edge(arcs + 4 * pieces, left, entered, pieces);
    return result;
}

namespace detail {

/// Calls visit(p, solid_angle) for places spread evenly over the turn of `stretch`(p), which is a direction.
template <int Steps, int Radial, size_t Pieces, class T, class Stretch, class Visit>
void for_each_place(const AreaOutline<T>& light, const AreaArcs<Pieces, T>& above, const Vec3<T>& brightest,
                    const Stretch& stretch, const Visit& visit) {
    const Vec3<T> normal = normalize(cross(light.half_u, light.half_v));
    const T height = abs(dot(light.center, normal));
    const Vec3<T> w_brightest = stretch(brightest);
    for (const Arc<T>& arc : above.arcs) {
        const Vec3<T> p0 = at(arc, T(0)).p, p1 = at(arc, T(1)).p;
        const StretchedTurn<T> along = stretched_turn(p0, p1 - p0, stretch(p0), stretch(p1));
        for (const GaussNode& step : gauss_rule<Steps>) {
            const auto [t, dt] = along.at(T(step.x));
            const ArcPoint<T> rim = at(arc, t);
            const Vec3<T> radius = rim.p - brightest;
            const T area = abs(dot(cross(radius, rim.dp_dt), normal)) * dt * T(step.weight);
            const StretchedTurn<T> outwards = stretched_turn(brightest, radius, w_brightest, stretch(rim.p));
            for (const GaussNode& node : gauss_rule<Radial>) {
                const auto [s, ds] = outwards.at(T(node.x));
                const Vec3<T> p = brightest + s * radius;
                const T distance2 = max(length_squared(p), tiny<T>);
                visit(p, area * s * ds * T(node.weight) * height / (distance2 * sqrt(distance2)));
            }
        }
    }
}

}  // namespace detail

/// The Lambert lobe of albedo 1 over the light of radiance 1.
template <int Steps, int Radial, size_t Pieces, class T>
T diffuse_share(const AreaOutline<T>& light, const AreaArcs<Pieces, T>& above) {
    const Vec3<T> normal = normalize(cross(light.half_u, light.half_v));
    const T side = select(dot(normal, light.center) < T(0), T(-1), T(1));
    const Vec3<T> nearest = detail::brightest_place(side * normal, light, above.highest);
    T sum(0);
    detail::for_each_place<Steps, Radial>(
        light, above, nearest, [](const Vec3<T>& p) { return p; },
        [&](const Vec3<T>& p, const T& solid_angle) {
            sum += solid_angle * max(p.z, T(0)) / sqrt(max(length_squared(p), tiny<T>));
        });
    return sum * T(1.0f / pi<float>);
}

/// As many points as Pieces x Steps x Radial x 5.
template <int Pieces, int Steps, int Radial, class T>
LobeSums<T> sum_area_light(const GgxLobe<T>& lobe, const AreaOutline<T>& light) {
    const auto above = outline_above<Pieces>(light);
    const Vec3<T>& wo = lobe.wo_local;
    const Vec3<T> mirror(-wo.x, -wo.y, wo.z), m_inverse(T(1) / lobe.alpha, T(1) / lobe.alpha, T(1));
    const IsotropicG2<T> g2(wo, lobe.alpha);
    const T scale = T(0.25f / pi<float>) / (sqr(lobe.alpha) * wo.z);
    LobeSums<T> sums;
    detail::for_each_place<Steps, Radial>(
        light, above, detail::brightest_place(mirror, light, above.highest),
        [&](const Vec3<T>& p) { return m_inverse * (p + length(p) * wo); },
        [&](const Vec3<T>& p, const T& solid_angle) {
            const Vec3<T> omega_i = p / sqrt(max(length_squared(p), tiny<T>)), half = wo + omega_i;
            const Vec3<T> w = m_inverse * half;
            const T half2 = max(length_squared(half), tiny<T>), ndf = sqr(half2 / max(length_squared(w), tiny<T>));
            add(sums, lobe, dot(wo, half) / sqrt(half2), scale * ndf * solid_angle * g2(omega_i.z));
        });
    return sums;
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
        const T reach = light.ellipse ? dot(place, place) : max(abs(place.x), abs(place.y));
        const T value = select(distance > T(0) && reach < T(1), share * g2(omega_i.z), T(0));
        halves[static_cast<size_t>(i % 2)] += value;
        add(sums, lobe, cos_oh, value);
    }
    const T difference = abs(halves[0] - halves[1]) / max(sums.plain, T(least_value));
    return {sums, difference + T(2e-3), detail::number_of<T>(Method::lobe_directions)};
}

/// By finer and finer rules, until two of them agree to the budget; their difference is the predicted error.
template <class T>
LobeIntegral<T> integrate(const GgxLobe<T>& lobe, const AreaOutline<T>& light, T budget) {
    LobeIntegral<T> result{sum_area_light<1, 3, 3>(lobe, light), T(1), detail::number_of<T>(Method::area_points)};
    auto pending = is_above(light);
    result.sums = select<T>(pending, result.sums, {});
    result.predicted_error = select(pending, T(1), T(0));
    const auto refine = [&](const LobeSums<T>& finer) {
        // the coarser rule's error, which the finer one's is below in 19 cases of 20; a floor for roundings
        const T difference =
            T(1.2f) * abs(finer.plain - result.sums.plain) / max(finer.plain, T(least_value)) + T(3e-4f);
        result.sums = select<T>(pending, finer, result.sums);
        result.predicted_error = select(pending, difference, result.predicted_error);
        pending = pending && difference > budget;
    };
    refine(sum_area_light<2, 4, 4>(lobe, light));
    if (any(pending)) refine(sum_area_light<4, 6, 6>(lobe, light));
    if (any(pending)) refine(sum_area_light<12, 8, 8>(lobe, light));
    if (any(pending)) {
        const LobeIntegral<T> by_lobe = integrate_by_lobe(lobe, light);
        const auto better = pending && by_lobe.predicted_error < result.predicted_error;
        result.sums = select<T>(better, by_lobe.sums, result.sums);
        result.predicted_error = select(better, by_lobe.predicted_error, result.predicted_error);
        result.method = select(better, by_lobe.method, result.method);
    }
    result.method = select(is_above(light), result.method, T(0));
    return result;
}

}  // namespace pivot
