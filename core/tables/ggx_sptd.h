// The spherical pivot transformed distribution nearest to a GGX reflection lobe: a 64 x 64 table over alpha and the
// view's cosine, made by lut/ggx_sptd.py. D_std is uniform.
//
// [Dupuy17] Dupuy, Heitz, Belcour, "A Spherical Cap Preserving Parameterization for Spherical Distributions",
// 2017, 5.2.
//
// Departures: the pivot's elevation is stored as its distance from the mirror direction and delta = 1 - |r_p| in its
// stead of the norm, both as multiples of alpha, so that the sharpest lobes keep their bits and interpolate; the
// uniform D_std leaks below the horizon, so the lobe's amplitude is its albedo over the part that is left above
// (`amplitude`).
#pragma once

#include "core/math/vector.h"

namespace pivot {

struct GgxSptd {
    Vec3f pivot_local;  // unit direction of the pivot, in the plane of wo and the normal
    float delta;        // 1 - |r_p|
    float albedo;       // of GGX with F = 1: the integral of BRDF * cos over the hemisphere

    /// What the SPTD, which integrates to 1 over the sphere, is multiplied by so that it integrates to the albedo over
    /// the hemisphere.
    float amplitude() const {
        const float slope = 2.f * (1.f - delta) * pivot_local.z / (delta * (2.f - delta));
        return 2.f * albedo / (1.f + slope / sqrt(1.f + slope * slope));
    }
};

inline constexpr int ggx_sptd_nodes = 64;

/// What a table's node holds, and what it means for this view: `shift` turns the pivot from the mirror direction
/// towards the horizon by the angle 2 atan(alpha * shift * sin_o / 2), `width` is delta / alpha.
inline GgxSptd ggx_sptd_from_node(float alpha, const Vec3f& wo_local, float shift, float width, float albedo) {
    const float cos_o = wo_local.z, sin2_o = (1.f - cos_o) * (1.f + cos_o);
    const Vec3f mirror(-wo_local.x, -wo_local.y, cos_o);
    const Vec3f across(-cos_o * wo_local.x, -cos_o * wo_local.y, -sin2_o);  // of length sin_o
    const float turn = alpha * shift, tan2_half = 0.25f * turn * turn * sin2_o;
    return {((1.f - tan2_half) * mirror + turn * across) / (1.f + tan2_half), min(alpha * width, 1.f), albedo};
}

/// For alpha in [1e-3, 1] and a unit wo_local with z >= 0.
GgxSptd ggx_sptd(float alpha, const Vec3f& wo_local);

/// The table itself: [alpha][cos][shift, width, albedo], axes as in axes.h.
const float* ggx_sptd_table();

}  // namespace pivot
