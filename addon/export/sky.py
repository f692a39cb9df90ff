"""Skies over a round Earth, as pictures: light of the sun that the air scatters once, and a formula of daylight.

The atmosphere is that of Cycles' sky, so that the pictures are alike. [C] is Cycles 4.5, intern/sky and svm/sky.h.

[Nishita93]   Display of the Earth taking into account atmospheric scattering
[Preetham99]  A Practical Analytic Model for Daylight
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .colour_space import RGB_FROM_XYZ

Floats = NDArray[np.float64]

ROWS, COLUMNS = 256, 512  # of a picture: sqrt of the elevation from below to above, and azimuth from behind the sun
LIMB_DARKENING = 0.6  # of the sun's edge [C]

_EARTH_M, _ATMOSPHERE_M = 6360e3, 6420e3  # radii
_AIR_M, _DUST_M = 8e3, 1.2e3  # heights over which there is e times less of them
_OZONE_M, _OZONE_HALF_M = 25e3, 15e3
_DUST_SCATTERING_PER_M, _DUST_EXTINCTION_PER_M, _DUST_G = 2e-5, 1.11 * 2e-5, 0.76
_STEPS, _SUN_STEPS = 32, 8
_STEP_NM = 20
_WAVELENGTHS_M = np.arange(380, 781, _STEP_NM) * 1e-9
_AIR_PER_M = 1.13114877e-30 / _WAVELENGTHS_M**4
# Absorption at each wavelength.
_OZONE_PER_GM = "3 6 20 73 201 404 636 967 1548 2090 2461 2736 2151 1591 1124 735 465 331 225 149 168"
_OZONE_PER_M = 1e-9 * np.array(_OZONE_PER_GM.split(), float)


def _black_body(temperature_k: float) -> Floats:
    """W / (m2 sr nm)."""
    h, c, k = 6.62607015e-34, 2.99792458e8, 1.380649e-23
    return 2e-9 * h * c**2 / _WAVELENGTHS_M**5 / np.expm1(h * c / (_WAVELENGTHS_M * k * temperature_k))


_SUN_IRRADIANCE = _black_body(5778.0) * np.pi * (6.955e8 / 1.496e11) ** 2  # by its radius and distance in m


@dataclass(frozen=True)
class Air:
    """What the light of a sun at this elevation comes through."""

    sun_elevation_rad: float
    altitude_m: float
    air: float
    dust: float
    ozone: float


def row_elevations() -> Floats:
    """(ROWS,) radians."""
    level = np.arange(ROWS) / (ROWS // 2) - 1
    return np.copysign(level**2, level) * (np.pi / 2)


def single_scattering(core: Any, air: Air) -> NDArray[np.float32]:
    """(ROWS, COLUMNS, 3), linear RGB, some of it below 0. core: pivot_core."""
    upper = row_elevations()[ROWS // 2 :]
    azimuth = 2 * np.pi * np.arange(COLUMNS // 2) / COLUMNS - np.pi
    elevation, azimuth = np.meshgrid(upper, azimuth, indexing="ij")
    half = _rgb(core, _scattered(air, _direction(elevation.ravel(), azimuth.ravel())))
    sky = half.reshape(*elevation.shape, 3)
    sky = np.concatenate([sky, sky[:, ::-1]], axis=1)
    # Below the horizon its colours fade out. [C]
    depth = np.sin(-row_elevations()[: ROWS // 2])
    fade = np.clip(1 - 2.5 * depth, 0, 1) ** 3
    return np.concatenate([fade[:, None, None] * sky[:1], sky]).astype(np.float32)


def sun_disk(core: Any, air: Air, diameter_rad: float) -> tuple[Floats, Floats]:
    """The radiance of the sun's middle, were it at its lower and at its upper edge: linear RGB."""
    solid_angle = 2 * np.pi * (1 - np.cos(diameter_rad / 2))
    low, high = (air.sun_elevation_rad + side * diameter_rad / 2 for side in (-1, 1))
    edges = _direction(np.maximum([low, high], 0.0), np.zeros(2))
    viewer_m = np.full(2, _viewer_m(air))
    depth = _depth_to_sun(viewer_m, viewer_m * edges[:, 2])
    rgb = _rgb(core, _SUN_IRRADIANCE * np.exp(-_extinction(Air(0, 0, air.air, air.dust, 0), depth)) / solid_angle)
    return rgb[0], rgb[1]


