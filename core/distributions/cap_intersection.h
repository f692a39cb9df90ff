// The intersection of two spherical caps: solid angle, exact and approximate, and uniform sampling.
//   [Dupuy17] "A Spherical Cap Preserving Parameterization for Spherical Distributions", Appendix B
//
// Departures from [Dupuy17]:
// - Eq 35-36 miss psi1 + psi2 + psi_d >= 2 pi, where the caps cover the sphere between them. Here caps beyond a
//   hemisphere are replaced by their complements first, which leaves no such case.
// - Eq 36 cancels for small caps (float32 is off by 19x at 1e-2 rad). Here the intersection is the sum of the two
// segments
//   that the geodesic between the rims' crossings cuts off, each integrated or rewritten where it would cancel.
#pragma once

#include "core/distributions/cap.h"

namespace pivot {

/// The angle between two directions, as the versines to the one and to the other's antipode, and the cosine.
template <class T>
struct Separation {
    T versine, opposite_versine, cosine;
};

template <class T>
Separation<T> separation(const Vec3<T>& a, const Vec3<T>& b) {
    return {length_squared(a - b) * T(0.5), length_squared(a + b) * T(0.5), dot(a, b)};
}

template <class T>
Separation<T> separation_of_angle(T angle_rad) {
    return {T(2) * sqr(sin(angle_rad * T(0.5))), T(2) * sqr(cos(angle_rad * T(0.5))), cos(angle_rad)};
}

/// What the geodesic between two points of its rim cuts off a cap of at most a hemisphere, in steradians. The points
/// are 2 alpha apart in azimuth about the axis, alpha in [0, pi].
///
/// With y = atan2(cos psi sin alpha, cos alpha) it is 2 (y - alpha cos psi); its derivative in alpha is positive.
template <class T>
T segment_solid_angle(T versine, T alpha) {
    const T h = versine, c = T(1) - h, s2 = h * (T(2) - h);
    const T sin_a = sin(alpha), cos_a = cos(alpha);
    const T narrow = c * s2 * gauss_legendre8(min(alpha, T(0.5)), [&](T t) {
                         const T sin2_t = sqr(sin(t));
                         return sin2_t / (T(1) - s2 * sin2_t);
                     });
    const T small = h * alpha - atan2(h * sin_a * cos_a, T(1) - h * sqr(sin_a));
    const T large = atan2(c * sin_a, cos_a) - c * alpha;
    return T(2) * select(alpha < T(0.5), narrow, select(h < T(0.5), small, large));
}

/// cos psi2 - cos psi1 cos psi_d, from whichever two of the versines and cosines are closest.
template <class T>
T rim_cosine(T versine1, T versine2, const Separation<T>& between) {
    const T d = between.cosine, from_axes = between.versine - versine2, from_rims = versine1 - versine2;
    const T near = select(abs(from_axes) < abs(from_rims), from_axes + versine1 * d,
                          from_rims + between.versine * (T(1) - versine1));
    return select(d > T(0.5), near, ((T(1) - versine2) - d) + versine1 * d);
}

/// Where the rim of cap 1 lies inside cap 2: within `azimuth`, in [0, pi], of the direction of axis 2 about axis 1.
/// Its cosine and sine, times sin psi1 sin psi_d, are `cosine` and `sine`.
template <class T>
struct RimInside {
    T cosine, sine, azimuth;
};

template <class T>
RimInside<T> rim_inside(T versine1, T versine2, const Separation<T>& between) {
    const T n = rim_cosine(versine1, versine2, between);
    const T r = safe_sqrt(versine1 * (T(2) - versine1) * between.versine * between.opposite_versine);
    const T g = safe_sqrt((r - n) * (r + n));
    return {n, g, select(n <= -r, pi<T>, atan2(g, n))};
}

/// The angle at which two rims cross: sin psi1 sin psi2 cosine = cos psi_d - cos psi1 cos psi2. Where they do not, sine
/// is 0, and cosine >= 1 if one cap holds the other, <= -1 if the caps are apart or cover the sphere. Pivot
/// transformations preserve it, as they do all angles.
template <class T>
struct RimCrossing {
    T cosine, sine;
};

template <class T>
RimCrossing<T> rim_crossing(T versine1, T versine2, const Separation<T>& between) {
    const T h1 = min(versine1, versine2), h2 = max(versine1, versine2);
    const T s1 = max(sqrt(h1 * (T(2) - h1)), tiny<T>), s2 = max(sqrt(h2 * (T(2) - h2)), tiny<T>);
    const RimInside<T> rim = rim_inside(h1, h2, between);
    return {(between.cosine * s1 - (T(1) - h1) * rim.cosine / s1) / s2, rim.sine / s1 / s2};
}

/// The solid angle in both of two caps, in steradians [Dupuy17 (35, 36)], each given by its own versine and that of the
/// rest of the sphere.
template <class T>
T intersection_solid_angle(const Vec2<T>& versines1, const Vec2<T>& versines2, const RimCrossing<T>& cross) {
    const auto large1 = versines1.x > versines1.y, large2 = versines2.x > versines2.y;
    const auto both = large1 && large2, one = large1 != large2;
    const T a = min(versines1.x, versines1.y), b = min(versines2.x, versines2.y);
    const T h1 = min(a, b), h2 = max(a, b), c1 = T(1) - h1, c2 = T(1) - h2;
    const T s1 = sqrt(h1 * (T(2) - h1)), s2 = sqrt(h2 * (T(2) - h2));
    const T cosine = select(one, -cross.cosine, cross.cosine), sine = cross.sine;

    // half the azimuths of rim 1 inside cap 2 and of rim 2 inside cap 1, from sin(psi1 - psi2) and 1 - cosine
    const T difference = (h1 - h2) * (T(2) - h1 - h2) / max(s1 * c2 + c1 * s2, tiny<T>);
    const T versine = select(cosine > T(0), sine * sine / (T(1) + cosine), T(1) - cosine);
    const T alpha1 = atan2(s2 * sine, difference + c1 * s2 * versine);
    const T alpha2 = atan2(s1 * sine, c2 * s1 * versine - difference);
    const T segments = segment_solid_angle(h1, alpha1) + segment_solid_angle(h2, alpha2);
    const T direct = T(2) * (atan2(sine, -cosine) - c1 * alpha1 - c2 * alpha2);
    const T crossing = max(select(h1 > T(0.5), direct, segments), T(0));
    const T inner = select(sine > T(0), crossing, select(cosine > T(0), T(2) * pi<T> * h1, T(0)));

    const T whole = select(large1, versines2.x, versines1.x);
    const T rest = select(both, versines1.x - versines2.y, select(one, whole, T(0)));
    return max(T(2) * pi<T> * rest + select(one, -inner, inner), T(0));
}

template <class T>
T intersection_solid_angle(T versine1, T versine2, const Separation<T>& between) {
    return intersection_solid_angle(Vec2<T>(versine1, T(2) - versine1), Vec2<T>(versine2, T(2) - versine2),
                                    rim_crossing(versine1, versine2, between));
}

template <class T>
T intersection_solid_angle(const Cap<T>& cap1, const Cap<T>& cap2) {
    return intersection_solid_angle(cap1.versine, cap2.versine, separation(cap1.axis, cap2.axis));
}

/// The smooth approximation [Dupuy17 (37, 38)]: exact where one cap holds the other or they are apart.
template <class T>
T intersection_solid_angle_approximate(T versine1, T versine2, const Separation<T>& between) {
    const T h = min(versine1, versine2), larger = max(versine1, versine2);
    const T psi1 = angle_of_versine(h, T(2) - h), psi2 = angle_of_versine(larger, T(2) - larger);
    const T psi_d = angle_of_versine(between.versine, between.opposite_versine);
    const T x = clamp01((psi1 + psi2 - psi_d) * T(0.5) * inverse(max(psi1, tiny<T>)));
    return T(2) * pi<T> * h * x * x * (T(3) - T(2) * x);
}

template <class T>
T intersection_solid_angle_approximate(const Cap<T>& cap1, const Cap<T>& cap2) {
    return intersection_solid_angle_approximate(cap1.versine, cap2.versine, separation(cap1.axis, cap2.axis));
}

/// A direction inside both caps, uniform in solid angle over their intersection; where that is empty, an axis.
///
/// The rings about the smaller cap's axis are picked by inverting the solid angle of (ring's cap) and (larger cap),
/// whose derivative in the ring's versine is 2 azimuth; then the azimuth is uniform. Branches: for float and double
/// only.
template <class T>
Vec3<T> sample_intersection(const Cap<T>& cap1, const Cap<T>& cap2, const Vec2<T>& u) {
    const bool first = cap1.versine <= cap2.versine;
    const Cap<T>&inner = first ? cap1 : cap2, &outer = first ? cap2 : cap1;
    const Separation<T> between = separation(inner.axis, outer.axis);
    const T whole = intersection_solid_angle(inner.versine, outer.versine, between), wanted = u.x * whole;
    const T rounding = T(2) * std::numeric_limits<T>::epsilon();

    T low = T(0), high = inner.versine, versine = inner.versine * u.x;
    for (int i = 0; i < 60; ++i) {
        const T excess = intersection_solid_angle(versine, outer.versine, between) - wanted;
        const T slope = T(2) * rim_inside(versine, outer.versine, between).azimuth;
        if (slope > T(0) && abs(excess) <= rounding * whole) break;
        (excess > T(0) ? high : low) = versine;
        const T newton = slope > T(0) ? versine - excess / slope : low;
        const T next = newton > low && newton < high ? newton : (low + high) / T(2);
        const T step = abs(next - versine);
        versine = next;
        if (step <= rounding * versine) break;
    }
    const T phi = (T(2) * u.y - T(1)) * rim_inside(versine, outer.versine, between).azimuth;
    const T radius = safe_sqrt(versine * (T(2) - versine));
    return frame_from_z(inner.axis, outer.axis).to_world({radius * cos(phi), radius * sin(phi), T(1) - versine});
}

/// The density of sample_intersection, which is 1 over the solid angle of the intersection inside it.
template <class T>
T pdf_omega_intersection(const Cap<T>& cap1, const Cap<T>& cap2, const Vec3<T>& omega) {
    const T size = intersection_solid_angle(cap1, cap2);
    return contains(cap1, omega) && contains(cap2, omega) && size > T(0) ? T(1) / size : T(0);
}

}  // namespace pivot
