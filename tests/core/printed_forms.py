"""The seed papers' formulas exactly as printed, in float32: what the stability table shows beside the engine's forms.

[Dupuy17] A Spherical Cap Preserving Parameterization for Spherical Distributions
[Heitz16] LTC supplement, properties of LTSDs   [Peters19] Sampling Projected Spherical Caps, supplement
[Tokuyoshi15] Virtual Spherical Gaussian Lights, supplement   [Wakapon] orthographic pixels, Eq 2

Each takes the arguments of pivot_core.distributions' function of its name; the angles and points that the paper starts
from are rounded to float32 first, all that follows is float32.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import pivot_core.distributions as pd

F = np.float32
PI = F(np.pi)
Array = Any


def single(value: Array) -> Array:
    return np.asarray(value, F)


def angle(versine: Array) -> Array:
    """psi of a cap, correctly rounded."""
    return F(2 * np.arcsin(np.sqrt(np.float64(versine) / 2)))


def pivot(direction: Array, delta: Array) -> Array:
    """r_p, correctly rounded."""
    return single((1 - np.float64(delta)) * np.asarray(direction, np.float64))


def cap_solid_angle(versine: Array) -> Array:
    """[Dupuy17 (5)]"""
    return F(2) * PI * (F(1) - np.cos(angle(versine)))


def pivot_point(r: Array, r_p: Array) -> Array:
    """[Dupuy17 (2)]"""
    d, side = np.dot(r, r_p) - F(1), np.cross(r, r_p)
    return (d * (r - r_p) - np.cross(r - r_p, side)) / (d * d + np.dot(side, side))


def pivot_transform(omega: Array, direction: Array, delta: Array) -> Array:
    return pivot_point(single(omega), pivot(direction, delta))


def pivot_jacobian(omega: Array, direction: Array, delta: Array) -> Array:
    """[Dupuy17 (4)]"""
    r_p = pivot(direction, delta)
    difference = single(omega) - r_p
    return ((F(1) - np.dot(r_p, r_p)) / np.dot(difference, difference)) ** 2


def sptd_uniform_eval(omega: Array, direction: Array, delta: Array) -> Array:
    """[Dupuy17 (8)]"""
    return pivot_jacobian(omega, direction, delta) / (F(4) * PI)


def boundary_cap(axis: Array, versine: Array, direction: Array, delta: Array) -> tuple[Array, Array]:
    """g(cap) as axis and psi by the boundary's two points in the plane of axis and pivot. [Dupuy17 (6-7)]"""
    axis, r_p, psi = single(axis), pivot(direction, delta), angle(versine)
    across = r_p - np.dot(r_p, axis) * axis
    across = across / np.sqrt(np.dot(across, across))
    one, two = (pivot_point(np.cos(psi) * axis + sign * np.sin(psi) * across, r_p) for sign in (F(1), F(-1)))
    mean = one + two
    mean = mean / np.sqrt(np.dot(mean, mean))
    return mean, np.arccos(np.dot(mean, one))


def pivot_transform_cap(axis: Array, versine: Array, direction: Array, delta: Array) -> tuple[Array, Array]:
    mean, psi = boundary_cap(axis, versine, direction, delta)
    return mean, F(1) - np.cos(psi)


def sptd_uniform_integral(axis: Array, versine: Array, direction: Array, delta: Array) -> Array:
    """[Dupuy17 (5, 10)]"""
    return (F(1) - np.cos(boundary_cap(axis, versine, direction, delta)[1])) / F(2)


def cap_intersection_at(versine1: Array, versine2: Array, separation: Array) -> Array:
    """[Dupuy17 (35-36)]"""
    return overlap(angle(versine1), angle(versine2), F(separation))


def cap_intersection(axis1: Array, versine1: Array, axis2: Array, versine2: Array) -> Array:
    return overlap(angle(versine1), angle(versine2), np.arccos(np.dot(single(axis1), single(axis2))))


def overlap(psi1: Array, psi2: Array, psi_d: Array) -> Array:
    psi1, psi2 = min(psi1, psi2), max(psi1, psi2)
    if psi2 - psi1 >= psi_d:
        return F(2) * PI * (F(1) - np.cos(psi1))
    if psi1 + psi2 <= psi_d:
        return F(0)
    (c1, c2, cd), (s1, s2, sd) = np.cos([psi1, psi2, psi_d]), np.sin([psi1, psi2, psi_d])
    return (
        F(2) * PI * (F(1) - c1 - c2)
        - F(2) * np.arccos((cd - c1 * c2) / (s1 * s2))
        + F(2) * c1 * np.arccos((c1 * cd - c2) / (s1 * sd))
        + F(2) * c2 * np.arccos((c2 * cd - c1) / (s2 * sd))
    )


