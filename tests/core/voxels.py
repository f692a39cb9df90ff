"""Grids of voxels, and what NumPy makes of them."""

from __future__ import annotations

import numpy as np
import pivot_core
from numpy.typing import NDArray

Floats = NDArray[np.float64]


def grid(values: NDArray[np.floating]) -> pivot_core.VoxelGrid:
    return pivot_core.VoxelGrid(values, np.eye(4))


def smoke(size: tuple[int, int, int], seed: int = 1) -> NDArray[np.float32]:
    """Values (z, y, x) of smooth clouds with holes of nothing between them."""
    rng = np.random.default_rng(seed)
    axes = np.meshgrid(*(np.arange(n) for n in size), indexing="ij")
    waves = sum(
        np.cos(sum(k * axis for k, axis in zip(rng.normal(0, 0.25, 3), axes, strict=True)) + rng.uniform(0, 7))
        for _ in range(6)
    )
    return np.maximum(waves, 0).astype(np.float32)


def interpolated(values: NDArray[np.floating], points: Floats) -> Floats:
    """Linear between voxels (z, y, x), 0 from one voxel beyond them; (N,) at points (N, 3)."""
    padded = np.pad(values.astype(np.float64), 1)
    top = np.array(padded.shape[::-1]) - 1
    inside = np.clip(points + 1, 0, top)
    low = np.minimum(np.floor(inside).astype(int), top - 1)
    along = inside - low
    result = np.zeros(len(points))
    for corner in np.ndindex(2, 2, 2):
        weight = np.prod(np.where(corner, along, 1 - along), axis=1)
        x, y, z = (low + corner).T
        result += weight * padded[z, y, x]
    return result


def integral(values: NDArray[np.floating], origin: Floats, direction: Floats, near: float, far: float) -> float:
    """Along a ray, by the midpoints of many parts."""
    parts = 50_000
    t = near + (far - near) * (np.arange(parts) + 0.5) / parts
    return float(interpolated(values, origin + t[:, None] * direction).mean() * (far - near))
