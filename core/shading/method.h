// The methods the analytic integrator chooses from, and the errors they are known to make.
//
// An error is |value - exact| / max(exact, 1e-3 of the light's radiance), F = 1. The bounds were fitted to random
// caps: alpha 0.001..1, views to 88 degrees, half-angles 0.001..80 degrees, centres around the highlight and across the
// horizon; tests/benchmark/analytic.py measures them.
#pragma once

#include <array>
#include <string_view>

#include "core/math/number.h"

namespace pivot {

enum class Method : unsigned char {
    none,      ///< below the horizon
    points_1,  ///< the exact core's disk by 1, 4, 8 or 16 points
    points_4,
    points_8,
    points_16,
    slices_5,  ///< the exact core's disk, cut at the horizon, by 5 x 5, 6 x 6 or 8 x 8 points a panel
    slices_6,
    slices_8,
    beam_layers,      ///< slices of the exact core's disk within each cone of a spot's beam
    area_points,      ///< points of an area light, spread as the lobe sees it
    lobe_directions,  ///< directions of the lobe that meet an area light; points of a lobe without closed forms
    sptd,
    ltc,
    virtual_lights,  ///< Gaussians, together where they look small
    point_set,       ///< light from everywhere
};

inline constexpr std::array<std::string_view, 15> method_names{
    "NONE",        "POINTS_1",    "POINTS_4",        "POINTS_8", "POINTS_16", "SLICES_5",       "SLICES_6", "SLICES_8",
    "BEAM_LAYERS", "AREA_POINTS", "LOBE_DIRECTIONS", "SPTD",     "LTC",       "VIRTUAL_LIGHTS", "POINT_SET"};

/// The error of the exact core's one point, for a cap of the given versine that does not cross the horizon. What the
/// point takes for constant is masking-shadowing: its relative slope along z, and the slope's own scale, z.
/// z: of the highlight's centre; g2: masking-shadowing there.
template <class T>
T error_of_point(T alpha, T versine, T z, T g2) {
    const T alpha2 = sqr(alpha), root = sqrt(sqr(z) + alpha2 * (T(1) - sqr(z)));
    return T(0.3) * versine * alpha2 * g2 * (T(1) + z) * inverse(max(z * sqr(z) * root, tiny<T>));
}

/// What 4, 8 and 16 points leave of that, times nearness^2: sin psi over the sine of the centre's elevation, squared,
/// is 1 where the light touches the horizon.
inline constexpr float error_left_by_points_4 = 1.0f;
inline constexpr float error_left_by_points_8 = 0.43f;
inline constexpr float error_left_by_points_16 = 0.4f;

/// The worst that slices were seen to make.
inline constexpr float error_of_slices_5 = 0.014f;
inline constexpr float error_of_slices_6 = 0.006f;
inline constexpr float error_of_slices_8 = 0.0025f;

/// What 16 points on a light are off by under a spot's falloff, relative to `center`, the falloff at the light's
/// middle: the light spans `rise` of the falloff, and `widths` times the width of the beam's edge.
template <class T>
T error_of_falloff(T rise, T widths, T center) {
    return max(T(0.011f), T(0.009f) * widths) * rise * inverse(max(center, T(1e-3f)));
}

/// A beam's edge as a stack of this many cones, and what the stack is off by.
inline constexpr int beam_layers = 4;
inline constexpr float error_of_beam_layers = 0.001f;
/// The same where the light also crosses the horizon, which slices across the beam's edge do not see.
inline constexpr float error_of_beam_across_horizon = 0.1f;

/// The tables of what a lobe reflects of light from everywhere are interpolated.
inline constexpr float error_of_albedo = 0.005f;

/// Errors are relative, but to no less than this share of the light's radiance.
inline constexpr float least_value = 1e-3f;

}  // namespace pivot
