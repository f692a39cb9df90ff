// GGX under a cap-shaped light by the cheapest rule on the exact core that meets an error budget. Shading frame, z the
// normal. One body for a float and for a batch: a batch takes every rule that one of its lanes needs.
#pragma once

#include <optional>

#include "core/bsdf/fresnel.h"
#include "core/bsdf/ggx.h"
#include "core/distributions/ggx_slices.h"
#include "core/shading/method.h"

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
LobeSums<T> select(const Mask<T>& condition, const LobeSums<T>& a, const LobeSums<T>& b) {
    return {select(condition, a.plain, b.plain), select(condition, a.schlick, b.schlick),
            select(condition, a.dielectric, b.dielectric)};
}

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

template <int N, class T, class Falloff>
LobeSums<T> sum_slices(const GgxSlices<T>& s, LobeSummer<T, Falloff> summer) {
    for_each_slice_point<N, N>(s, [&](const GgxCapPoint<T>& point, T share) { summer(point, share); });
    return summer.sums;
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
    const auto surrounds =
        crosses && T(0.5) * length_squared(lobe.wo_local + cap.axis) < T(1.05) * cap.versine + T(1e-6);
    const Cap<T> chart_cap{select(surrounds, Vec3<T>(T(0), T(0), T(1)), cap.axis),
                           select(surrounds, T(1), cap.versine)};
    return {lobe,
            cap,
            crosses,
            !is_wide && z <= -sine,
            surrounds,
            ggx_cap(lobe.wo_local, chart_cap, lobe.alpha, lobe.alpha),
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

/// budget: relative. falloff(omega_i): what the light's radiance is multiplied by towards there; falloff_varies: in
/// some lane, so that one point is not enough.
template <class T, class Falloff>
LobeIntegral<T> integrate(const GgxCapLight<T>& light, T budget, const Falloff& falloff,
                          const Mask<T>& falloff_varies) {
    const auto& [lobe, cap, crosses, below, surrounds, g, g2] = light;
    const Cap<T> horizon{Vec3<T>(T(0), T(0), T(1)), T(1)};
    const T z = cap.axis.z, sine = sqrt(sin2_half_angle(cap));
    const detail::LobeSummer<T, Falloff> summer{lobe, g2, falloff, {}};
    const GgxCapPoint<T> center = center_point(g);
    LobeIntegral<T> result;
    {
        detail::LobeSummer<T, Falloff> one = summer;
        one(center, T(1));
        result.sums = one.sums;
    }
    // Masked as little as can be, all of the cap's half vectors are this.
    const T at_most = center.weight * g2.at_most() * T(1 / least_value);
    const T center_z = max(center.omega_i.z, T(0)), center_g2 = g2(center_z);
    const T cos_oh = center.cos_oh;
    const T turn = T(0.5) * g.sin_half * sine, fresnel_gap = T(1) - cos_oh;
    const T fresnel_bend = sqr(turn) * T(10) * lobe.fresnel_contrast * fresnel_gap * sqr(fresnel_gap) /
                           (T(1) + lobe.fresnel_contrast * schlick_weight(cos_oh));
    const T error_1 = error_of_point(lobe.alpha, cap.versine, center_z, center_g2) + T(0.25) * fresnel_bend;
    const T nearness2 = min(sqr(sine / max(z, tiny<T>)), T(1));

    result.predicted_error = min(error_1, at_most);
    result.method = detail::number_of<T>(Method::points_1);
    const auto is_whole = !crosses || at_most < budget;
    const auto take = [&](const auto& lanes, const LobeSums<T>& sums, T error, Method method) {
        result.sums = select<T>(lanes, sums, result.sums);
        result.predicted_error = select(lanes, error, result.predicted_error);
        result.method = select(lanes, detail::number_of<T>(method), result.method);
    };

    // What of a crossing light's disk is below the horizon may be too little to matter.
    auto needs_slices = crosses && !is_whole && !below;
    auto needs_points = !crosses && (result.predicted_error > budget || falloff_varies);
    std::optional<GgxSlices<T>> slices;
    if (any(needs_slices)) {
        const Cap<T> other{select(surrounds, cap.axis, horizon.axis), select(surrounds, cap.versine, horizon.versine)};
        slices.emplace(ggx_slices(g, other));
        const T lost = share_cut_off(*slices) + error_1;
        const auto barely = needs_slices && !surrounds && lost < budget;
        result.predicted_error = select(barely, min(lost, at_most), result.predicted_error);
        needs_points = needs_points || (barely && falloff_varies);
        needs_slices = needs_slices && !barely;
    }
    const auto refine = [&]<size_t N>(std::integral_constant<size_t, N>, float error_left, Method method) {
        if (!any(needs_points)) return;
        take(needs_points, detail::sum_points<N>(g, summer), min(error_1 * nearness2 * T(error_left), at_most), method);
        needs_points = needs_points && (result.predicted_error > budget || falloff_varies);
    };
    refine(std::integral_constant<size_t, 4>(), error_left_by_points_4, Method::points_4);
    refine(std::integral_constant<size_t, 8>(), error_left_by_points_8, Method::points_8);
    refine(std::integral_constant<size_t, 16>(), error_left_by_points_16, Method::points_16);
    const auto is_poor = needs_points && result.predicted_error > budget;
    if (any(is_poor)) {
        if (!slices) slices.emplace(ggx_slices(g, horizon));
        needs_slices = needs_slices || is_poor;
    }
    if (any(needs_slices)) {
        const T floor = max(budget, T(error_of_slices_8));
        const auto by_8 = needs_slices && floor < T(error_of_slices_6);
        const auto by_5 = needs_slices && !(floor < T(error_of_slices_5));
        const auto by_6 = needs_slices && !by_8 && !by_5;
        if (any(by_5)) take(by_5, detail::sum_slices<5>(*slices, summer), T(error_of_slices_5), Method::slices_5);
        if (any(by_6)) take(by_6, detail::sum_slices<6>(*slices, summer), T(error_of_slices_6), Method::slices_6);
        if (any(by_8)) take(by_8, detail::sum_slices<8>(*slices, summer), T(error_of_slices_8), Method::slices_8);
        const auto is_empty = needs_slices && slices->none;
        take(is_empty, {}, T(0), Method::none);
    }
    take(below, {}, T(0), Method::none);
    return result;
}

template <class T>
LobeIntegral<T> integrate(const GgxCapLight<T>& light, T budget) {
    const auto never = light.cap.versine < T(0);
    return integrate(
        light, budget, [](const Vec3<T>&) { return T(1); }, never);
}

}  // namespace pivot
