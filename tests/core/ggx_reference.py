"""GGX under a cap or a spherical Gaussian of light by brute force: what the analytic integrator's rules are held
against.

Under a cap, directions are spread over the exact core's disk (tested by the oracles), or the horizon's where the light
surrounds -wo, and each is asked whether it is in the light and above the surface: no part of the rules under test.
"""

from __future__ import annotations

import numpy as np
import pivot_core.bsdf as bsdf
import pivot_core.distributions as pd
from numpy.typing import NDArray

Floats = NDArray[np.float64]
UP = np.array([0.0, 0.0, 1.0])
LEAST_VALUE = 1e-3  # errors are relative to max(value, this share of the light's radiance)


def disk_grid(resolution: int) -> tuple[Floats, Floats]:
    """Points u of the unit square, (n, 2), crowded at the disk's middle and rim, and their weights, (n,)."""
    x = (np.arange(resolution) + 0.5) / resolution
    smooth = x**3 * (10 - 15 * x + 6 * x * x)
    weight = 30 * (x * (1 - x)) ** 2 / resolution**2
    u = np.stack(np.meshgrid(smooth, x, indexing="ij"), -1).reshape(-1, 2)
    return u, np.repeat(weight, resolution)


def ggx_under_cap(alpha: float, wo: Floats, axis: Floats, half_angle: float, resolution: int = 600) -> float:
    """The integral of D G2 / (4 cos_o) over the cap's part above the surface."""
    versine = 2 * np.sin(half_angle / 2) ** 2
    if axis[2] <= -np.sin(half_angle):
        return 0.0
    surrounds = np.sum((wo + axis) ** 2) / 2 <= 1.02 * versine
    below_h = not pd.ggx_cap_integral(wo, axis, versine, alpha, alpha)[1]
    chart, chart_versine = (UP, 1.0) if surrounds or below_h else (axis, versine)
    u, share = disk_grid(resolution)
    wi, weight, _ = pd.ggx_cap_sample(wo, chart, chart_versine, alpha, alpha, u)
    inside = (np.sum((wi - axis) ** 2, -1) <= 2 * versine * (1 + 1e-12)) & (wi[:, 2] > 0)
    wi, weight = wi[inside], (share * weight)[inside]
    g2 = bsdf.ggx_eval(alpha, wo, wi) / ndf_term(alpha, wo, wi)
    return float(np.sum(weight * g2))


def ndf_term(alpha: float, wo: Floats, wi: Floats) -> Floats:
    """D(h) / (4 cos_o)."""
    h = wo + wi
    h /= np.linalg.norm(h, axis=-1, keepdims=True)
    slope = (h[:, 0] ** 2 + h[:, 1] ** 2) / alpha**2 + h[:, 2] ** 2
    return 1 / (np.pi * alpha**2 * slope**2) / (4 * wo[2])


def random_case(rng: np.random.Generator) -> tuple[float, Floats, Floats, float]:
    """alpha, wo, axis, half_angle: alpha 0.001..1, views to 88 degrees, half-angles 0.001..80 degrees; the light in the
    highlight, beside it, or across the horizon."""
    alpha = 10 ** rng.uniform(-3, 0)
    theta = np.radians(rng.uniform(0, 88))
    half_angle = np.radians(10 ** rng.uniform(-3, np.log10(80)))
    wo = np.array([np.sin(theta), 0, np.cos(theta)])
    if rng.random() < 1 / 3:
        elevation = rng.uniform(-1, 1) * half_angle
        azimuth = np.pi + rng.uniform(-1, 1) * max(half_angle, alpha)
        axis = np.array([np.cos(azimuth) * np.cos(elevation), np.sin(azimuth) * np.cos(elevation), np.sin(elevation)])
    else:
        near = bsdf.ggx_sample(alpha, wo, rng.random(2))
        axis = pd.cap_sample(near / np.linalg.norm(near), 2 * np.sin(half_angle / 2) ** 2, rng.random(2))
    return alpha, wo, axis / np.linalg.norm(axis), half_angle


def ggx_under_gaussian(alpha: float, wo: Floats, axis: Floats, sharpness: float) -> float:
    """The integral of D G2 / (4 cos_o) exp(sharpness (wi . axis - 1)): by rings around the light, or the highlight,
    whichever is narrower, as their product is there."""
    mirror = np.array([-wo[0], -wo[1], wo[2]])
    center, scale = (axis, 1 / sharpness) if sharpness > 0.5 / alpha**2 else (mirror, alpha**2)
    rings, turns = 1200, 512
    x = (np.arange(rings) + 0.5) / rings
    versine = scale * x / (1 - x * (1 - scale / 2))  # from 0 to 2, dense where it is below scale
    weight = scale / (1 - x * (1 - scale / 2)) ** 2 / rings
    phi = (np.arange(turns) + 0.5) * 2 * np.pi / turns
    side = np.cross(center, [0.3, 0.8, 0.52])
    side /= np.linalg.norm(side)
    radius = np.sqrt(np.maximum(versine * (2 - versine), 0))[:, None, None]
    around = np.cos(phi)[:, None] * side + np.sin(phi)[:, None] * np.cross(center, side)
    wi = (1 - versine)[:, None, None] * center + radius * around
    light = np.exp(-sharpness * 0.5 * ((wi - axis) ** 2).sum(-1))
    value = smith_ggx(alpha, wo, wi) * light * weight[:, None]
    return float(value.sum() * 2 * np.pi / turns)


def smith_ggx(alpha: float, wo: Floats, wi: Floats) -> Floats:
    """D G2 / (4 cos_o), F = 1, by itself."""
    h = wo + wi
    h /= np.linalg.norm(h, axis=-1, keepdims=True)
    ndf = alpha**2 / (np.pi * (h[..., 2] ** 2 * (alpha**2 - 1) + 1) ** 2)
    zi, zo = np.maximum(wi[..., 2], 0), wo[2]
    g_i, g_o = (np.sqrt(alpha**2 + (1 - alpha**2) * z**2) for z in (zi, zo))
    g2 = 2 * zi * zo / np.maximum(zo * g_i + zi * g_o, 1e-30)
    return np.where(wi[..., 2] > 0, ndf * g2 / (4 * zo), 0.0)
