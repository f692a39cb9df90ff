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

}  // namespace pivot
