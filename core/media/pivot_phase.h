// The pivot phase function: the uniform sphere seen through a pivot on the direction of travel, and so the
// one phase function whose integral over a sphere light, and whose sampling inside it, are exact.
//
// [Dupuy17] Dupuy, Heitz, Belcour, "A Spherical Cap Preserving Parameterization for Spherical Distributions",
// 2017.
//
// Departure: Eq 28's denominator is 1 - 0.8409 u - 0.0223 u^2; with the printed + the fit ends at Q(1) =
// 0.754.
#pragma once

#include "core/distributions/sptd.h"
#include "core/media/henyey_greenstein.h"

namespace pivot {

/// g_p in (-1, 1): the pivot point is g_p omega_o. Not the mean cosine.
template <class T>
struct PivotPhase {
    T g_p;
};

/// The pivot that carries the uniform sphere to the phase function around the direction of travel: what the SPTD
/// functions take to integrate and sample it over a light's cap, or over intersections of caps [Dupuy17, 6.2].
template <class T>
Pivot<T> pivot(const PivotPhase<T>& phase, const Vec3<T>& omega_o) {
    return {select(phase.g_p < T(0), -omega_o, omega_o), T(1) - abs(phase.g_p)};
}

/// The integral over a sphere light's cap, in [0, 1].
template <class T>
T integrate(const PivotPhase<T>& phase, const Vec3<T>& omega_o, const Cap<T>& light) {
    return integrate_uniform(pivot(phase, omega_o), light);
}

/// A direction inside the light's cap, drawn in proportion to the phase function.
template <class T>
Vec3<T> sample(const PivotPhase<T>& phase, const Vec3<T>& omega_o, const Cap<T>& light, const Vec2<T>& u) {
    return sample_uniform(pivot(phase, omega_o), light, u);
}

/// pdf of that direction per steradian.
template <class T>
T pdf_omega(const PivotPhase<T>& phase, const Vec3<T>& omega_o, const Cap<T>& light, const Vec3<T>& omega) {
    return pdf_omega_uniform(pivot(phase, omega_o), light, omega);
}

/// Per steradian at mu = omega . omega_o [Dupuy17 (25)].
template <class T>
T eval(const PivotPhase<T>& phase, T mu) {
    const T g = phase.g_p;
    return T(0.25) / pi<T> * sqr((T(1) - g) * (T(1) + g) / detail::squared_distance(g, mu));
}

/// The probability of a cosine <= mu.
template <class T>
T cdf(const PivotPhase<T>& phase, T mu) {
    const T g = phase.g_p;
    return sqr(T(1) - g) * (T(1) + mu) / (T(2) * detail::squared_distance(g, mu));
}

/// (mu, sin) drawn by inverting the cdf at xi; its pdf per steradian is eval.
template <class T>
Vec2<T> sample_cosine(const PivotPhase<T>& phase, T xi) {
    const T g = phase.g_p, forward = sqr(T(1) + g) * xi, backward = sqr(T(1) - g) * (T(1) - xi);
    const T scale = T(1) / (forward + backward);
    return {(forward - backward) * scale, T(2) * sqrt(forward * backward) * scale};
}

/// (1 + g^2) / (2 g) - (1 - g^2)^2 / (2 g^2) atanh g; near g = 0 its series, 4/3 g - sum 4 g^(2n-1) /
/// ((2n-3)(2n-1)(2n+1)).
template <class T>
T mean_cosine(const PivotPhase<T>& phase) {
    const T g = phase.g_p, g2 = g * g;
    T series = T(0);
    for (int n = 16; n >= 2; --n) {
        const T odd = T(2 * n - 1);
        series = g2 * (T(4) / (odd * (odd * odd - T(4))) + series);
    }
    const T safe = select(abs(g) < T(0.1), T(0.5), g), one_minus_g2 = (T(1) - safe) * (T(1) + safe);
    const T atanh_g = T(0.5) * log((T(1) + safe) / (T(1) - safe));
    const T closed = (T(1) + safe * safe - sqr(one_minus_g2) * atanh_g / safe) / (T(2) * safe);
    return select(abs(g) < T(0.3), g * (T(4) / T(3) - series), closed);
}

/// g_p that looks like Henyey-Greenstein at g [Dupuy17 (27-28), corrected].
template <class T>
PivotPhase<T> pivot_phase_like(const HenyeyGreenstein<T>& phase) {
    const T u = abs(phase.g);
    const T q = u * (T(0.7489) - T(0.6121) * u) / (T(1) - u * (T(0.8409) + T(0.0223) * u));
    return {select(phase.g < T(0), -q, q)};
}

/// g_p whose mean cosine is Henyey-Greenstein's, its g: Newton from the rational fit.
template <class T>
PivotPhase<T> pivot_phase_of_mean_cosine(const HenyeyGreenstein<T>& phase) {
    const T largest = T(1) - std::numeric_limits<T>::epsilon();
    T g_p = max(min(pivot_phase_like(phase).g_p, largest), -largest);
    for (int i = 0; i < 8; ++i) {
        const T g2 = g_p * g_p, atanh_g = T(0.5) * log((T(1) + g_p) / (T(1) - g_p));
        const T safe = select(g2 < T(0.01), T(1), g_p);
        const T bracket = select(g2 < T(0.01), T(4) / T(3), ((T(1) + g2) * atanh_g / safe - T(1)) / sqr(safe));
        const T slope = (T(1) - g_p) * (T(1) + g_p) * bracket;
        const T step = (mean_cosine(PivotPhase<T>{g_p}) - phase.g) / slope;
        g_p = max(min(g_p - step, largest), -largest);
    }
    return {select(abs(phase.g) < T(1), g_p, phase.g)};
}

}  // namespace pivot
