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

/// Towards wi, of light that a ray along `direction` finds: both unit. By their distance, which keeps its bits where a
/// sharp phase function has its peak.
template <class T>
T eval(const Phase& phase, const Vec3<T>& direction, const Vec3<T>& wi) {
    const float g = std::abs(phase.g);
    const T distance2 = length_squared(phase.g < 0.0f ? wi + direction : wi - direction);
    const T q = T(sqr(1.0f - g)) + T(g) * distance2, of_all = T((1.0f - g) * (1.0f + g));
    switch (phase.kind) {
        case PhaseKind::henyey_greenstein:
            return T(0.25f) / pi<T> * of_all / (q * sqrt(q));
        case PhaseKind::pivot:
            return T(0.25f) / pi<T> * sqr(of_all / q);
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

/// A direction in proportion to the phase function about that of travel.
inline Vec3f sample(const Phase& phase, const Vec3f& direction, const Vec2f& u) {
    const Vec2f cosine = sample_cosine(phase, u.x);
    const float angle = 2.0f * pi<float> * u.y;
    return frame_from_z(direction).to_world({cosine.y * std::cos(angle), cosine.y * std::sin(angle), cosine.x});
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
    const T of_proxy = eval(Phase{PhaseKind::pivot, proxy.g_p}, direction, light.axis);
    const T scaled = min(whole * eval(phase, direction, light.axis) / max(of_proxy, tiny<T>), T(1));
    return select(light.versine > T(1.99f), T(1), scaled);
}

}  // namespace pivot
