// GGX under a cap-shaped light by the cheapest rule on the exact core that meets an error budget. Shading frame, z the
// normal. A batch takes every rule that one of its lanes needs.
#pragma once

#include <optional>

#include "core/bsdf/fresnel.h"
#include "core/bsdf/ggx.h"
#include "core/distributions/ggx_slices.h"
#include "core/shading/method.h"
#include "core/simd/batch.h"

namespace pivot {

/// A GGX lobe as seen along wo_local, wo_local.z > 0; alpha in [min_alpha, 1].
template <class T>
struct GgxLobe {
    Vec3<T> wo_local;
    T alpha;
    T ior;                      // of the dielectric's Fresnel curve
    bool has_dielectric;        // whether any lane asks for it
    T fresnel_contrast = T(0);  // (f90 - f0) / f0 of the Fresnel curve, at most: how much it may vary over a light
};

/// The lobe over a light of radiance 1, 1/sr already summed: for F = 1, for Schlick's weight, for the dielectric's.
template <class T>
struct LobeSums {
    T plain = T(0), schlick = T(0), dielectric = T(0);
};

/// Adds a direction's value for F = 1, under each Fresnel curve.
template <class T>
void add(LobeSums<T>& sums, const GgxLobe<T>& lobe, T cos_oh, T value) {
    sums.plain += value;
    sums.schlick += value * schlick_weight(cos_oh);
    if (lobe.has_dielectric) sums.dielectric += value * fresnel_dielectric_weight(cos_oh, lobe.ior);
}

template <class T>
LobeSums<T> operator*(const LobeSums<T>& sums, T factor) {
    return {sums.plain * factor, sums.schlick * factor, sums.dielectric * factor};
}

template <class T>
LobeSums<T>& operator+=(LobeSums<T>& a, const LobeSums<T>& b) {
    a.plain += b.plain, a.schlick += b.schlick, a.dielectric += b.dielectric;
    return a;
}

template <class T>
LobeSums<T> select(const Mask<T>& condition, const LobeSums<T>& a, const LobeSums<T>& b) {
    return {select(condition, a.plain, b.plain), select(condition, a.schlick, b.schlick),
            select(condition, a.dielectric, b.dielectric)};
}

/// Of batches whose lanes are parts of other lanes' sums.
struct LaneSums {
    Lanes plain{}, schlick{}, dielectric{};

    /// The first `count` lanes of a part, each to the lane it belongs to.
    void add(const LobeSums<Batch>& part, const LaneIndex& lane, std::size_t count) {
        const Lanes p = store(part.plain), s = store(part.schlick), d = store(part.dielectric);
        for (std::size_t i = 0; i < count; ++i) {
            const auto to = static_cast<std::size_t>(lane[i]);
            plain[to] += p[i];
            schlick[to] += s[i];
            dielectric[to] += d[i];
        }
    }
    LobeSums<Batch> load() const { return {pivot::load(plain), pivot::load(schlick), pivot::load(dielectric)}; }
};

template <class T>
struct LobeIntegral {
    LobeSums<T> sums;
    T predicted_error;  // relative, see method.h
    T method;           // a Method as a number
};

/// Masking-shadowing of a direction that may be below the surface, where it is 0; the same alpha both ways.
template <class T>
struct IsotropicG2 {
    T alpha2, view_weight;  // 1 + 2 Lambda(wo)

    IsotropicG2(const Vec3<T>& wo, T alpha)
        : alpha2(sqr(alpha)), view_weight(sqrt(sqr(wo.z) + alpha2 * (sqr(wo.x) + sqr(wo.y))) * inverse(wo.z)) {}

    T operator()(T z) const {
        const T above = max(z, T(0));
        const T cosine2 = sqr(above), root = sqrt(cosine2 + alpha2 * (T(1) - min(cosine2, T(1))));
        return T(2) * above * inverse(view_weight * above + root);
    }
    T at_most() const { return T(2) * inverse(view_weight + T(1)); }
};

/// The falloff of a light that has none: as another's, its lanes can be permuted.
struct Unattenuated {
    template <class T>
    T operator()(const Vec3<T>&) const {
        return T(1);
    }
    friend Unattenuated permute(const Unattenuated& falloff, const LaneIndex&) { return falloff; }
};

namespace detail {

template <class T, class Falloff>
struct LobeSummer {
    const GgxLobe<T>& lobe;
    const IsotropicG2<T>& g2;
    const Falloff& falloff;
    LobeSums<T> sums;

