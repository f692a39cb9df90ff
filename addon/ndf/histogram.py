"""Pictures of the distribution of normals that a normal map or a height map has. Needs NumPy alone.

The map repeats, and is a surface interpolated bilinearly between its texels' centres; each equal part of its area
counts in the pixel of its normal, as draw.py lays out pixels. A surface that is rough itself has a GGX lobe around each
normal: D(h) is the mean over the area of D_GGX(h.n) / n.z, for facets over the plane are larger than it by 1 / n.z.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .draw import meets_disk, on_hemisphere, share_inside
from .spread import SMALLEST_ALPHA, rings_for, spread

Floats = NDArray[np.float32]
Corners = tuple[Floats, Floats, Floats, Floats]  # (3, rows, columns) normals of any length: left, right, both above

_SAMPLES = 24_000_000  # of a whole map, with two along a texel's side at least
_MOST = 64  # along a texel's side
_CHUNK = 1 << 17  # texels that are sampled at once
_PER_ALPHA = 5  # cells that normals are gathered in, and points of a pixel, along the lobe's alpha
_WIDEST = 0.25  # alpha for these
_SLIVER = 1e-3  # of a pixel at least is inside the disk where a normal is in it


def normal_map_patches(texels: Floats, is_directx: bool = False) -> Iterator[Corners]:
    """texels: (height, width, 3 or more) of a tangent-space normal map, 0 to 1, the bottom row first.

    Raises ValueError where a normal looks into the surface.
    """
    normals = 2 * np.moveaxis(texels[..., :3], 2, 0) - 1
    if is_directx:
        normals[1] *= -1
    inward = int((normals[2] <= 0).sum())
    if inward:
        raise ValueError(
            f"{inward} of its {normals[2].size} texels look into the surface (blue is 0.5 or less), so it is no normal "
            "map of tangent space"
        )
    return _patches(normals)


def height_map_patches(heights: Floats, depth: float) -> Iterator[Corners]:
    """heights: (height, width), the bottom row first; depth: how far 1 is above 0, in widths of the map."""
    heights = heights[None] * np.float32(depth * heights.shape[1])
    for left, right, left_above, right_above in _patches(heights):
        below, above = left - right, left_above - right_above  # slopes along x, turned to normals
        before, behind = left - left_above, right - right_above
        up = np.ones_like(left)
        yield tuple(
            np.concatenate((x, y, up)) for x, y in ((below, before), (below, behind), (above, before), (above, behind))
        )


def _patches(field: NDArray[Any]) -> Iterator[Corners]:
    """The values at the corners of the squares between texels' centres, some rows of them at once."""
    field = np.pad(field, ((0, 0), (0, 1), (0, 1)), mode="wrap")
    height, width = field.shape[1] - 1, field.shape[2] - 1
    step = max(1, _CHUNK // width)
    for first in range(0, height, step):
        below = field[:, first : min(first + step, height)]
        above = field[:, first + 1 : min(first + step, height) + 1]
        yield below[:, :, :-1], below[:, :, 1:], above[:, :, :-1], above[:, :, 1:]


def histogram(size: int, patches: Iterable[Corners], texels: int, alpha: float = 0.0) -> Floats:
    """(size, size). texels: that the patches are of; alpha: of the GGX lobe around each normal, 0 for none.

    A lobe narrower than SMALLEST_ALPHA is drawn as one that is as wide.
    """
    side = min(max(2, math.ceil(math.sqrt(_SAMPLES / texels))), _MOST)
    normals = (normal for corners in patches for normal in _interpolated(corners, side))
    share = 1 / (texels * side * side)
    if alpha > 0:
        return _lobes(size, normals, share, alpha)
    counts = np.zeros(size * size, np.int64)
    for x, y, _ in normals:
        counts += np.bincount(_pixel(x, y, size), minlength=size * size)
    areas = np.maximum(share_inside(size), _SLIVER) * 4 / size**2
    return (counts.reshape(size, size) * share / areas).astype(np.float32)


def _interpolated(corners: Corners, side: int) -> Iterator[tuple[Floats, Floats, Floats]]:
    """x, y and z of unit normals at side * side points within each square, a row of them at once."""
    left, right, left_above, right_above = corners
    fractions = (np.arange(side, dtype=np.float32) + np.float32(0.5)) / np.float32(side)
    for up in fractions:
        start = left + (left_above - left) * up
        change = right + (right_above - right) * up - start
        x, y, z = (start[:, None] + change[:, None] * fractions[:, None, None]).reshape(3, -1)
        scale = 1 / np.sqrt(x * x + y * y + z * z)
        yield x * scale, y * scale, z * scale


def _pixel(x: Floats, y: Floats, size: int) -> NDArray[np.intp]:
    half = np.float32(size / 2)
    column = np.minimum(((x + 1) * half).astype(np.intp), size - 1)
    return np.minimum(((y + 1) * half).astype(np.intp), size - 1) * size + column


def _lobes(size: int, normals: Iterable[tuple[Floats, Floats, Floats]], share: float, alpha: float) -> Floats:
    alpha = max(alpha, SMALLEST_ALPHA)
    cells = math.ceil(2 * _PER_ALPHA / min(alpha, _WIDEST))
    sums = np.zeros((4, cells * cells))  # of the facets' areas, and of their normals
    for x, y, z in normals:
        area = 1 / z
        cell = _pixel(x, y, cells)
        for total, value in zip(sums, (area, x * area, y * area, z * area), strict=True):
            total += np.bincount(cell, value, cells * cells)
    sums = sums[:, sums[0] > 0]
    means = (sums[1:] / np.linalg.norm(sums[1:], axis=0)).T
    rings = rings_for(alpha)
    values = spread(rings, means, sums[0] * share, alpha).ravel()
    finer = math.ceil(2 * _PER_ALPHA / (size * alpha))  # points along a pixel
    centres = (np.arange(size * finer) + 0.5) * 2 / (size * finer) - 1
    pixels = centres.reshape(size, finer).mean(axis=1)
    picture = np.zeros((size, size), np.float32)
    for row in range(size):
        x, y = np.meshgrid(centres, centres[row * finer : (row + 1) * finer])
        h = np.stack([part.ravel() for part in on_hemisphere(x, y)], axis=1)
        points = sum(values[nodes] * weights for nodes, weights in rings.around(h))
        picture[row] = points.reshape(finer, size, finer).mean(axis=(0, 2))
    x, y = np.meshgrid(pixels, pixels)
    return np.where(meets_disk(x, y, 1 / size), np.maximum(picture, 0), 0)  # interpolation swings below 0
