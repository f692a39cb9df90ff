"""A GGX lobe around each of many normals, summed: a convolution on the sphere. Needs NumPy alone.

On rings about the pole it is one along each pair of rings, which is a product of Fourier series.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[Any]

SMALLEST_ALPHA = 0.01  # what rings can be made for in little time

_FARTHEST = 16.0  # alphas between two rings beyond which GGX is left out: 0.4 % of it at most
_BEYOND = 2  # rings on either side of the hemisphere, for cubic interpolation


@dataclass(frozen=True)
class Rings:
    """Values at polar angles (i + 1/2) step and azimuths j step, four times as many as rings down to the horizon."""

    count: int

    @property
    def step(self) -> float:
        return math.pi / 2 / self.count

    def around(self, h: Array) -> Iterator[tuple[Array, Array]]:
        """The nodes around unit vectors (n, 3), into an array of shape(), and their weights by cubic interpolation."""
        ring = np.arctan2(np.hypot(h[:, 0], h[:, 1]), h[:, 2]) / self.step - 0.5 + _BEYOND
        turn = np.arctan2(h[:, 1], h[:, 0]) / self.step
        rows, columns = np.floor(ring), np.floor(turn)
        down, along = _cubic(ring - rows), _cubic(turn - columns)
        for i in range(4):
            for j in range(4):
                row = rows.astype(np.intp) + (i - 1)
                column = (columns.astype(np.intp) + (j - 1)) % (4 * self.count)
                yield row * (4 * self.count) + column, down[i] * along[j]

    def shape(self) -> tuple[int, int]:
        return self.count + 2 * _BEYOND, 4 * self.count


def _cubic(x: Array) -> tuple[Array, Array, Array, Array]:
    """Lagrange's weights of values at -1, 0, 1 and 2."""
    return (
        -x * (x - 1) * (x - 2) / 6,
        (x + 1) * (x - 1) * (x - 2) / 2,
        -(x + 1) * x * (x - 2) / 2,
        (x + 1) * x * (x - 1) / 6,
    )


def rings_for(alpha: float) -> Rings:
    """With four steps in alpha, and an even number of rings."""
    return Rings(2 * math.ceil(max(math.pi / alpha, 16)))


def spread(rings: Rings, normals: Array, areas: Array, alpha: float) -> Array:
    """rings.shape(): the sum of area D_GGX(h.n) over unit normals (n, 3) of the upper hemisphere, at each node h."""
    shape = rings.shape()
    sources = np.zeros(shape[0] * shape[1])
    for nodes, weights in rings.around(normals):
        sources += np.bincount(nodes, weights * areas, sources.size)
    sources = sources.reshape(shape)
    beyond_pole = np.roll(
        sources[:_BEYOND][::-1], shape[1] // 2, axis=1
    )  # rings there are those before, turned by half
    sources = sources[_BEYOND:]
    sources[:_BEYOND] += beyond_pole
    series = _convolved(np.fft.rfft(sources, axis=1), rings, alpha)
    values = np.fft.irfft(series, shape[1], axis=1)
    return np.concatenate((np.roll(values[:_BEYOND][::-1], shape[1] // 2, axis=1), values))


def _convolved(sources: Array, rings: Rings, alpha: float) -> Array:
    """Fourier series along each ring, of all pairs of rings that are near each other."""
    count, turns = sources.shape[0], 4 * rings.count
    angles = (np.arange(count) + 0.5) * rings.step
    cosines, sines, turn = np.cos(angles), np.sin(angles), np.cos(np.arange(turns) * rings.step)
    band = math.ceil(_FARTHEST * alpha / rings.step)
    filled = np.abs(sources).max(axis=1) > 0
    spread = np.zeros_like(sources)
    for i in range(count):
        first = max(0, i - band)
        if not filled[first : i + 1].any():
            continue
        h_n = np.outer(sines[first : i + 1] * sines[i], turn) + cosines[first : i + 1, None] * cosines[i]
        t = 1 - (1 - alpha * alpha) * h_n * h_n
        kernels = np.fft.rfft(np.where(h_n > 0, alpha * alpha / math.pi / (t * t), 0), axis=1)  # the same either way
        spread[i] += (kernels * sources[first : i + 1]).sum(axis=0)
        if filled[i]:
            spread[first:i] += kernels[:-1] * sources[i]
    return spread
