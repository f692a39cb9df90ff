// How a medium scatters: one of its phase functions, per steradian at mu = cos of the angle to the direction of travel.
#pragma once

#include "core/media/pivot_phase.h"

namespace pivot {

enum class PhaseKind : std::uint8_t { henyey_greenstein, pivot };

/// g: Henyey-Greenstein's mean cosine, or the pivot phase function's g_p; in (-1, 1).
struct Phase {
    PhaseKind kind;
    float g;
};

/// |g| is at most this: nearer to 1 a phase function is a mirror, and its peak infinite.
inline constexpr float max_abs_phase_g = 1.0f - 1e-4f;

template <class T>
T eval(const Phase& phase, T mu) {
    switch (phase.kind) {
        case PhaseKind::henyey_greenstein:
            return eval(HenyeyGreenstein<T>{T(phase.g)}, mu);
        case PhaseKind::pivot:
            return eval(PivotPhase<T>{T(phase.g)}, mu);
    }
    return T(0);
}

/// (mu, sin) in proportion to the phase function.
inline Vec2f sample_cosine(const Phase& phase, float xi) {
    switch (phase.kind) {
        case PhaseKind::henyey_greenstein:
            return sample_cosine(HenyeyGreenstein<float>{phase.g}, xi);
        case PhaseKind::pivot:
            return sample_cosine(PivotPhase<float>{phase.g}, xi);
    }
    return {1.0f, 0.0f};
}

/// The pivot phase function to sample a lamp by. Of a sharp Henyey-Greenstein lobe not the one that looks most like it,
/// but the one of the least chi^2 (g_p 0.833, 0.910, 0.980 of g 0.9, 0.95, 0.99), between which this is a fit.
inline PivotPhase<float> proxy_of(const Phase& phase) {
    if (phase.kind == PhaseKind::pivot) return {phase.g};
    const float x = 1.0f - std::abs(phase.g);
    if (x > 0.1f) return pivot_phase_like(HenyeyGreenstein<float>{phase.g});
    return {std::copysign(1.0f - x * (2.05f - x * (5.0f - 12.0f * x)), phase.g)};
}

/// About the integral over a sphere light's cap: the proxy's, by how much the phase function differs at its axis. Exact
/// of the pivot phase function. direction: of travel.
template <class T>
T integrate(const Phase& phase, const PivotPhase<float>& proxy, const Vec3<T>& direction, const Cap<T>& light) {
    const PivotPhase<T> pivoted{T(proxy.g_p)};
    const T whole = integrate(pivoted, direction, light);
    if (phase.kind == PhaseKind::pivot) return whole;
    const T mu = min(max(dot(light.axis, direction), T(-1)), T(1));
    const T scaled = min(whole * eval(phase, mu) / max(eval(pivoted, mu), tiny<T>), T(1));
    return select(light.versine > T(1.99f), T(1), scaled);
}

}  // namespace pivot
