// How virtual lights lie about the surfaces of a batch.
#pragma once

#include "core/integrators/surface_batch.h"
#include "core/lights/virtual_lights.h"

namespace pivot {

/// The mean of the clamped cosine to axes about one at cosine z, of that variance: algebraic, and finite at all.
inline Batch mean_clamped_cosine(const Batch& z, const Batch& variance) {
    const Batch one(1.0f), spread = Batch(2.0f / pi<float>) * variance;
    const Batch c = z * inverse(one + variance), tail = spread * inverse(one + Batch(4.0f) * spread);
    return Batch(0.5f) * (c + sqrt(c * c + tail));
}

inline Batch smoothstep(const Batch& x) {
    const Batch t = clamp01(x);
    return t * t * (Batch(3.0f) - Batch(2.0f) * t);
}

/// A light, or those below it, or a piece of it, from each lane.
struct LightView {
    Vec3b towards;  ///< world
    Vec3b wi;       ///< in the shading frame
    Batch distance2, variance;
    Vec3f axis;    ///< theirs
    Batch facing;  ///< cosine from it
    Batch reach;   ///< tangent of the angle that all are within
};

inline LightView view_of(const SurfaceBatch& batch, const Vec3f& axis, const Vec3f& mean, float variance_m2,
                         float bound_m) {
    const Vec3b to_mean = broadcast(mean) - batch.position;
    const Batch distance2 = max(dot(to_mean, to_mean), Batch(1e-20f)), inverse_distance = inverse_sqrt(distance2);
    const Vec3b towards = to_mean * inverse_distance;
    return {towards,
            batch.frame.to_local(towards),
            distance2,
            Batch(variance_m2) * inverse_distance * inverse_distance,
            axis,
            -dot(towards, broadcast(axis)),
            Batch(bound_m) * inverse_distance};
}

inline LightView view_of(const SurfaceBatch& batch, const VirtualLight& light) {
    return view_of(batch, light.axis, light.mean, light.variance_m2, light.bound_m);
}

/// Of a piece of the light.
inline LightView view_of(const SurfaceBatch& batch, const VirtualLight& light, bool is_glossy,
                         const LightPiece& piece) {
    const Vec3f axis =
        is_glossy ? normalize(light.axis + light.turn.axis_from_place * (piece.mean - light.mean)) : light.axis;
    return view_of(batch, axis, piece.mean, piece.variance_m2, 3.0f * std::sqrt(piece.variance_m2));
}

/// Whether none of a light, nor those below it, shine at any of the lanes asked for.
inline bool is_dark(const VirtualLight& light, bool is_glossy, const LightView& view, const BatchMask& lanes) {
    const Batch zero(0.0f);
    BatchMask lit = view.wi.z + view.reach > zero && lanes;
    if (is_glossy) {
        // exp(-15) of the peak, from the nearest of them
        const Batch gap = sqrt(max(Batch(2.0f) - Batch(2.0f) * view.facing, zero)) - view.reach;
        lit = lit && Batch(0.5f * light.sharpness) * sqr(max(gap, zero)) < Batch(15.0f);
    } else if (light.sharpness > 1e4f) {
        const Batch height = -dot(view.towards, broadcast(light.axis)) * sqrt(view.distance2);
        lit = lit && height > Batch(light.lowest_m + 1e-3f * std::sqrt(light.variance_m2));
    } else {
        lit = lit && view.facing + view.reach + Batch(3.0f / std::sqrt(std::max(light.sharpness, 1e-3f))) > zero;
    }
    return !any(lit);
}

struct PlaceInView {
    Vec3b wi;  ///< world
    Batch distance_m;
    BatchMask is_faced;
};

/// One of a light's places for each lane: where some and the lane's surface face each other and some do not, one
/// that does.
inline PlaceInView place_in_view(const SurfaceBatch& batch, const Vec3b& normal_geometric, const VirtualLight& light,
                                 const BatchMask& wanted, std::uint32_t turn) {
    PlaceInView result;
    for (std::uint32_t i = 0; i < VirtualLight::place_count; ++i) {
        const LightPlace& place = light.places[(turn + i) % VirtualLight::place_count];
        const Vec3b to_place = broadcast(place.position) - batch.position;
        const Batch distance = sqrt(max(dot(to_place, to_place), Batch(1e-20f)));
        const Vec3b wi = to_place * inverse(distance);
        const BatchMask faced = dot(wi, normal_geometric) > Batch(0.0f) && dot(wi, batch.frame.z) > Batch(0.0f) &&
                                dot(wi, broadcast(place.normal)) < Batch(0.0f);
        if (i == 0) {
            result = {wi, distance, faced};
        } else {
            const BatchMask better = faced && !result.is_faced;
            result = {select(better, wi, result.wi), select(better, distance, result.distance_m),
                      result.is_faced || faced};
        }
        if (!any(wanted && !result.is_faced)) break;
    }
    return result;
}

}  // namespace pivot
