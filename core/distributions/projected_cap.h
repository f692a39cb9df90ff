// Sampling spherical caps by projected solid angle, for diffuse surfaces under sphere lights.
//   [Peters19] "Sampling Projected Spherical Caps in Real Time" and its supplementary document
//
// Along the normal, the cap's rim projects to an ellipse and the horizon to the unit circle. Case 1, all above the
// horizon: the ellipse is sampled uniformly. Case 2, axis above: the ellipse and the disk, on either side of their
// tangent points, uniformly. Case 3, axis below: what is left between ellipse and circle is a warped part of a disk,
// whose density is uniform within `density_ratio_bound`.
//
// Departures from [Peters19]: with z the axis' cosine and g^2 = sin^2 psi - z^2, the warp's scale along y simplifies to
// s_y^2 = (1 + kappa zeta) / (1 + zeta), where zeta = d_z / t_y, kappa = (c_z + r_z) / (r_z - c_z) and c_z + r_z =
// g^2 / (r_z - c_z); heights come from the rim's plane, not from 1 - x^2 - y^2. So small caps near the horizon keep
// their bits. The maximum of the bound (Eq 4) over all elevations is at the root of a cubic: no grid is searched.
#pragma once

#include "core/distributions/cap.h"

namespace pivot {

/// A cap of at most a hemisphere, in the frame whose z is the normal and whose x points to the axis along the horizon.
template <class T>
struct ProjectedCap {
    Frame<T> frame;
    T versine, x, z;            // of the cap; its axis is (x, 0, z)
    T r_x, r_y, r_z, c_x, c_z;  // extents and centre of the rim [Peters19 suppl. 1]; r_x < 0 in case 3
    T t_x, t_y;                 // where rim and horizon meet; t_x >= 1 and t_y = 0 if they do not
    T rise, kappa;              // case 3: c_z + r_z, and that over r_z - c_z
    T ellipse, disk;            // areas of the ellipse's part of the unit disk (not scaled), and of the cut disk
    T area;                     // the projection's in cases 1 and 2; the cut disk's in case 3
};

/// phi - sin phi cos phi: the area of the part of the unit disk beyond x = cos phi.
template <class T>
T cut_disk_area(T phi) {
    return x_minus_sin(T(2) * phi) * T(0.5);
}

/// The inverse of cut_disk_area, for areas in [0, pi], by Halley's method from its leading term 2 phi^3 / 3.
template <class T>
T cut_disk_angle(T area) {
    const T half = min(area, pi<T> - area);
    T phi = std::cbrt(T(1.5) * max(half, T(0)));
    for (int i = 0; i < 4; ++i) {
        const T sine = max(sin(phi), tiny<T>), f = cut_disk_area(phi) - half;
        phi -= f / max(T(2) * sine * sine - f * cos(phi) / sine, tiny<T>);
    }
    return select(area > half, pi<T> - phi, phi);
}

template <class T>
ProjectedCap<T> projected_cap(const Cap<T>& cap, const Vec3<T>& normal) {
    ProjectedCap<T> p;
    p.frame = frame_from_z(normal, cap.axis);
    p.versine = cap.versine;
    p.x = max(dot(cap.axis, p.frame.x), T(0));
    p.z = dot(cap.axis, normal);
    const T cos_psi = T(1) - cap.versine;
    p.r_y = safe_sqrt(sin2_half_angle(cap));
    p.r_x = p.z * p.r_y;
    p.r_z = p.x * p.r_y;
    p.c_x = p.x * cos_psi;
    p.c_z = p.z * cos_psi;
    const T g = safe_sqrt((p.r_y - p.z) * (p.r_y + p.z));
    p.t_x = cos_psi / max(p.x, tiny<T>);
    p.t_y = g / max(p.x, tiny<T>);
    p.rise = g * g / max(p.r_z - p.c_z, tiny<T>);
    p.kappa = p.rise / max(p.r_z - p.c_z, tiny<T>);

    p.disk = cut_disk_area(atan2(p.t_y, p.t_x));
    // the ellipse ends at the disk coordinate (t_x - c_x) / r_x = cos psi z / (sin psi x)
    p.ellipse = select(p.z >= p.r_y, pi<T>, cut_disk_area(atan2(g, -cos_psi * p.z)));
    p.area = select(p.z < T(0), p.disk, p.r_x * p.r_y * p.ellipse + select(p.z >= p.r_y, T(0), p.disk));
    return p;
}

/// The exact bound of max density / min density over a cap in case 3 [Peters19 suppl. (4)], with x = -c_z / c_x and
/// q = cos psi / sin psi. 1 in the other cases.
template <class T>
T density_ratio_bound(T x, T q) {
    return (q + x) * sqrt(T(1) + q * x) / (q * (T(1) + x * x));
}

template <class T>
T density_ratio_bound(const ProjectedCap<T>& p) {
    const T bound = density_ratio_bound(-p.z / max(p.x, tiny<T>), (T(1) - p.versine) / max(p.r_y, tiny<T>));
    return select(-p.z > T(0) && -p.z < p.r_y, bound, T(1));
}

/// The maximum of that bound over all elevations of a sphere at `inverse_sine` = distance / radius > 1: sqrt(2) from 2
/// on. Its x is the positive root of q x^3 + (3 q^2 + 2) x^2 + q x - (q^2 + 2), but at most 1/q, where the cap is
/// below.
template <class T>
T worst_density_ratio_bound(T inverse_sine) {
    const T q = sqrt((inverse_sine - T(1)) * (inverse_sine + T(1)));
    T x = T(1);
    for (int i = 0; i < 8; ++i) {  // Newton from above: the cubic is convex there
        const T f = ((q * x + T(3) * q * q + T(2)) * x + q) * x - (q * q + T(2));
        x -= f / ((T(3) * q * x + T(6) * q * q + T(4)) * x + q);
    }
    return density_ratio_bound(min(x, T(1) / q), q);
}

/// A point of case 3: a direction in the frame, and its density with respect to projected solid angle.
template <class T>
struct WarpedPoint {
    Vec3<T> omega;
    T density;
};

/// The warp of case 3 from the cut disk [Peters19 suppl. 2]: d is a unit vector whose projection lies in it, d_x <=
/// -t_x.
template <class T>
WarpedPoint<T> warp(const ProjectedCap<T>& p, const Vec3<T>& d) {
    const T zeta = min(d.z / max(p.t_y, tiny<T>), T(1));
    const T scale = sqrt((T(1) + p.kappa * zeta) / (T(1) + zeta));
    const T y = scale * d.y, z = p.rise * zeta, x = safe_sqrt(T(1) - y * y - z * z);
    const T density = sqr(p.t_y / max(p.rise, tiny<T>)) * x / max(-d.x * scale * p.area, tiny<T>);
    return {{x, y, z}, density};
}

/// The inverse of the warp.
template <class T>
Vec3<T> unwarp(const ProjectedCap<T>& p, const Vec3<T>& omega) {
    const T zeta = clamp01(omega.z / max(p.rise, tiny<T>));
    const T z = zeta * p.t_y, y = omega.y / sqrt((T(1) + p.kappa * zeta) / (T(1) + zeta));
    return {-safe_sqrt(T(1) - y * y - z * z), y, z};
}

namespace detail {

/// The point of a cut disk at u, as (cos phi, y, height of the sphere above it): u.x by area from the rim inwards.
template <class T>
Vec3<T> cut_disk_point(T area, const Vec2<T>& u) {
    const T phi = cut_disk_angle(area * u.x), sine = sin(phi);
    return {cos(phi), (T(2) * u.y - T(1)) * sine, T(2) * sine * safe_sqrt(u.y * (T(1) - u.y))};
}

template <class T>
Vec2<T> cut_disk_invert(T area, const Vec3<T>& d) {
    const T sine = sqrt(d.y * d.y + d.z * d.z);
    return {cut_disk_area(atan2(sine, d.x)) / max(area, tiny<T>), (T(1) + d.y / max(sine, tiny<T>)) * T(0.5)};
}

/// The point of the cap above disk coordinates d, d.z^2 = 1 - d.x^2 - d.y^2.
template <class T>
Vec3<T> lift(const ProjectedCap<T>& p, const Vec3<T>& d) {
    const T plane = p.c_z - p.r_z * d.x, above = p.r_y * d.z;
    return {p.c_x + p.r_x * d.x, p.r_y * d.y, sqrt(plane * plane + above * above)};
}

/// The inverse of lift: omega is (omega . axis - cos psi) / z above the rim's plane.
template <class T>
Vec3<T> unlift(const ProjectedCap<T>& p, const Vec3<T>& omega) {
    const Vec3<T> offset = omega - Vec3<T>(p.x, T(0), p.z);
    const T above = (p.versine - length_squared(offset) * T(0.5)) / max(p.z, tiny<T>);
    const T x = (offset.x * p.z - offset.z * p.x + above * p.x) / max(p.r_y, tiny<T>),
            y = omega.y / max(p.r_y, tiny<T>);
    return {x, y, safe_sqrt(T(1) - x * x - y * y)};
}

}  // namespace detail

/// A direction in the cap and above the horizon, in the space of cap and normal; if there is none, one on the horizon.
/// Branches: for float and double only.
template <class T>
Vec3<T> sample(const ProjectedCap<T>& p, const Vec2<T>& u) {
    if (p.z >= p.r_y) {
        const T radius = sqrt(u.x), phi = T(2) * pi<T> * u.y;
        return p.frame.to_world(detail::lift(p, Vec3<T>(radius * cos(phi), radius * sin(phi), safe_sqrt(T(1) - u.x))));
    }
    if (p.z < T(0)) {
        const Vec3<T> d = detail::cut_disk_point(p.disk, u);
        return p.frame.to_world(warp(p, Vec3<T>(-d.x, d.y, d.z)).omega);
    }
    const T split = T(1) - p.disk / p.area;
    if (u.x < split) {
        const Vec3<T> d = detail::cut_disk_point(p.ellipse, Vec2<T>(u.x / split, u.y));
        return p.frame.to_world(detail::lift(p, Vec3<T>(-d.x, d.y, d.z)));
    }
    return p.frame.to_world(detail::cut_disk_point(p.disk, Vec2<T>((u.x - split) / (T(1) - split), u.y)));
}

/// The inverse of sample: the u of a direction in the cap and above the horizon.
template <class T>
Vec2<T> invert(const ProjectedCap<T>& p, const Vec3<T>& omega) {
    const Vec3<T> local = p.frame.to_local(omega);
    if (p.z >= p.r_y) {
        const Vec3<T> d = detail::unlift(p, local);
        const T turns = atan2(d.y, d.x) / (T(2) * pi<T>);
        return {min(d.x * d.x + d.y * d.y, T(1)), turns < T(0) ? turns + T(1) : turns};
    }
    if (p.z < T(0)) {
        const Vec3<T> d = unwarp(p, local);
        return detail::cut_disk_invert(p.disk, Vec3<T>(-d.x, d.y, d.z));
    }
    const T split = T(1) - p.disk / p.area;
    if (local.x < p.t_x) {
        const Vec3<T> d = detail::unlift(p, local);
        const Vec2<T> u = detail::cut_disk_invert(p.ellipse, Vec3<T>(-d.x, d.y, d.z));
        return {min(u.x, T(1)) * split, u.y};
    }
    const Vec2<T> u = detail::cut_disk_invert(p.disk, local);
    return {split + min(u.x, T(1)) * (T(1) - split), u.y};
}

/// The density of sample with respect to solid angle, of a direction known to lie in the cap: the samples of a tiny<T>
/// cap, once rounded, may not.
template <class T>
T pdf_omega_inside(const ProjectedCap<T>& p, const Vec3<T>& omega) {
    const Vec3<T> local = p.frame.to_local(omega);
    if (local.z <= T(0) || p.z <= -p.r_y) return T(0);
    return local.z * (p.z < T(0) ? warp(p, unwarp(p, local)).density : T(1) / p.area);
}

/// The density of sample with respect to solid angle.
template <class T>
T pdf_omega(const ProjectedCap<T>& p, const Vec3<T>& omega) {
    const Vec3<T> axis(p.x, T(0), p.z);
    const bool inside = length_squared(p.frame.to_local(omega) - axis) <= T(2) * p.versine;
    return inside ? pdf_omega_inside(p, omega) : T(0);
}

}  // namespace pivot