    void operator()(const GgxCapPoint<T>& point, T share) {
        const T value = share * point.weight * g2(point.omega_i.z) * falloff(point.omega_i);
        add(sums, lobe, point.cos_oh, value);
    }
};

template <size_t N, class T, class Falloff>
LobeSums<T> sum_points(const GgxCap<T>& g, LobeSummer<T, Falloff> summer) {
    for (const GgxCapPoint<T>& point : points<N>(g)) summer(point, T(1.0 / N));
    return summer.sums;
}

/// What the pieces of several lanes' slices need of their lanes.
struct PieceLanes {
    GgxPlane<Batch> plane;
    IsotropicG2<Batch> g2;
    Batch ior;
};

/// Few lanes ask for slices, and each for as many panels as its light needs: it is their pieces that fill batches.
template <int N, class Falloff>
LobeSums<Batch> sum_slices(const GgxSlices<Batch>& slices, const BatchMask& wanted,
                           const LobeSummer<Batch, Falloff>& summer) {
    struct Piece {
        std::int32_t lane;
        float x, low, high, width;
    };
    const auto is_wanted = store(wanted);
    std::array<std::int32_t, batch_size> lanes;
    std::size_t lane_count = 0, piece_count = 0;
    for (std::size_t i = 0; i < batch_size; ++i)
        if (is_wanted[i]) lanes[lane_count++] = static_cast<std::int32_t>(i);
    constexpr std::size_t panels = std::tuple_size_v<decltype(slices.ends)> - 1;
    std::array<Piece, batch_size * panels * N * 2> pieces;
    for_each_piece<N>(slices, [&](const GgxPiece<Batch>& piece) {
        const Lanes x = store(piece.x), low = store(piece.low), high = store(piece.high), width = store(piece.width);
        for (std::size_t k = 0; k < lane_count; ++k) {
            const auto i = static_cast<std::size_t>(lanes[k]);
            if (width[i] > 0.0f && high[i] > low[i])
                pieces[piece_count++] = {lanes[k], x[i], low[i], high[i], width[i]};
        }
    });

    const PieceLanes all{slices.plane, summer.g2, summer.lobe.ior};
    LaneSums sums;
    for (std::size_t first = 0; first < piece_count; first += batch_size) {
        const std::size_t count = std::min(batch_size, piece_count - first);
        const auto piece = [&](std::size_t i) -> const Piece& { return pieces[first + std::min(i, count - 1)]; };
        LaneIndex lane;
        for (std::size_t i = 0; i < batch_size; ++i) lane[i] = piece(i).lane;
        const PieceLanes picked = permute(all, lane);
        const Falloff falloff = permute(summer.falloff, lane);
        GgxLobe<Batch> lobe = summer.lobe;
        lobe.ior = picked.ior;
        LobeSummer<Batch, Falloff> along{lobe, picked.g2, falloff, {}};
        const GgxPiece<Batch> batch{gather([&](std::size_t i) { return piece(i).x; }),
                                    gather([&](std::size_t i) { return piece(i).low; }),
                                    gather([&](std::size_t i) { return piece(i).high; }),
                                    gather([&](std::size_t i) { return piece(i).width; })};
        for_each_point<N>(picked.plane, batch,
                          [&](const GgxCapPoint<Batch>& point, const Batch& share) { along(point, share); });
        sums.add(along.sums, lane, count);
    }
    return sums.load();
}

template <class T>
T number_of(Method method) {
    return T(static_cast<float>(method));
}

}  // namespace detail

/// A lobe and a light's cap, a hemisphere at most or, for a point inside the light, the whole sphere.
template <class T>
struct GgxCapLight {
    GgxLobe<T> lobe;
    Cap<T> cap;
    Mask<T> crosses, below;  // the horizon
    Mask<T> surrounds;       // -wo, so that it has no disk: the horizon's own is cut by it
    GgxCap<T> chart;
    IsotropicG2<T> g2;
};

template <class T>
GgxCapLight<T> ggx_cap_light(const GgxLobe<T>& lobe, const Cap<T>& cap) {
    const T z = cap.axis.z, sine = sqrt(sin2_half_angle(cap));
    const auto is_wide = cap.versine > T(1);
    const auto crosses = is_wide || z < sine;
    auto surrounds = crosses;
    Cap<T> chart_cap = cap;
    if (any(crosses)) {
        surrounds = crosses && T(0.5) * length_squared(lobe.wo_local + cap.axis) < T(1.05) * cap.versine + T(1e-6);
        chart_cap = {select(surrounds, Vec3<T>(T(0), T(0), T(1)), cap.axis), select(surrounds, T(1), cap.versine)};
    }
    return {lobe,
            cap,
            crosses,
            !is_wide && z <= -sine,
            surrounds,
            ggx_cap(lobe.wo_local, chart_cap, lobe.alpha),
            IsotropicG2<T>(lobe.wo_local, lobe.alpha)};
}

/// A direction and the lobe, F = 1, over the density that uniform points (x, y) of the unit disk give it: 0 outside of
/// the light and below the surface.
template <class T>
struct LobePoint {
    Vec3<T> omega_i;
    T value;
};

template <class T>
LobePoint<T> lobe_point(const GgxCapLight<T>& light, const GgxAxes<T>& axes, const Vec2<T>& xy, T room) {
    const GgxCapPoint<T> point = disk_point(light.chart, axes, xy, room);
    const auto is_seen = !light.surrounds || contains(light.cap, point.omega_i);
    return {point.omega_i, select(is_seen, point.weight * light.g2(point.omega_i.z), T(0))};
}

namespace detail {

/// What one point is off by.
template <class T>
struct PointError {
    T one, at_most;  // relative; at_most: of leaving the light out
};

/// The lanes that the cheapest slices within a budget are taken of.
template <class T>
struct SliceChoice {
    Mask<T> five, six, eight;
};

template <class T>
SliceChoice<T> choose_slices(T budget, const Mask<T>& wanted) {
    const T floor = max(budget, T(error_of_slices_8));
    const auto eight = wanted && floor < T(error_of_slices_6), five = wanted && !(floor < T(error_of_slices_5));
    return {five, wanted && !eight && !five, eight};
}

/// By the cheapest rule that is good enough, for the lanes where one point is not. Apart from that, which is most
/// lights' case.
template <class T, class Falloff>
[[gnu::noinline]] void refine(const GgxCapLight<T>& light, T budget, const PointError<T>& error,
                              const LobeSummer<T, Falloff>& summer, const Mask<T>& falloff_varies,
                              LobeIntegral<T>& result) {
    const auto& [lobe, cap, crosses, below, surrounds, g, g2] = light;
    const Cap<T> horizon{Vec3<T>(T(0), T(0), T(1)), T(1)};
    const auto take = [&](const auto& lanes, const LobeSums<T>& sums, T left, Method method) {
        result.sums = select<T>(lanes, sums, result.sums);
        result.predicted_error = select(lanes, min(left, error.at_most), result.predicted_error);
        result.method = select(lanes, number_of<T>(method), result.method);
    };

    auto needs_slices = crosses && !below && error.at_most >= budget;
    auto needs_points = !crosses && (result.predicted_error > budget || falloff_varies);
    std::optional<GgxSlices<T>> slices;
    if (any(needs_slices)) {
        const Cap<T> other{select(surrounds, cap.axis, horizon.axis), select(surrounds, cap.versine, horizon.versine)};
        slices.emplace(ggx_slices(g, other));
        // What of a crossing light's disk is below the horizon may be too little to matter.
        const T lost = share_cut_off(*slices) + error.one;
        const auto barely = needs_slices && !surrounds && lost < budget;
        result.predicted_error = select(barely, min(lost, error.at_most), result.predicted_error);
        needs_points = needs_points || (barely && falloff_varies);
        needs_slices = needs_slices && !barely;
    }
    if (any(needs_points)) {
        // (sin psi / sin elevation)^2: how near the light is to the horizon
        const T nearness2 = min(sin2_half_angle(cap) * inverse(max(sqr(cap.axis.z), T(1e-12f))), T(1));
        const T left = error.one * nearness2;
        const auto by_4 = needs_points && !falloff_varies && left * T(error_left_by_points_4) <= budget;
        const auto by_8 = needs_points && !falloff_varies && !by_4 && left * T(error_left_by_points_8) <= budget;
        const auto by_16 = needs_points && !by_4 && !by_8 && left * T(error_left_by_points_16) <= budget;
        if (any(by_4)) take(by_4, sum_points<4>(g, summer), left * T(error_left_by_points_4), Method::points_4);
        if (any(by_8)) take(by_8, sum_points<8>(g, summer), left * T(error_left_by_points_8), Method::points_8);
        if (any(by_16)) take(by_16, sum_points<16>(g, summer), left * T(error_left_by_points_16), Method::points_16);
        if (const auto rest = needs_points && !by_4 && !by_8 && !by_16; any(rest)) {
            if (!slices) slices.emplace(ggx_slices(g, horizon));
            needs_slices = needs_slices || rest;
        }
    }
    if (any(needs_slices)) {
        const SliceChoice<T> by = choose_slices(budget, needs_slices);
        if (any(by.five))
            take(by.five, sum_slices<5>(*slices, by.five, summer), T(error_of_slices_5), Method::slices_5);
        if (any(by.six)) take(by.six, sum_slices<6>(*slices, by.six, summer), T(error_of_slices_6), Method::slices_6);
        if (any(by.eight))
            take(by.eight, sum_slices<8>(*slices, by.eight, summer), T(error_of_slices_8), Method::slices_8);
        take(needs_slices && slices->none, {}, T(0), Method::none);
    }
}

}  // namespace detail

/// budget: relative. falloff(omega_i): what the light's radiance is multiplied by towards there; falloff_varies: in
/// some lane, so that one point is not enough.
template <class T, class Falloff>
LobeIntegral<T> integrate(const GgxCapLight<T>& light, T budget, const Falloff& falloff,
                          const Mask<T>& falloff_varies) {
    const auto& [lobe, cap, crosses, below, surrounds, g, g2] = light;
    const GgxCapPoint<T> center = center_point(g);
    const T center_z = max(center.omega_i.z, T(0)), center_g2 = g2(center_z), cos_oh = center.cos_oh;
    LobeIntegral<T> result;
    add(result.sums, lobe, cos_oh, center.weight * center_g2 * falloff(center.omega_i));

    const T sine2 = sin2_half_angle(cap), fresnel_gap = T(1) - cos_oh;
    const T fresnel_bend = T(0.25 * 0.25 * 10) * sqr(g.sin_half) * sine2 * lobe.fresnel_contrast * fresnel_gap *
                           sqr(fresnel_gap) * inverse(T(1) + lobe.fresnel_contrast * schlick_weight(cos_oh));
    // Masked as little as can be, all of the cap's half vectors are at_most.
    const detail::PointError<T> error{error_of_point(lobe.alpha, cap.versine, center_z, center_g2) + fresnel_bend,
                                      center.weight * g2.at_most() * T(1 / least_value)};
    result.predicted_error = min(error.one, error.at_most);
    result.method = detail::number_of<T>(Method::points_1);
    if (any(!below && error.at_most >= budget && (crosses || result.predicted_error > budget || falloff_varies))) {
        const detail::LobeSummer<T, Falloff> summer{lobe, g2, falloff, {}};
        detail::refine(light, budget, error, summer, falloff_varies, result);
    }
    result.sums = select<T>(below, {}, result.sums);
    result.predicted_error = select(below, T(0), result.predicted_error);
    result.method = select(below, detail::number_of<T>(Method::none), result.method);
    return result;
}

template <class T>
LobeIntegral<T> integrate(const GgxCapLight<T>& light, T budget) {
    const auto never = light.cap.versine < T(0);
    return integrate(light, budget, Unattenuated(), never);
}

/// What slices are off by within a budget.
template <class T>
T error_of_slices(T budget) {
    const detail::SliceChoice<T> by = detail::choose_slices(budget, budget == budget);
    return select(by.five, T(error_of_slices_5), select(by.six, T(error_of_slices_6), T(error_of_slices_8)));
}

/// The lobe over what of the light lies in another cap too, in the lanes that are wanted; these must not surround -wo.
template <class T>
LobeSums<T> integrate_within(const GgxCapLight<T>& light, const Cap<T>& other, T budget, const Mask<T>& wanted) {
    const GgxSlices<T> slices = ggx_slices(light.chart, other);
    const detail::SliceChoice<T> by = detail::choose_slices(budget, wanted && !light.below && !slices.none);
    const Unattenuated falloff;
    const detail::LobeSummer<T, Unattenuated> summer{light.lobe, light.g2, falloff, {}};
    LobeSums<T> sums;
    if (any(by.five)) sums = select<T>(by.five, detail::sum_slices<5>(slices, by.five, summer), sums);
    if (any(by.six)) sums = select<T>(by.six, detail::sum_slices<6>(slices, by.six, summer), sums);
    if (any(by.eight)) sums = select<T>(by.eight, detail::sum_slices<8>(slices, by.eight, summer), sums);
    return sums;
}

}  // namespace pivot
