// Phase functions over a spherical cap: what a medium scatters of a sphere light.
#pragma once

#include "core/math/quadrature.h"
#include "core/media/phase.h"

namespace pivot {

/// Henyey-Greenstein's integral over a cap, in [0, 1], to half a percent. omega_o: the direction of travel.
///
/// A cap that is small beside the width is a matter of the pivot phase function, by how much the two differ at the
/// cap's axis. Else by rings around omega_o: those that lie in the cap whole are the cdf's, and of those that its rim
/// cuts the share within is integrated over the cdf, in which no peak is left.
template <class T>
T integrate(const HenyeyGreenstein<T>& phase, const Vec3<T>& omega_o, const Cap<T>& cap) {
    const T half_pi = T(0.5) * pi<T>;
    const T cos_axis = min(max(dot(cap.axis, omega_o), T(-1)), T(1));
    const T theta = T(2) * atan2(length(cap.axis - omega_o), length(cap.axis + omega_o));
    const T psi = T(2) * atan2(sqrt(cap.versine), sqrt(max(T(2) - cap.versine, T(0))));

    const T nearest = max(theta - psi, T(0)), farthest = min(theta + psi, pi<T>);
    const T peak2 = detail::squared_distance(phase.g, cos(select(phase.g < T(0), farthest, nearest)));
    const Mask<T> is_small = abs(phase.g) * sqr(psi) < T(0.01) * peak2;

    const PivotPhase<T> proxy = pivot_phase_like(phase);
    const T scaled = integrate(proxy, omega_o, cap) * eval(phase, cos_axis) / max(eval(proxy, cos_axis), tiny<T>);

    const T ahead = T(1) - cdf(phase, cos(max(psi - theta, T(0))));
    const T behind = cdf(phase, cos(min(T(2) * pi<T> - theta - psi, pi<T>)));
    const T low = select(theta + psi > pi<T>, behind, cdf(phase, cos(farthest)));
    const T high = select(theta < psi, T(1) - ahead, cdf(phase, cos(abs(theta - psi))));
    const T cos_psi = T(1) - cap.versine, sin_axis = sin(theta);
    T rim(0);
    for (const GaussNode& node : gauss_rule<16>) {
        const T x = T(0.5) * (low + high) + T(0.5) * T(node.sine) * (high - low);
        const Vec2<T> ring = sample_cosine(phase, x);
        const T cosine = (cos_psi - ring.x * cos_axis) / max(ring.y * sin_axis, tiny<T>);
        rim += T(0.25) * T(node.sine_weight) * (half_pi - asin(min(max(cosine, T(-1)), T(1))));
    }
    const T by_rings = select(theta < psi, ahead, T(0)) + select(theta + psi > pi<T>, behind, T(0)) +
                       rim * (T(2) / pi<T>)*max(high - low, T(0));
    return select(is_small, scaled, min(by_rings, T(1)));
}

/// Of any phase function, as precisely.
template <class T>
T integrate_precisely(const Phase& phase, const Vec3<T>& omega_o, const Cap<T>& cap) {
    switch (phase.kind) {
        case PhaseKind::henyey_greenstein:
            return integrate(HenyeyGreenstein<T>{T(phase.g)}, omega_o, cap);
        case PhaseKind::pivot:
            return integrate(PivotPhase<T>{T(phase.g)}, omega_o, cap);
    }
    return T(0);
}

}  // namespace pivot