def horizon_rad(altitude_m: float) -> float:
    """How far below the level the Earth begins."""
    return float(np.pi / 2 - np.arcsin(_EARTH_M / (_EARTH_M + altitude_m)))


def preetham(sun_direction: Floats, turbidity: float) -> NDArray[np.float32]:
    """(ROWS, COLUMNS, 3), linear RGB, as single_scattering(). [Preetham99, appendix A.2]"""
    x, y, z = sun_direction
    theta_s, t = np.arccos(np.clip(z, -1, 1)), turbidity
    elevation, azimuth = np.meshgrid(
        np.sign(_middles()) * _middles() ** 2 * (np.pi / 2),
        2 * np.pi * (np.arange(COLUMNS) + 0.5) / COLUMNS - np.pi,
        indexing="ij",
    )
    sun = np.array([np.hypot(x, y), 0.0, z])
    gamma = np.arccos(np.clip(_direction(elevation, azimuth) @ sun, -1, 1))
    theta = np.minimum(np.pi / 2 - elevation, np.pi / 2 - 0.001)
    of_luminance = (0.1787 * t - 1.4630, -0.3554 * t + 0.4275, -0.0227 * t + 5.3251, 0.1206 * t - 2.5771)
    of_x = (-0.0193 * t - 0.2592, -0.0665 * t + 0.0008, -0.0004 * t + 0.2125, -0.0641 * t - 0.8989)
    of_y = (-0.0167 * t - 0.2608, -0.0950 * t + 0.0092, -0.0079 * t + 0.2102, -0.0441 * t - 1.6537)
    perez = ((*of_luminance, -0.0670 * t + 0.3703), (*of_x, -0.0033 * t + 0.0452), (*of_y, -0.0109 * t + 0.0529))
    chi = (4 / 9 - t / 120) * (np.pi - 2 * theta_s)
    powers = np.array([theta_s**3, theta_s**2, theta_s, 1.0])
    turbidities = np.array([t**2, t, 1.0])
    zenith_x = [[0.00166, -0.00375, 0.00209, 0], [-0.02903, 0.06377, -0.03202, 0.00394]]
    zenith_y = [[0.00275, -0.00610, 0.00317, 0], [-0.04214, 0.08970, -0.04153, 0.00516]]
    zenith_x.append([0.11693, -0.21196, 0.06052, 0.25886])
    zenith_y.append([0.15346, -0.26756, 0.06670, 0.26688])
    zenith = (
        0.06 * ((4.0453 * t - 4.9710) * np.tan(chi) - 0.2155 * t + 2.4192),  # Cycles' unit of luminance [C]
        turbidities @ np.array(zenith_x) @ powers,
        turbidities @ np.array(zenith_y) @ powers,
    )
    luminance, chroma_x, chroma_y = (
        value * _perez(k, theta, gamma) / _perez(k, np.float64(0), theta_s)
        for value, k in zip(zenith, perez, strict=True)
    )
    per_y = luminance / np.where(chroma_y == 0, 1.0, chroma_y)
    xyz = np.stack([chroma_x * per_y, luminance, (1 - chroma_x - chroma_y) * per_y], -1)
    return (xyz @ RGB_FROM_XYZ.T).astype(np.float32)


def _middles() -> Floats:
    """Of the rows of what is not known at their lower edges: [-1, 1]."""
    return 2 * (np.arange(ROWS) + 0.5) / ROWS - 1


def _perez(k: tuple[float, ...], theta: Any, gamma: Any) -> Any:
    a, b, c, d, e = k
    return (1 + a * np.exp(b / np.cos(theta))) * (1 + c * np.exp(d * gamma) + e * np.cos(gamma) ** 2)


def _direction(elevation: Floats, azimuth: Floats) -> Floats:
    """(..., 3); z is up and the sun's azimuth 0."""
    across = np.cos(elevation)
    return np.stack([across * np.cos(azimuth), across * np.sin(azimuth), np.sin(elevation)], -1)


def _viewer_m(air: Air) -> float:
    """Above the middle of the Earth."""
    return float(_EARTH_M + np.clip(air.altitude_m, 1, 59999))


# A place is a radius, how far it is from the middle of the Earth, and a way from there also has a rise: radius times
# cosine of its angle to the vertical. After s metres of it the radius is sqrt(radius^2 + 2 s rise + s^2).


