"""An OpenVDB file of smoke, for fog.py: by Debian's pyopenvdb, which bpy's wheels lack."""

from __future__ import annotations

import importlib
import sys
from pathlib import Path
from typing import Any

import numpy as np

DIST_PACKAGES = "/usr/lib/python3/dist-packages"
VOXEL_M = 1 / 32
SIZE = (104, 80, 66)


def find_openvdb() -> Any:
    """The module, where Debian's serves this Python; Pivot's addon finds it from then on."""
    if DIST_PACKAGES not in sys.path:
        sys.path.append(DIST_PACKAGES)
    try:
        return importlib.import_module("pyopenvdb")
    except ImportError:
        return None


def write(path: Path) -> None:
    """Puffs within 3.2 x 2.5 x 2 m about the origin; density 0..1 or a little more. Raises RuntimeError."""
    openvdb = find_openvdb()
    if openvdb is None:
        raise RuntimeError("smoke needs pyopenvdb: install Debian's python3-openvdb")
    random = np.random.default_rng(3)
    half = np.multiply(SIZE, VOXEL_M) / 2
    axes = [np.linspace(-h, h, n) for h, n in zip(half, SIZE, strict=True)]
    points = np.stack(np.meshgrid(*axes, indexing="ij"), -1)
    density = np.zeros(SIZE)
    for _ in range(60):
        center, radius_m = random.normal(size=3) * half * 0.35, random.uniform(0.12, 0.4)
        density += random.uniform(0.2, 0.9) * np.exp(-((points - center) ** 2).sum(-1) / radius_m**2)
    ripples = sum(np.sin(points @ random.normal(size=3) * 14 + random.uniform(0, 6)) for _ in range(12)) / 12
    inside = np.minimum.reduce([1 - (points[..., k] / half[k]) ** 2 for k in range(3)])
    density = (density * (1 + 1.6 * ripples) - 0.15).clip(0) * (4 * inside).clip(0, 1)
    grid = openvdb.FloatGrid()
    grid.name, grid.transform = "density", openvdb.createLinearTransform(voxelSize=VOXEL_M)
    grid.copyFromArray(density.astype(np.float32), ijk=tuple(-n // 2 for n in SIZE))
    path.parent.mkdir(parents=True, exist_ok=True)
    openvdb.write(str(path), grids=[grid])
