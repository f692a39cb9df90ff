// What of a rectangle, disk, ellipse or triangle is above the surface: its outline in pieces, closed along the horizon.
// Shading frame, z the normal; places relative to the shaded point. Batches only in what the lanes' pieces are
// collected by.
//   [Lambert1760] Photometria: the irradiance of a contour
#pragma once

#include <numeric>

// clang-format off: templates that follow must see batches
#include "core/lights/light.h"
#include "core/math/quadrature.h"
#include "core/simd/batch.h"
// clang-format on

namespace pivot {

/// Relative to the shaded point, in the shading frame. `shape` is one for all lanes.
template <class T>
struct AreaOutline {
    Vec3<T> center, half_u, half_v;
    AreaShape shape;

    bool is_ellipse() const { return shape == AreaShape::ellipse; }
    bool is_triangle() const { return shape == AreaShape::triangle; }
    /// Of one that is no ellipse, in order; a triangle's first is there twice.
    std::array<Vec3<T>, 4> corners() const {
        const Vec3<T> low = center - half_u, high = center + half_u;
        if (is_triangle()) return {low, high - half_v, high + half_v, low};
        return {low - half_v, high - half_v, high + half_v, low + half_v};
    }
};

/// A point that runs from a to a + b so that its direction turns evenly: where it is, t, when s of the turn is done.
template <class T>
struct EvenTurn {
    T q0, q1;             // tangents of half the angle from the nearest point of the line
    T t_scale, dt_scale;  // what does not depend on s

    struct Place {
        T t, dt_ds;
    };

    /// Without differences of near values, so that a small turn keeps its bits.
    Place at(T s) const {
        const T q = q0 + s * (q1 - q0), secant = inverse((T(1) - q) * (T(1) + q));
        return {s * (T(1) + q * q0) * t_scale * secant, (T(1) + sqr(q)) * dt_scale * sqr(secant)};
    }
};

template <class T>
EvenTurn<T> even_turn(const Vec3<T>& a, const Vec3<T>& b) {
    const T a2 = length_squared(a), b2 = length_squared(b), ab = dot(a, b);
    // over the distance from the line, times |b|
    const T scale = inverse_sqrt(max(max(length_squared(cross(a, b)), T(1e-10) * a2 * b2), T(1e-36f)));
    const auto half_tangent = [](T x) { return x * inverse(T(1) + sqrt(T(1) + sqr(x))); };
    const T q0 = half_tangent(ab * scale), q1 = half_tangent((ab + b2) * scale);
    const T t_scale = (T(1) - sqr(q1)) * inverse(T(1) + q1 * q0);
    return {q0, q1, t_scale, t_scale * (T(1) - sqr(q0))};
}

/// A piece of an outline: p(t) = from + t edge, or center + cos(turn) u + sin(turn) v, |turn| at most half of the arc.
template <class T>
struct OutlineArc {
    Vec3<T> from, edge;    // a straight one's
    Vec3<T> center, u, v;  // an ellipse's, u towards the arc's middle
    T tangent;             // of a quarter of its angle
};

template <class T>
struct OutlinePoint {
    Vec3<T> p, dp_dt;
};

template <bool curved, class T>
OutlinePoint<T> at(const OutlineArc<T>& arc, T t) {
    if constexpr (!curved) return {arc.from + t * arc.edge, arc.edge};
    const T q = (T(2) * t - T(1)) * arc.tangent, secant2 = inverse(T(1) + sqr(q));
    const T c = (T(1) - sqr(q)) * secant2, s = T(2) * q * secant2;
    return {arc.center + c * arc.u + s * arc.v, T(4) * arc.tangent * secant2 * (c * arc.v - s * arc.u)};
}

/// Fills `pieces` arcs with a straight edge.
template <class T>
void put_edge(OutlineArc<T>* arcs, const Vec3<T>& from, const Vec3<T>& to, int pieces) {
    // What the distance to a line's points does is even in the angle as seen from here.
    const EvenTurn<T> turn = even_turn(from, to - from);
    Vec3<T> last = from;
    for (int i = 1; i <= pieces; ++i) {
        const Vec3<T> next = i == pieces ? to : from + turn.at(T(float(i) / float(pieces))).t * (to - from);
        arcs[i - 1] = {last, next - last, last, last, last, T(0)};
        last = next;
    }
}

/// What of an area light is above the surface: its outline in pieces, closed along the horizon. A piece that does not
/// exist in a lane has no length there.
template <size_t Pieces, class T>
struct AreaArcs {
    std::array<OutlineArc<T>, 4 * Pieces> outline;  // curved for an ellipse
    std::array<OutlineArc<T>, Pieces> horizon;      // where the light is cut
    Vec3<T> highest;
};

/// Whether any of it is above the surface.
template <class T>
Mask<T> is_above(const AreaOutline<T>& light) {
    T reach = abs(light.half_u.z) + abs(light.half_v.z);
    if (light.is_ellipse()) reach = sqrt(sqr(light.half_u.z) + sqr(light.half_v.z));
    if (light.is_triangle()) reach = max(-light.half_u.z, light.half_u.z + abs(light.half_v.z));
    return light.center.z + reach > T(0);
}

/// Pieces: of an edge, or of a quarter of an ellipse.
template <size_t Pieces, class T>
AreaArcs<Pieces, T> outline_above(const AreaOutline<T>& light) {
    constexpr int pieces = static_cast<int>(Pieces);
    AreaArcs<Pieces, T> result;
    auto* arcs = result.outline.data();
    Vec3<T>& highest = result.highest;
    if (light.is_ellipse()) {
        // z along the rim is center.z + reach cos(angle - peak)
        const T reach = sqrt(sqr(light.half_u.z) + sqr(light.half_v.z));
        const T peak = atan2(light.half_v.z, select(reach > T(0), light.half_u.z, T(1)));
        const T ratio = min(max(-light.center.z / max(reach, tiny<T>), T(-1)), T(1));
        const T half = select(light.center.z >= reach, T(pi<float>), acos(ratio));
        const T step = half * T(2.0f / float(4 * pieces)), first = peak - half + T(0.5) * step;
        const T turn_c = cos(step), turn_s = sin(step);
        const T tangent = sin(T(0.5) * step) * inverse(T(1) + cos(T(0.5) * step));
        T c = cos(first), s = sin(first);
        for (int i = 0; i < 4 * pieces; ++i) {
            arcs[i] = {light.center,
                       Vec3<T>(T(0)),
                       light.center,
                       c * light.half_u + s * light.half_v,
                       c * light.half_v - s * light.half_u,
                       tangent};
            const T next_c = c * turn_c - s * turn_s;
            s = s * turn_c + c * turn_s;
            c = next_c;
        }
        const Vec3<T> left = at<true>(arcs[4 * pieces - 1], T(1)).p, entered = at<true>(arcs[0], T(0)).p;
        // An ellipse that is not cut closes by itself, but for rounding.
        put_edge(result.horizon.data(), left, select(light.center.z < reach, entered, left), pieces);
        highest = at<true>(arcs[2 * pieces], T(0)).p;
        return result;
    }
    const std::array<Vec3<T>, 4> corners = light.corners();
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
        put_edge(arcs + static_cast<int>(i) * pieces, from, select(b_above, b, select(a_above, crossing, from)),
                 pieces);
    }
    put_edge(result.horizon.data(), left, entered, pieces);
    return result;
}

