"""Pictures of analytic distributions of microfacet normals. Needs NumPy alone.

A picture is the orthographic projection of the hemisphere: its pixel (column, row) holds the mean, over what of its
square is inside the unit disk, of the density D(h) of h = (x, y, sqrt(1 - x^2 - y^2)), x by columns and y by rows from
-1 to 1. The integral of D(h) h.z dw, which is D's over the disk's dx dy, is the sum of the lobes' shares.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]

_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(3)
_OUTSIDE = 1e-9  # weight of a node that is not in the disk: it counts where no other of its square is
_FINE = 0.4  # how far D's argument may change within a square that the nodes integrate, of its scale there
_FARTHEST = 6.0  # standard deviations, times sqrt(2), of a Beckmann lobe beyond which it is nothing: e^-36
_CHUNK = 1 << 14  # pixels that are integrated at once, to stay in the cache


@dataclass(frozen=True)
class Lobe:
    """GGX or Beckmann [Walter07], anisotropic [Heitz14]: D(h) = P(slope(h) - slope) / h.z^4 about a mean slope."""

    alpha: tuple[float, float]  # along the lobe's own x and y
    rotation: float = 0.0  # radians from the picture's x to the lobe's
    slope: float = 0.0  # tangent of the angle by which the lobe is tilted along its x
    share: float = 1.0
    is_beckmann: bool = False

    def density(self, x: Floats, y: Floats, z: Floats) -> Floats:
        square = self._slopes_squared(x, y, z)
        scale = self.share / (math.pi * self.alpha[0] * self.alpha[1])
        if self.is_beckmann:
            z2 = np.maximum(z * z, 1e-30)
            return scale * np.exp(-np.minimum(square / z2, 700)) / (z2 * z2)
        return scale / (square + z * z) ** 2

    def is_coarse(self, x: Floats, y: Floats, z: Floats, half: float) -> NDArray[np.bool_]:
        """Whether the density changes too much over squares about these points for three nodes a side."""
        steepness = 1 / np.maximum(z, math.sqrt(half))  # |dz| of |dx|, bounded by the square's mean
        reach = math.sqrt(2) * half * ((1 + abs(self.slope) * steepness) / min(self.alpha) + steepness)
        square = self._slopes_squared(x, y, z)
        if not self.is_beckmann:
            return reach > _FINE * np.sqrt(square + z * z)
        reach *= steepness
        nearest = np.maximum(np.sqrt(square) * steepness - reach, 0)
        return (nearest < _FARTHEST) & (reach * np.maximum(nearest, 1) > _FINE)

    def _slopes_squared(self, x: Floats, y: Floats, z: Floats) -> Floats:
        """Of the slopes less the shift, in alphas, times z^2: finite at the horizon."""
        cosine, sine = math.cos(self.rotation), math.sin(self.rotation)
        along = (cosine * x + sine * y - self.slope * z) / self.alpha[0]
        across = (cosine * y - sine * x) / self.alpha[1]
        return along * along + across * across


@dataclass(frozen=True)
class Yarn:
    """Fibres that rise and fall along the yarn: half of them tilt one way."""

    direction: float  # radians from x
    alpha_along: float
    alpha_across: float
    tilt: float  # radians
    share: float

    def lobes(self) -> list[Lobe]:
        alpha, slope = (self.alpha_along, self.alpha_across), math.tan(self.tilt)
        return [Lobe(alpha, self.direction, way * slope, self.share / 2) for way in (1, -1)]


def drawn(size: int, lobes: Sequence[Lobe]) -> NDArray[np.float32]:
    """(size, size): the sum of the lobes."""
    picture = np.zeros((size, size), np.float32)
    step = max(1, _CHUNK // size)
    centres = (np.arange(size) + 0.5) * 2 / size - 1
    for first in range(0, size, step):
        rows = slice(first, first + step)
        x, y = np.meshgrid(centres, centres[rows])
        inside = meets_disk(x, y, 1 / size)
        for lobe in lobes:
            integral, area = _integrals(lobe, x[inside], y[inside], 1 / size)
            picture[rows][inside] += integral / area
    return picture


def _integrals(lobe: Lobe, x: Floats, y: Floats, half: float) -> tuple[Floats, Floats]:
    """D's mean over squares, what lies outside the disk as nothing, and the share of their area inside.

    x, y: their centres; half: half their side. Squares that are too coarse are cut in four.
    """
    coarse = lobe.is_coarse(*on_hemisphere(x, y), half)
    integral, area = np.zeros(x.shape), np.zeros(x.shape)
    fine_x, fine_y = x[~coarse], y[~coarse]
    for node_x, weight_x in zip(_NODES, _WEIGHTS, strict=True):
        for node_y, weight_y in zip(_NODES, _WEIGHTS, strict=True):
            at_x, at_y = fine_x + half * node_x, fine_y + half * node_y
            weight = np.where(at_x * at_x + at_y * at_y < 1, 1, _OUTSIDE) * (weight_x * weight_y / 4)
            integral[~coarse] += weight * lobe.density(*on_hemisphere(at_x, at_y))
            area[~coarse] += weight
    if coarse.any():
        quarters = np.array([(-1, -1), (1, -1), (1, 1), (-1, 1)]) * half / 2
        parts = _integrals(
            lobe, np.add.outer(quarters[:, 0], x[coarse]), np.add.outer(quarters[:, 1], y[coarse]), half / 2
        )
        integral[coarse], area[coarse] = (part.mean(axis=0) for part in parts)
    return integral, area


def meets_disk(x: Floats, y: Floats, half: float) -> NDArray[np.bool_]:
    """Whether some of a square is inside the disk. x, y: its centre; half: half its side."""
    return np.hypot(np.maximum(np.abs(x) - half, 0), np.maximum(np.abs(y) - half, 0)) < 1


def on_hemisphere(x: Floats, y: Floats) -> tuple[Floats, Floats, Floats]:
    """(x, y, z) above these points of the picture; those outside the disk are drawn in to the horizon."""
    radius = np.maximum(np.hypot(x, y), 1)
    x, y = x / radius, y / radius
    return x, y, np.sqrt(np.maximum(1 - x * x - y * y, 0))


def share_inside(size: int) -> Floats:
    """(size, size): how much of each pixel's square is inside the disk."""
    steps = 32  # columns of a pixel, each of which ends at the circle
    x = (np.arange(size * steps) + 0.5) * 2 / (size * steps) - 1
    top = np.sqrt(1 - x * x) * size / 2  # in pixels above the middle
    pixel = np.abs(np.arange(size) + 0.5 - size / 2) - 0.5  # how far the nearer edge of each row is from it
    return np.stack([np.clip(top - edge, 0, 1).reshape(size, steps).mean(axis=1) for edge in pixel])
