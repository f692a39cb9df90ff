// The linearly transformed cosine nearest to a GGX reflection lobe: a 64 x 64 table over alpha and the view's cosine,
// made by lut/ggx_ltc.py.
//
// [Heitz16] Heitz, Dupuy, Hill, Neubelt, "Real-Time Polygonal-Light Shading with Linearly Transformed Cosines", 2016.
//
// Departures: four numbers in place of three and an axis at the lobe's mean, each as a multiple of alpha that varies
// slowly, so that the sharpest lobes keep their bits and interpolate; the cosine leaks below the horizon, so the
// lobe's amplitude is its albedo over the part that is left above.
#pragma once

#include "core/distributions/ltc.h"

namespace pivot {

struct GgxLtc {
    Ltsd<float> lobe_local;  // the clamped cosine
    float albedo;            // of GGX with F = 1: the integral of BRDF * cos over the hemisphere

    /// What the LTC, which integrates to 1 over the sphere, is multiplied by so that it integrates to the albedo over
    /// the hemisphere.
    float amplitude() const { return albedo / integrate_above_horizon(lobe_local); }
};

inline constexpr int ggx_ltc_nodes = 64;

/// The matrix that a node stands for, its columns X, Y and Z: Z is the mirror direction, turned towards the horizon by
/// 2 atan(alpha shift sin_o / 2); X, in the plane of wo and the normal, is alpha (width_x t + skew sin_o / (cos_o +
/// alpha) Z), t across Z towards the horizon; Y is alpha width_y across both.
template <class T>
Mat3<T> ggx_ltc_matrix(T alpha, const Vec3<T>& wo_local, T shift, T width_x, T width_y, T skew) {
    const T cos_o = wo_local.z, sin_o = safe_sqrt((T(1) - cos_o) * (T(1) + cos_o));
    const Vec3<T> away = select(sin_o > T(0), Vec3<T>(-wo_local.x, -wo_local.y, T(0)) / max(sin_o, tiny<T>),
                                Vec3<T>(T(1), T(0), T(0)));  // of the view, along the surface
    const T turn = T(0.5) * alpha * shift * sin_o, scale = T(1) / (T(1) + turn * turn);
    const T cosine = (T(1) - turn * turn) * scale, sine = T(2) * turn * scale;
    const T across = sin_o * cosine + cos_o * sine, up = cos_o * cosine - sin_o * sine;
    const Vec3<T> z = across * away + Vec3<T>(T(0), T(0), up), t = up * away - Vec3<T>(T(0), T(0), across);
    return {alpha * (width_x * t + skew * sin_o / (cos_o + alpha) * z),
            alpha * width_y * Vec3<T>(-away.y, away.x, T(0)), z};
}

/// For alpha in [1e-3, 1] and a unit wo_local with z >= 0.
GgxLtc ggx_ltc(float alpha, const Vec3f& wo_local);

}  // namespace pivot