def _radius_after(radius_m: Floats, rise_m: Floats, way_m: Floats) -> Floats:
    return np.sqrt(radius_m**2 + way_m * (2 * rise_m + way_m))


def _densities(radius_m: Floats) -> Floats:
    """(3, ...) of air, dust and ozone, over their densities at the ground or where they are densest."""
    height = radius_m - _EARTH_M
    ozone = np.maximum(1 - np.abs(height - _OZONE_M) / _OZONE_HALF_M, 0)
    return np.stack([np.exp(-height / _AIR_M), np.exp(-height / _DUST_M), ozone])


def _way_out_m(radius_m: Floats, rise_m: Floats) -> Floats:
    """To the edge of the atmosphere."""
    return -rise_m + np.sqrt(rise_m**2 - radius_m**2 + _ATMOSPHERE_M**2)


def _depth_to_sun(radius_m: Floats, rise_m: Floats) -> Floats:
    """(3, n) integrals of the densities along ways out, which fall off about exponentially: by Gauss-Laguerre."""
    nodes, weights = np.polynomial.laguerre.laggauss(_SUN_STEPS)
    weights, nodes = weights * np.exp(nodes) / 25, nodes / 25  # the last node is within the atmosphere [C]
    way_m = _way_out_m(radius_m, rise_m)
    depth = np.zeros((3, *way_m.shape))
    for node, weight in zip(nodes, weights, strict=True):
        depth += weight * _densities(_radius_after(radius_m, rise_m, node * way_m))
    return depth * way_m


def _extinction(air: Air, depth: Floats) -> NDArray[np.float32]:
    """(n, wavelengths) of integrals of densities, (3, n)."""
    per_m = np.stack([_AIR_PER_M, np.full_like(_AIR_PER_M, _DUST_EXTINCTION_PER_M), _OZONE_PER_M])
    return (depth.T * (air.air, air.dust, air.ozone)).astype(np.float32) @ per_m.astype(np.float32)


def _scattered(air: Air, directions: Floats) -> Floats:
    """(n, wavelengths) of radiance: an integral along each way out of what is scattered there. [Nishita93 (4)]"""
    sun = _direction(np.float64(air.sun_elevation_rad), np.float64(0))
    mu, g = directions @ sun, _DUST_G
    by_air = 3 / (16 * np.pi) * (1 + mu**2)
    # The phase function of Cornette and Shanks. [Nishita93 (5)]
    by_dust = 3 * (1 - g**2) * (1 + mu**2) / (8 * np.pi * (2 + g**2) * (1 + g**2 - 2 * g * mu) ** 1.5)
    viewer_m = np.full(len(directions), _viewer_m(air))
    rise_m = viewer_m * directions[:, 2]
    step_m = _way_out_m(viewer_m, rise_m) / _STEPS
    depth, radiance = np.zeros((3, len(directions))), np.zeros((len(directions), len(_WAVELENGTHS_M)), np.float32)
    for step in range(_STEPS):
        way_m = (step + 0.5) * step_m
        radius_m = _radius_after(viewer_m, rise_m, way_m)
        density = _densities(radius_m)
        depth += density * step_m
        sun_rise_m = viewer_m * sun[2] + way_m * mu
        in_shadow = (sun[2] < 0) & (sun_rise_m**2 - radius_m**2 + _EARTH_M**2 >= 0)
        left = np.exp(-_extinction(air, depth + _depth_to_sun(radius_m, sun_rise_m)))
        lit_m = np.where(in_shadow, 0, step_m)
        scattered = np.stack([by_air * density[0] * air.air * lit_m, by_dust * density[1] * air.dust * lit_m], -1)
        per_m = np.stack([_AIR_PER_M, np.full_like(_AIR_PER_M, _DUST_SCATTERING_PER_M)])
        radiance += left * (scattered.astype(np.float32) @ per_m.astype(np.float32))
    return radiance * _SUN_IRRADIANCE


def _rgb(core: Any, spectra: Floats) -> Floats:
    """(n, 3), linear, of (n, wavelengths)."""
    wavelengths_nm = (_WAVELENGTHS_M * 1e9).astype(np.float32)[:, None]
    return spectra @ core.run_op("wavelength_xyz", wavelengths_nm, []) * _STEP_NM @ RGB_FROM_XYZ.T
