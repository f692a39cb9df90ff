// A spot's beam over the cap that the spot covers, as a stack of caps: the falloff depends on the cosine from the
// spot's axis alone, so that f times falloff over the light is f over the light's part within each cone about the axis,
// summed by how much the falloff rises there. That has no noise and no steps, however hard the beam's edge.
#pragma once

#include "core/distributions/cap.h"
#include "core/lights/light.h"

namespace pivot {

/// The cosines from the spot's axis to the directions of a cap.
template <class T>
struct BeamSpan {
    T low, high;
};

/// to_beam: from the lit point, against the spot's direction; both in one frame.
template <class T>
BeamSpan<T> beam_span(const Vec3<T>& to_beam, const Cap<T>& cap) {
    const T cosine = dot(to_beam, cap.axis), turn = safe_sqrt(sin2_half_angle(cap) * (T(1) - sqr(cosine)));
    const T cos_psi = cos_half_angle(cap), rest = cosine * cos_psi;
    return {select(cosine <= -cos_psi, T(-1), rest - turn), select(cosine >= cos_psi, T(1), rest + turn)};
}

/// Calls visit(cosine, rise) with the stack's cones: what the falloff rises by from the span's low end on, at N places
/// of its edge, and of the rest where that falls off too.
template <int N, class T, class Visit>
void for_each_layer(const SpotLight& spot, const BeamSpan<T>& span, const Visit& visit) {
    const T edge(spot.cos_half_angle), width(spot_falloff_width(spot));
    // By parts of the edge's width: cosines a hard edge apart share all but their last bits.
    const T low = clamp01((span.low - edge) / width), length = clamp01((span.high - edge) / width) - low;
    if (any(length > T(0))) {
        for (const GaussNode& node : gauss_rule<N>) {
            const T t = low + length * T(node.x), cosine = edge + width * t, slope = T(6) * t * (T(1) - t);
            visit(cosine, length * T(node.weight) * (spot.is_cosine ? slope * cosine + falloff_of(t) * width : slope));
        }
    }
    if (!spot.is_cosine) return;
    const T begin = max(edge + width, span.low), rest = max(span.high - begin, T(0));
    if (!any(rest > T(0))) return;
    for (const GaussNode& node : gauss_rule<N>) visit(begin + rest * T(node.x), rest * T(node.weight));
}

}  // namespace pivot
