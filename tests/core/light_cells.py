"""Lights as pieces of the sphere of directions that a point sees, for tests of how they are sampled.

A place on a light is (s, t) in [0, 1]^2; the point is the origin, its normal +z.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import pivot_core
from chi_squared import frame_around
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True)
class CapLight:
    """A sphere, a spot or a sun: s its versine over the cap's, t the azimuth."""

    light: object
    axis: Array
    versine: float

    def directions(self, place: Array) -> tuple[Array, Array]:
        """wi (n, 3), and solid angle per area of (s, t)."""
        h, phi = self.versine * place[:, 0], 2 * np.pi * place[:, 1]
        radius = np.sqrt(h * (2 - h))
        local = np.stack([radius * np.cos(phi), radius * np.sin(phi), 1 - h], -1)
        return local @ frame_around(self.axis).T, np.full(len(place), 2 * np.pi * self.versine)

    def places(self, wi: Array) -> Array:
        """(s, t) of directions; beyond the unit square where they miss the light."""
        local = wi @ frame_around(self.axis)
        h = 0.5 * ((wi - self.axis) ** 2).sum(-1)
        return np.stack([h / self.versine, np.arctan2(local[:, 1], local[:, 0]) / (2 * np.pi) % 1], -1)


@dataclass(frozen=True)
class FlatLight:
    """A rectangle: (s, t) along its sides; an ellipse: squared radius and azimuth; a mesh's triangle: its share up to a
    side's parallel, and along that. light is then its corners (3, 3)."""

    light: object
    center: Array
    half_u: Array
    half_v: Array
    ellipse: bool
    triangle: bool = False

    def directions(self, place: Array) -> tuple[Array, Array]:
        xy = 2 * place - 1
        if self.ellipse:
            r, phi = np.sqrt(place[:, 0]), 2 * np.pi * place[:, 1]
            xy = np.stack([r * np.cos(phi), r * np.sin(phi)], -1)
        if self.triangle:
            along = np.sqrt(place[:, 0])
            xy = np.stack([2 * along - 1, along * xy[:, 1]], -1)
        to_light = self.center + xy[:, :1] * self.half_u + xy[:, 1:] * self.half_v
        normal = np.cross(self.half_u, self.half_v)  # as long as a quarter of the rectangle's area
        distance = np.linalg.norm(to_light, axis=-1)
        area = np.pi if self.ellipse else 2.0 if self.triangle else 4.0
        return to_light / distance[:, None], area * np.abs(to_light @ normal) / distance**3

    def places(self, wi: Array) -> Array:
        normal = np.cross(self.half_u, self.half_v)
        on_light = wi * (self.center @ normal / (wi @ normal))[:, None] - self.center
        across_u, across_v = np.cross(self.half_v, normal), np.cross(normal, self.half_u)
        xy = np.stack([on_light @ across_u, on_light @ across_v], -1) / (normal @ normal)
        if self.ellipse:
            return np.stack([(xy**2).sum(-1), np.arctan2(xy[:, 1], xy[:, 0]) / (2 * np.pi) % 1], -1)
        if self.triangle:
            along = 0.5 + 0.5 * xy[:, 0]
            return np.stack([along**2, 0.5 + 0.5 * xy[:, 1] / np.maximum(along, 1e-9)], -1)
        return 0.5 * xy + 0.5


SeenLight = CapLight | FlatLight


def sphere(
    center: tuple[float, float, float], radius_m: float, radiance: float = 1.0, facing_disk: bool = False
) -> CapLight:
    distance = float(np.linalg.norm(center))
    sin2 = min((radius_m / distance) ** 2, 1.0)
    versine = sin2 / (1 + np.sqrt(1 - sin2)) if radius_m < distance else 2.0  # 2: all around
    if facing_disk:
        versine = 1 - np.cos(np.arctan2(radius_m, distance))
    light = pivot_core.SphereLight(center, radius_m, (np.pi * radius_m**2 * radiance,) * 3, facing_disk)
    return CapLight(light, np.array(center) / distance, versine)


def spot(
    center: tuple[float, float, float],
    radius_m: float,
    target: tuple[float, float, float],
    half_angle_rad: float,
    facing_disk: bool = False,
    cosine: bool = False,
) -> CapLight:
    seen = sphere(center, radius_m, facing_disk=facing_disk)
    direction = np.subtract(target, center) / np.linalg.norm(np.subtract(target, center))
    cone = tuple(direction), np.cos(half_angle_rad), 0.5
    light = pivot_core.SpotLight(center, radius_m, (np.pi * radius_m**2,) * 3, *cone, facing_disk, cosine)
    return CapLight(light, seen.axis, seen.versine)


def sun(direction: tuple[float, float, float], half_angle_rad: float) -> CapLight:
    versine = 2 * np.sin(half_angle_rad / 2) ** 2
    light = pivot_core.SunLight(direction, half_angle_rad, (np.pi * versine * (2 - versine),) * 3)
    return CapLight(light, np.array(direction), versine)


def flat(
    center: tuple[float, float, float],
    half_u: tuple[float, float, float],
    half_v: tuple[float, float, float],
    ellipse: bool = False,
) -> FlatLight:
    """Turned to shine on the origin."""
    u, v = np.array(half_u), np.array(half_v)
    if np.cross(u, v) @ center > 0:
        v = -v
    light = pivot_core.AreaLight(center, tuple(u), tuple(v), (1.0, 1.0, 1.0), ellipse)
    return FlatLight(light, np.array(center), u, v, ellipse)


def triangle(*corners: tuple[float, float, float]) -> FlatLight:
    a, b, c = np.array(corners)
    half_u, half_v = 0.5 * (0.5 * (b + c) - a), 0.5 * (c - b)
    return FlatLight(np.array(corners, np.float32), a + half_u, half_u, half_v, ellipse=False, triangle=True)


def density_grid(density: Callable[[Array], Array], seen: SeenLight, size: int) -> Array:
    """The share of samples in each of (size, size) pixels of (s, t), for a density per steradian."""
    middles = (np.arange(size) + 0.5) / size
    wi, solid_angle = seen.directions(np.stack(np.meshgrid(middles, middles, indexing="ij"), -1).reshape(-1, 2))
    return (density(wi) * solid_angle).reshape(size, size) / size**2


def count_grid(places: Array, size: int) -> Array:
    """How many of the places lie in each pixel."""
    s, t = np.clip((places * size).astype(int), 0, size - 1).T
    return np.bincount(s * size + t, minlength=size**2).reshape(size, size).astype(float)


def equal_cells(grid: Array, depth: int) -> list[tuple[slice, slice]]:
    """Up to 2^depth rectangles of pixels whose sums are as alike as pixels allow."""
    cells = [(slice(0, grid.shape[0]), slice(0, grid.shape[1]))]
    for _ in range(depth):
        cells = [half for cell in cells for half in _halves(grid, cell)]
    return cells


def _halves(grid: Array, cell: tuple[slice, slice]) -> list[tuple[slice, slice]]:
    axis = 0 if cell[0].stop - cell[0].start >= cell[1].stop - cell[1].start else 1
    low, high = cell[axis].start, cell[axis].stop
    if high - low < 2:
        return [cell]
    sums = np.cumsum(grid[cell].sum(1 - axis))
    cut = low + int(np.clip(np.searchsorted(sums, sums[-1] / 2) + 1, 1, high - low - 1))
    halves = slice(low, cut), slice(cut, high)
    return [(half, cell[1]) if axis == 0 else (cell[0], half) for half in halves]