def sptd_uniform_integral2(
    axis1: Array, versine1: Array, axis2: Array, versine2: Array, direction: Array, delta: Array
) -> Array:
    """[Dupuy17 (17-19)]: both caps mapped, their images' overlap."""
    (one, psi1), (two, psi2) = (
        boundary_cap(axis, versine, direction, delta) for axis, versine in ((axis1, versine1), (axis2, versine2))
    )
    return overlap(psi1, psi2, np.arccos(np.dot(one, two))) / (F(4) * PI)


def henyey_greenstein_eval(g: Array, mu: Array) -> Array:
    """[Dupuy17 (26)]"""
    g, mu = F(g), F(mu)
    return (F(1) - g * g) / (F(1) + g * g - F(2) * g * mu) ** F(1.5) / (F(4) * PI)


def pivot_phase_eval(g_p: Array, mu: Array) -> Array:
    """[Dupuy17 (25)]"""
    g_p, mu = F(g_p), F(mu)
    return ((F(1) - g_p * g_p) / (F(1) + g_p * g_p - F(2) * g_p * mu)) ** 2 / (F(4) * PI)


def pivot_phase_like(g: Array) -> Array:
    """[Dupuy17 (27-28)], with the denominator's + 0.0223 as printed."""
    u = np.abs(F(g))
    return np.sign(F(g)) * (F(0.7489) * u - F(0.6121) * u * u) / (F(1) - F(0.8409) * u + F(0.0223) * u * u)


def ltsd_eval(base: str, m: Array, omega: Array) -> Array:
    """[Heitz16, 2.1]"""
    inverse = np.linalg.inv(single(m))
    original = inverse @ single(omega)
    length = np.sqrt(np.dot(original, original))
    z = max(F(0), original[2] / length)
    density = {
        "uniform_sphere": F(1) / (F(4) * PI),
        "uniform_hemisphere": F(z > 0) / (F(2) * PI),
        "clamped_cosine": z / PI,
        "squared_clamped_cosine": F(3) * z * z / (F(2) * PI),
    }[base]
    return density * np.abs(np.linalg.det(inverse)) / length**3


def sg_ggx_lobe(alpha: Array, wo: Array) -> tuple[Array, Array]:
    """[Tokuyoshi15, App. A]: sharpness 2 / alpha^2 about the half vector, warped to the reflected direction."""
    wo, n = single(wo), np.array([0, 0, 1], F)
    return F(2) * np.dot(wo, n) * n - wo, F(2) / (F(alpha) * F(alpha)) / (F(4) * np.abs(np.dot(wo, n)))


def orthographic_pixel_solid_angle(x0: Array, x1: Array, y0: Array, y1: Array) -> Array:
    """[Wakapon (2)]: the difference of four corners' areas, not defined beyond the rim."""

    def corner(x: Array, y: Array) -> Array:
        s = np.sqrt(F(1) - x * x - y * y)
        half = np.arctan((F(1) - x - y * y) / (y * s)) - np.arctan((F(1) + x - y * y) / (y * s))
        return y * np.arctan(x / s) + x * np.arctan(y / s) + half / F(2)

    x0, x1, y0, y1 = F(x0), F(x1), F(y0), F(y1)
    return corner(x1, y1) + corner(x0, y0) - corner(x0, y1) - corner(x1, y0)


def projected_cap_density_bound(axis: Array, versine: Array, normal: Array) -> Array:
    """[Peters19 suppl. (4)]"""
    z, r_y = np.dot(single(axis), single(normal)), np.sin(angle(versine))
    x = np.sqrt(F(1) - z * z)
    center = np.sqrt(F(1) - r_y * r_y)
    r_x, c_x, t_x = z * r_y, center * x, center / x
    return (c_x - r_x) / t_x * np.sqrt((t_x - (c_x + r_x)) / -r_x)


def printed_form(function: Any) -> Any:
    """Of a function of pivot_core.distributions; None where the seeds print none."""
    return _FORMS.get(function)


_FORMS = {
    getattr(pd, form.__name__): form
    for form in (
        cap_solid_angle, cap_intersection, cap_intersection_at, pivot_transform, pivot_jacobian, pivot_transform_cap,
        sptd_uniform_eval, sptd_uniform_integral, sptd_uniform_integral2, henyey_greenstein_eval, pivot_phase_eval,
        pivot_phase_like, ltsd_eval, sg_ggx_lobe, orthographic_pixel_solid_angle, projected_cap_density_bound,
    )
}  # fmt: skip
