"""Volume objects: the OpenVDB file of one at the frame, and the box around its grids."""

from __future__ import annotations

import functools
from pathlib import Path
from typing import Any

import bpy
import numpy as np
from numpy.typing import NDArray

from ..report import Reporter
from .grids import Grid, Grids, Lattice
from .vdb import openvdb_module, read_grid


def volume_grids(
    blender_object: bpy.types.Object, object_to_world: NDArray[np.float32], reporter: Reporter
) -> Grids | None:
    """Those of an evaluated Volume object's file; None, which is reported, where they cannot be read."""
    where, data = f"object '{blender_object.name}'", blender_object.data
    openvdb = openvdb_module()
    if openvdb is None:
        reporter.warn(
            f"{where}: this Blender's Python has no module to read OpenVDB files, it is left out. Fix: use a Blender "
            "from blender.org, or with Debian's install python3-openvdb"
        )
        return None
    if not data.filepath:
        reporter.warn(f"{where}: volumes that modifiers or geometry nodes make are not supported, it is left out")
        return None
    data.grids.load()
    path = Path(bpy.path.abspath(data.grids.frame_filepath or data.filepath, library=data.original.library))
    if not path.is_file():
        reporter.warn(f"{where}: there is no file '{path}', it is left out. Fix: correct the path of its volume")
        return None
    if any(modifier.show_render for modifier in blender_object.modifiers):
        reporter.warn(f"{where}: modifiers of volumes are not supported, it is shown as its file has it")

    def read(name: str) -> Grid | None:
        try:
            return read_grid(openvdb, path, name)
        except (ValueError, OSError, RuntimeError) as error:
            reporter.warn(f"{where}: {error}, it is left out")
            return None

    scale = _density_scale(object_to_world) if data.render.space == "OBJECT" else 1.0
    return Grids(functools.cache(read), key=(str(path), scale), density_scale=scale)


def _density_scale(object_to_world: NDArray[np.float32]) -> float:
    """How much thinner a volume is as its object is larger. [Cycles 4.5 scene/object.cpp, object_volume_density]"""
    return 1 / float(np.linalg.norm(object_to_world[:3, :3].astype(float) @ np.full(3, 3**-0.5)))


def box_arrays(lattice: Lattice) -> dict[str, Any]:
    """The box beyond which all has fallen to 0, as pivot_core.Scene.add_mesh takes it; its faces look out."""
    quads = np.array([(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)], np.int32)
    if np.linalg.det(lattice.grid_from_object[:3, :3]) < 0:
        quads = quads[:, ::-1]
    return {
        "positions": np.ascontiguousarray(lattice.corners(1)[:, :3], np.float32),
        "corner_vertices": quads.reshape(-1),
        "triangle_corners": (4 * np.arange(6)[:, None, None] + np.array([(0, 1, 2), (0, 2, 3)]))
        .reshape(-1, 3)
        .astype(np.int32),
    }
