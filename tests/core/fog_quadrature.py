"""Light that scatters once in fog, by quadrature along the ray and over each light: the truth of test_fog.py.

It shares nothing with the core but the meaning of its arguments. Metres, world space, linear RGB. omega points from
a place in the fog towards the light, direction from the eye into the scene, so a phase function's mu is their product.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from itertools import pairwise

import numpy as np
import pivot_core
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Triple = tuple[float, float, float]
WHITE = (1.0, 1.0, 1.0)
OPAQUE = 40.0  # an optical depth


@cache
def gauss(order: int, panels: int = 1) -> tuple[Floats, Floats]:
    """Nodes and weights of Gauss-Legendre on [0, 1] in equal panels."""
    x, w = np.polynomial.legendre.leggauss(order)
    starts = np.arange(panels)[:, None]
    return ((starts + (x + 1) / 2) / panels).ravel(), np.tile(w / (2 * panels), panels)


def unit(v: Sequence[float] | Floats) -> Floats:
    return np.asarray(v, float) / np.linalg.norm(v)


def frame(axis: Floats) -> Floats:
    """(..., 3, 3): rows x, y and the unit axis."""
    helper = np.where(np.abs(axis[..., 2:]) < 0.7, (0.0, 0.0, 1.0), (1.0, 0.0, 0.0))
    x = np.cross(helper, axis)
    x /= np.linalg.norm(x, axis=-1, keepdims=True)
    return np.stack([x, np.cross(axis, x), axis], -2)


# -- phase functions
def henyey_greenstein(g: float, mu: Floats) -> Floats:
    return (1 - g * g) / (4 * np.pi * (1 + g * g - 2 * g * mu) ** 1.5)


def pivot_phase(g_p: float, mu: Floats) -> Floats:
    return ((1 - g_p * g_p) / (1 + g_p * g_p - 2 * g_p * mu)) ** 2 / (4 * np.pi)


PHASES = {"HENYEY_GREENSTEIN": henyey_greenstein, "PIVOT": pivot_phase}


# -- media
@dataclass(frozen=True)
class Fog:
    """Fog in the box from low to high, or everywhere. density: at the origin and its gradient, which multiply
    scattering and absorption; not negative in the box."""

    sigma_s: Triple = (0.0, 0.0, 0.0)
    sigma_a: Triple = (0.0, 0.0, 0.0)
    g: float = 0.0
    phase: str = "HENYEY_GREENSTEIN"
    low: Triple | None = None
    high: Triple | None = None
    emission: Triple = (0.0, 0.0, 0.0)
    density: tuple[float, Triple] = (1.0, (0.0, 0.0, 0.0))

    @property
    def sigma_t(self) -> Floats:
        return np.add(self.sigma_s, self.sigma_a)

    def density_at(self, points: Floats) -> Floats:
        return self.density[0] + points @ np.array(self.density[1])

    def inside(self, origins: Floats, directions: Floats, end_m: Floats) -> tuple[Floats, Floats]:
        """From where to where on (...) segments of rays (..., 3) the fog is; where nothing, both are alike."""
        if self.low is None:
            return np.zeros_like(end_m), end_m
        with np.errstate(divide="ignore", invalid="ignore"):
            a, b = ((np.array(corner) - origins) / directions for corner in (self.low, self.high))
        near = np.nanmax(np.minimum(a, b), -1).clip(0.0)
        far = np.minimum(np.nanmin(np.maximum(a, b), -1), end_m)
        return near, np.maximum(near, far)

    def depth(self, origins: Floats, directions: Floats, end_m: Floats) -> Floats:
        """Optical depth (..., 3) of segments: exact, of a density that is linear."""
        near, far = self.inside(origins, directions, end_m)
        endless = np.isinf(far)
        middle = np.where(endless, 0.0, (near + far) / 2)
        length = np.where(endless, 1e9, far - near) * self.density_at(origins + middle[..., None] * directions)
        return length[..., None] * self.sigma_t


def transmittance(fogs: Sequence[Fog], origins: Floats, directions: Floats, end_m: Floats) -> Floats:
    """(..., 3)"""
    return np.exp(-sum((fog.depth(origins, directions, end_m) for fog in fogs), np.zeros((*end_m.shape, 3))))


# -- lights; each seen_from some points (P, 3) in directions omega (P, K, 3), distances (P, K) and with a radiance times
# solid angle (P, K, 3)
def _cap(axis: Floats, versine: Floats, fineness: int) -> tuple[Floats, Floats]:
    """Directions (P, K, 3) in caps around (P, 3), and their solid angles (P, K)."""
    s, weight = gauss(12, fineness)
    turns = 24 * fineness
    phi = (np.arange(turns) + 0.5) * 2 * np.pi / turns
    h = versine[:, None] * s**2
    sine = np.sqrt(h * (2 - h))
    ones = np.ones((len(axis), turns))
    local = np.stack(
        [
            sine[..., None] * np.cos(phi),
            sine[..., None] * np.sin(phi),
            (1 - h)[..., None] * ones[:, None],
        ],
        -1,
    ).reshape(len(axis), -1, 3)
    solid_angle = versine[:, None] * 2 * s * weight * 2 * np.pi / turns
    return local @ frame(axis), np.repeat(solid_angle, turns, axis=1)


@dataclass(frozen=True)
class Sphere:
    position: Triple
    radius_m: float
    intensity: Triple

    def seen_from(self, points: Floats, fineness: int) -> tuple[Floats, Floats, Floats]:
        to_center = np.array(self.position) - points
        distance2 = (to_center**2).sum(-1)
        assert distance2.min() > self.radius_m**2, "a ray runs through the lamp"
        sine2 = self.radius_m**2 / distance2
        versine = sine2 / (1 + np.sqrt(1 - sine2))
        omega, solid_angle = _cap(to_center / np.sqrt(distance2)[:, None], versine, fineness)
        along = (omega * to_center[:, None]).sum(-1)
        half_chord2 = self.radius_m**2 - ((to_center[:, None] - along[..., None] * omega) ** 2).sum(-1)
        radiance = np.array(self.intensity) / (np.pi * self.radius_m**2)
        shine = self.share(omega) * solid_angle
        return omega, along - np.sqrt(half_chord2.clip(0)), shine[..., None] * radiance

    def share(self, omega: Floats) -> Floats:
        """(P, K) of the radiance"""
        return np.ones(omega.shape[:-1])

    def core(self) -> object:
        return pivot_core.SphereLight(self.position, self.radius_m, self.intensity)


@dataclass(frozen=True)
class Spot(Sphere):
    direction: Triple
    cos_half_angle: float
    blend: float

    def share(self, omega: Floats) -> Floats:
        part = (-omega @ unit(self.direction) - self.cos_half_angle) / ((1 - self.cos_half_angle) * self.blend)
        t = part.clip(0, 1)
        return t * t * (3 - 2 * t)

    def core(self) -> object:
        return pivot_core.SpotLight(
            self.position, self.radius_m, self.intensity, unit(self.direction), self.cos_half_angle, self.blend
        )


@dataclass(frozen=True)
class Sun:
    direction: Triple
    half_angle_rad: float
    irradiance: Triple

    def seen_from(self, points: Floats, fineness: int) -> tuple[Floats, Floats, Floats]:
        axis = np.broadcast_to(unit(self.direction), points.shape)
        versine = np.full(len(points), 2 * np.sin(self.half_angle_rad / 2) ** 2)
        omega, solid_angle = _cap(axis, versine, fineness)
        radiance = np.array(self.irradiance) / (np.pi * np.sin(self.half_angle_rad) ** 2)
        return omega, np.full(solid_angle.shape, np.inf), solid_angle[..., None] * radiance

    def core(self) -> object:
        return pivot_core.SunLight(unit(self.direction), self.half_angle_rad, self.irradiance)


@dataclass(frozen=True)
class Rectangle:
    """Shines towards half_u x half_v."""

    position: Triple  # of its middle
    half_u: Triple
    half_v: Triple
    radiance: Triple

    def seen_from(self, points: Floats, fineness: int) -> tuple[Floats, Floats, Floats]:
        x, weight = gauss(12, fineness)
        u, v = np.meshgrid(2 * x - 1, 2 * x - 1)
        places = np.array(self.position) + u.reshape(-1, 1) * self.half_u + v.reshape(-1, 1) * self.half_v
        normal = np.cross(self.half_u, self.half_v)  # as long as a quarter of the area
        offset = places - points[:, None]
        distance = np.linalg.norm(offset, axis=-1)
        omega = offset / distance[..., None]
        solid_angle = 4 * np.outer(weight, weight).ravel() * (-omega @ normal).clip(0) / distance**2
        return omega, distance, solid_angle[..., None] * np.array(self.radiance)

    def core(self) -> object:
        return pivot_core.AreaLight(self.position, self.half_u, self.half_v, self.radiance)


Light = Sphere | Sun | Rectangle


# -- the integral
def _nodes(breaks: Sequence[float], fineness: int) -> tuple[Floats, Floats]:
    """On every piece between breaks, closer to its ends."""
    x, weight = gauss(12, fineness)
    bent, slope = x * x * (3 - 2 * x), 6 * x * (1 - x)
    t = [a + (b - a) * bent for a, b in pairwise(breaks)]
    w = [(b - a) * slope * weight for a, b in pairwise(breaks)]
    return np.concatenate(t), np.concatenate(w)


def _around(light: Light, origin: Floats, direction: Floats) -> list[float]:
    """Where the ray is nearest to the light, and places ever farther from there: what it sees varies as they do."""
    if isinstance(light, Sun):
        return []
    to_light = np.subtract(light.position, origin)
    nearest = float(to_light @ direction)
    gap = float(np.linalg.norm(to_light - nearest * direction))
    places = [nearest + side * gap * 4.0**power for power in range(-1, 5) for side in (-1, 0, 1)]
    if isinstance(light, Rectangle):
        normal = np.cross(light.half_u, light.half_v)
        places.append(float(to_light @ normal / (direction @ normal)))
    return places


def radiance(
    eye: Triple,
    target: Triple,
    fogs: Sequence[Fog],
    lights: Sequence[Light],
    end_m: float = np.inf,
    behind: Triple = (0.0, 0.0, 0.0),
    fineness: int = 2,
) -> Floats:
    """(3,): what fog scatters once and emits along the ray, and what is behind at end_m, through the fog."""
    origin, direction = np.array(eye, float), unit(np.subtract(target, eye))
    ends = [fog.inside(origin, direction, np.array(end_m)) for fog in fogs]
    far = max(float(end) for _, end in ends)
    if not np.isfinite(far):
        far = min(OPAQUE / fog.sigma_t.min() for fog in fogs if fog.low is None)
    breaks = {0.0, far} | {min(float(t), far) for pair in ends for t in pair}
    for light in lights:
        breaks |= {t for t in _around(light, origin, direction) if 0 < t < far}
    t, weight = _nodes(sorted(breaks), fineness)
    points = origin + t[:, None] * direction
    seen = transmittance(fogs, np.broadcast_to(origin, points.shape), np.broadcast_to(direction, points.shape), t)
    total = np.zeros_like(points)
    here = []
    for fog, (start, end) in zip(fogs, ends, strict=True):
        here.append(((t > start) & (t < end)) * fog.density_at(points))
        total += ((t > start) & (t < end))[:, None] * np.array(fog.emission)
    for light in lights:
        omega, distance, shine = light.seen_from(points, fineness)
        arriving = shine * transmittance(fogs, np.broadcast_to(points[:, None], omega.shape), omega, distance)
        mu = omega @ direction
        for fog, density in zip(fogs, here, strict=True):
            scattered = (PHASES[fog.phase](fog.g, mu)[..., None] * arriving).sum(1)
            total += density[:, None] * np.array(fog.sigma_s) * scattered
    through = transmittance(fogs, origin, direction, np.array(end_m)) * np.array(behind)
    return (weight[:, None] * seen * total).sum(0) + through