/// The Lambert lobe of albedo 1 over the light of radiance 1: the irradiance of its contour [Lambert1760], over pi.
template <class T>
T diffuse_share(const AreaOutline<T>& light) {
    const auto above = outline_above<2>(light);
    // (p x dp).z / |p|^2 is the turn's angle times a constant on a straight line
    const auto irradiance = [](const auto& arcs, auto along) {
        T sum(0);
        for (const OutlineArc<T>& arc : arcs) {
            const Vec3<T> from = along(arc, T(0)).p;
            const EvenTurn<T> turn = even_turn(from, along(arc, T(1)).p - from);
            for (const GaussNode& node : gauss_rule<3>) {
                const auto [t, dt] = turn.at(T(node.x));
                const OutlinePoint<T> rim = along(arc, t);
                const T z = rim.p.x * rim.dp_dt.y - rim.p.y * rim.dp_dt.x;
                sum += z * dt * T(node.weight) * inverse(max(length_squared(rim.p), T(1e-30f)));
            }
        }
        return sum;
    };
    const auto straight = [](const OutlineArc<T>& arc, T t) { return at<false>(arc, t); };
    const auto curved = [](const OutlineArc<T>& arc, T t) { return at<true>(arc, t); };
    const T sum = (light.is_ellipse() ? irradiance(above.outline, curved) : irradiance(above.outline, straight)) +
                  irradiance(above.horizon, straight);
    return select(is_above(light), abs(sum) * T(0.5f / pi<float>), T(0));
}

/// Pieces of outlines, each of one lane, side by side.
struct ArcBatch {
    OutlineArc<Batch> arc;
    LaneIndex lane;
    std::size_t count;  // the rest repeat the last
};

/// Calls visit(ArcBatch) until all of the arcs are done that have a length in a wanted lane.
template <bool curved, std::size_t N, class Visit>
void for_each_batch(const std::array<OutlineArc<Batch>, N>& arcs, const BatchMask& wanted, const Visit& visit) {
    struct Piece {
        std::int32_t arc, lane;
    };
    std::array<Piece, N * batch_size> pieces;
    std::size_t all = 0;
    for (std::size_t k = 0; k < N; ++k) {
        const BatchMask exists = wanted && (curved ? arcs[k].tangent : length_squared(arcs[k].edge)) > Batch(0.0f);
        if (!any(!exists)) {
            ArcBatch whole{arcs[k], {}, batch_size};
            std::iota(whole.lane.begin(), whole.lane.end(), 0);
            visit(whole);
            continue;
        }
        const auto lanes = store(exists);
        for (std::size_t i = 0; i < batch_size; ++i)
            if (lanes[i]) pieces[all++] = {static_cast<std::int32_t>(k), static_cast<std::int32_t>(i)};
    }
    for (std::size_t first = 0; first < all; first += batch_size) {
        ArcBatch batch;
        batch.count = std::min(batch_size, all - first);
        std::array<const OutlineArc<Batch>*, batch_size> sources;
        for (std::size_t i = 0; i < batch_size; ++i) {
            const Piece& piece = pieces[first + std::min(i, batch.count - 1)];
            sources[i] = &arcs[static_cast<std::size_t>(piece.arc)];
            batch.lane[i] = piece.lane;
        }
        batch.arc = collect(sources, batch.lane);
        visit(batch);
    }
}

}  // namespace pivot
