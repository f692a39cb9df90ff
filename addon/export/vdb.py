"""Grids of OpenVDB files, by the module that reads them where Python has it."""

from __future__ import annotations

import importlib
from pathlib import Path
from types import ModuleType
from typing import Any

import bpy
import numpy as np

from .grids import Grid

# The value of voxel (i, j, k) is at (i, j, k) + this. [Cycles 4.5 device/cpu/image.h, Cycles 5.0 util/texture_3d.h]
_CENTRE = 0.0 if bpy.app.version >= (5, 0) else 0.5
_MOST_VOXELS = 1 << 30


def openvdb_module() -> ModuleType | None:
    """Official Blenders bring `openvdb` from 4.4, before that, like Debian, `pyopenvdb`."""
    for name in ("openvdb", "pyopenvdb"):
        try:
            return importlib.import_module(name)
        except ImportError:
            continue
    return None


def read_grid(openvdb: Any, path: Path, name: str) -> Grid | None:
    """A grid of a file over the box that its active voxels fill; None where there is none of the name.

    Raises ValueError for one that is too large.
    """
    if name not in {metadata.name for metadata in openvdb.readAllGridMetadata(str(path))}:
        return None
    grid = openvdb.read(str(path), name)
    if not grid.activeVoxelCount():
        return None
    low, high = grid.evalActiveVoxelBoundingBox()
    size = tuple(b - a + 1 for a, b in zip(low, high, strict=True))
    if np.prod(size, dtype=np.int64) > _MOST_VOXELS:
        raise ValueError(f"its grid '{name}' of {size[0]} x {size[1]} x {size[2]} voxels is too large")
    channels = () if isinstance(grid.zeroValue, int | float) else (3,)
    values = np.zeros((*size, *channels), np.float32)
    grid.copyToArray(values, ijk=low)
    object_from_index = _object_from_index(grid.transform)
    shift = np.eye(4)
    shift[:3, 3] = -np.array(low) - _CENTRE
    across = values.reshape(*size, -1).transpose(2, 1, 0, 3)
    return Grid(np.ascontiguousarray(across), shift @ np.linalg.inv(object_from_index))


def _object_from_index(transform: Any) -> np.ndarray:
    """Of a transform that is affine."""
    origin = np.array(transform.indexToWorld((0, 0, 0)))
    matrix = np.eye(4)
    for axis, place in enumerate(np.eye(3)):
        matrix[:3, axis] = np.array(transform.indexToWorld(tuple(place))) - origin
    matrix[:3, 3] = origin
    return matrix
