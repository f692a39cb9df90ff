// The Henyey-Greenstein phase function, per steradian at mu = cos of the angle to the direction of travel.
//
// [Henyey41] Henyey and Greenstein, "Diffuse radiation in the galaxy", Astrophysical Journal 93, 1941.
// [Dupuy17]  Dupuy, Heitz, Belcour, "A Spherical Cap Preserving Parameterization for Spherical
// Distributions", 2017.
//
// All forms are sums of terms of one sign, so none loses bits at g -> 0 or g -> +-1, and none divides by g.
#pragma once

#include "core/math/number.h"
#include "core/math/vector.h"

namespace pivot {

/// g in (-1, 1) is the mean cosine.
template <class T>
struct HenyeyGreenstein {
    T g;
};

namespace detail {
/// 1 + g^2 - 2 g mu, the squared distance from g omega_o to omega.
template <class T>
T squared_distance(T g, T mu) {
    return select(g < T(0), sqr(T(1) + g) - T(2) * g * (T(1) + mu), sqr(T(1) - g) + T(2) * g * (T(1) - mu));
}
}  // namespace detail

/// [Dupuy17 (26)]
template <class T>
T eval(const HenyeyGreenstein<T>& phase, T mu) {
    const T g = phase.g, q = detail::squared_distance(g, mu);
    return T(0.25) / pi<T> * (T(1) - g) * (T(1) + g) / (q * sqrt(q));
}

/// The probability of a cosine <= mu.
template <class T>
T cdf(const HenyeyGreenstein<T>& phase, T mu) {
    const T g = phase.g, r = sqrt(detail::squared_distance(g, mu));
    return (T(1) - g) * (T(1) + mu) / (r * (T(1) + g + r));
}

/// (mu, sin) drawn by inverting the cdf at xi; its pdf per steradian is eval.
template <class T>
Vec2<T> sample_cosine(const HenyeyGreenstein<T>& phase, T xi) {
    const T g = phase.g, rest = T(1) - xi;
    const T scale = (T(1) - g) * rest + (T(1) + g) * xi;
    const T r = (T(1) - g) * (T(1) + g) / scale;
    const T one_plus_mu = (T(1) + g) * xi * (T(1) + g + r) / scale;
    const T one_minus_mu = (T(1) - g) * rest * (r + T(1) - g) / scale;
    return {(one_plus_mu - one_minus_mu) * T(0.5), sqrt(one_plus_mu * one_minus_mu)};
}

template <class T>
T mean_cosine(const HenyeyGreenstein<T>& phase) {
    return phase.g;
}

}  // namespace pivot
