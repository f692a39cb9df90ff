// Spherical pivot transformed distributions: eval, integrate, sample, pdf.
//   [Dupuy17] "A Spherical Cap Preserving Parameterization for Spherical Distributions", Sec 4
//
// D(omega) = D_std(g(omega)) dg/domega for D_std uniform over the sphere, or a clamped cosine about `cosine_axis`. As g
// turns the sphere around (r_p = 0 is the antipodal map), a cosine's axis must face away from the lobe it is to make.
#pragma once

#include "core/distributions/cap_region.h"
#include "core/distributions/pivot_transform.h"

namespace pivot {

template <class T, size_t N>
std::array<Cap<T>, N> transform(const Pivot<T>& pivot, std::array<Cap<T>, N> caps) {
    for (Cap<T>& cap : caps) cap = transform(pivot, cap);
    return caps;
}

// ---- D_std uniform: an SPTD is the density of its own samples, and so its pdf
// ----------------------------------------

template <class T>
T eval_uniform(const Pivot<T>& pivot, const Vec3<T>& omega) {
    return jacobian(pivot, omega) / (T(4) * pi<T>);
}

/// [Dupuy17 (10)]
template <class T>
T integrate_uniform(const Pivot<T>& pivot, const Cap<T>& cap) {
    return transform_versines(pivot, cap).x * T(0.5);
}

/// Over the intersection of two caps, such as a light and the hemisphere [Dupuy17 (17-19)]: the images' rims cross at
/// the caps' own angle, which keeps its bits however small the pivot makes them.
template <class T>
T integrate_uniform(const Pivot<T>& pivot, const Cap<T>& cap1, const Cap<T>& cap2) {
    const RimCrossing<T> cross = rim_crossing(cap1.versine, cap2.versine, separation(cap1.axis, cap2.axis));
    return intersection_solid_angle(transform_versines(pivot, cap1), transform_versines(pivot, cap2), cross) /
           (T(4) * pi<T>);
}

/// Over the intersection of three caps, such as light, bent cone [Dupuy17 (23)] and hemisphere.
template <class T>
T integrate_uniform(const Pivot<T>& pivot, const std::array<Cap<T>, 3>& caps) {
    return intersection_solid_angle(transform(pivot, caps)) / (T(4) * pi<T>);
}

template <class T>
Vec3<T> sample_uniform(const Pivot<T>& pivot, const Vec2<T>& u) {
    return transform(pivot, sample(Cap<T>{pivot.direction, T(2)}, u));
}

/// From D inside the cap.
template <class T>
Vec3<T> sample_uniform(const Pivot<T>& pivot, const Cap<T>& cap, const Vec2<T>& u) {
    return transform(pivot, sample(transform(pivot, cap), u));
}

/// Of a direction known to lie in the cap: the samples of a tiny cap, once rounded, may not.
template <class T>
T pdf_omega_uniform_inside(const Pivot<T>& pivot, const Cap<T>& cap, const Vec3<T>& omega) {
    return jacobian(pivot, omega) / solid_angle(transform(pivot, cap));
}

template <class T>
T pdf_omega_uniform(const Pivot<T>& pivot, const Cap<T>& cap, const Vec3<T>& omega) {
    return select(contains(cap, omega), pdf_omega_uniform_inside(pivot, cap, omega), T(0));
}

/// From D inside both caps. Branches: for float and double only.
template <class T>
Vec3<T> sample_uniform(const Pivot<T>& pivot, const Cap<T>& cap1, const Cap<T>& cap2, const Vec2<T>& u) {
    return transform(pivot, sample_intersection(transform(pivot, cap1), transform(pivot, cap2), u));
}

template <class T>
T pdf_omega_uniform(const Pivot<T>& pivot, const Cap<T>& cap1, const Cap<T>& cap2, const Vec3<T>& omega) {
    const T whole = integrate_uniform(pivot, cap1, cap2);
    return contains(cap1, omega) && contains(cap2, omega) && whole > T(0) ? eval_uniform(pivot, omega) / whole : T(0);
}

// ---- D_std a clamped cosine about `cosine_axis`
// ----------------------------------------------------------------------

/// Also the pdf of sample_cosine over the sphere.
template <class T>
T eval_cosine(const Pivot<T>& pivot, const Vec3<T>& cosine_axis, const Vec3<T>& omega) {
    return max(dot(transform(pivot, omega), cosine_axis), T(0)) * jacobian(pivot, omega) / pi<T>;
}

template <class T>
T integrate_cosine(const Pivot<T>& pivot, const Vec3<T>& cosine_axis, const Cap<T>& cap) {
    return clamped_cosine_integral(transform(pivot, cap), cosine_axis) / pi<T>;
}

/// Over the intersection of two or three caps. Branches: for float and double only.
template <class T, size_t N>
T integrate_cosine(const Pivot<T>& pivot, const Vec3<T>& cosine_axis, const std::array<Cap<T>, N>& caps) {
    return clamped_cosine_integral(transform(pivot, caps), cosine_axis) / pi<T>;
}

template <class T>
Vec3<T> sample_cosine(const Pivot<T>& pivot, const Vec3<T>& cosine_axis, const Vec2<T>& u) {
    const T radius = sqrt(u.x), phi = T(2) * pi<T> * u.y;
    const Vec3<T> local(radius * cos(phi), radius * sin(phi), sqrt(T(1) - u.x));
    return transform(pivot, frame_from_z(cosine_axis).to_world(local));
}

/// From D inside one to three caps. Branches: for float and double only.
template <class T, size_t N>
Vec3<T> sample_cosine(const Pivot<T>& pivot, const Vec3<T>& cosine_axis, const std::array<Cap<T>, N>& caps,
                      const Vec2<T>& u) {
    return transform(pivot, sample_clamped_cosine(transform(pivot, caps), cosine_axis, u));
}

template <class T, size_t N>
T pdf_omega_cosine(const Pivot<T>& pivot, const Vec3<T>& cosine_axis, const std::array<Cap<T>, N>& caps,
                   const Vec3<T>& omega) {
    for (const Cap<T>& cap : caps)
        if (!contains(cap, omega)) return T(0);
    const T whole = integrate_cosine(pivot, cosine_axis, caps);
    return whole > T(0) ? eval_cosine(pivot, cosine_axis, omega) / whole : T(0);
}

}  // namespace pivot
