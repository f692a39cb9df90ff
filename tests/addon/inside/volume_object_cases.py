"""Volume objects as exported, from files that folder/ has where Python can write them."""

from __future__ import annotations

import sys
from dataclasses import asdict
from pathlib import Path
from typing import Any
from unittest.mock import patch

import bpy
import numpy as np
import parts
from recording import Recording, record

VOXEL_M, LOW = 0.25, (-2, 3, 1)


def main(folder: Path) -> Any:
    vdb = sys.modules["pivot.export.vdb"].openvdb_module()
    path = folder / "cloud_0002.vdb"
    results: dict[str, Any] = {"has_module": vdb is not None, "lacking": _lacking(path)}
    if vdb is None:
        return results
    density, heat = _write(vdb, path)
    results |= {"density": density.tolist(), "temperature": heat.tolist()}
    for make in (_plain, _bare, _world_space, _fire, _sequence, _missing, _generated, _unread):
        parts.clear()
        parts.camera()
        make(path)
        results[make.__name__[1:]] = _values(record())
    return results


def _write(vdb: Any, path: Path) -> tuple[Any, Any]:
    """A density of 4 x 3 x 2 voxels, and a temperature twice as fine on a part of them."""
    density = (np.arange(24, dtype=np.float32).reshape(4, 3, 2) + 1) / 24
    heat = np.full((2, 2, 2), 2.0, np.float32)
    grids = []
    for name, values, voxel_m, low in (
        ("density", density, VOXEL_M, LOW),
        ("temperature", heat, VOXEL_M / 2, (0, 6, 2)),
    ):
        grid = vdb.FloatGrid()
        grid.name, grid.transform = name, vdb.createLinearTransform(voxelSize=voxel_m)
        grid.copyFromArray(values, ijk=low)
        grids.append(grid)
    vdb.write(str(path), grids=grids)
    return density, heat


def _volume(path: Path | str, **inputs: Any) -> Any:
    """A Volume object with a Principled Volume, 2 m to the side and twice as large."""
    data = bpy.data.volumes.new("cloud")
    data.filepath = str(path)
    material, tree = parts.material("cloud")
    node = tree.nodes.new("ShaderNodeVolumePrincipled")
    for key, value in inputs.items():
        node.inputs[key.replace("_", " ")].default_value = value
    tree.links.new(node.outputs[0], tree.nodes["Material Output"].inputs["Volume"])
    data.materials.append(material)
    made = parts.link("cloud", data, (2, 0, 0))
    made.scale = (2, 2, 2)
    return made


def _plain(path: Path) -> None:
    _volume(path, Density=3)


def _bare(path: Path) -> None:
    _volume(path).data.materials.clear()


def _world_space(path: Path) -> None:
    _volume(path, Density=3).data.render.space = "WORLD"


def _fire(path: Path) -> None:
    _volume(path, Density=3, Blackbody_Intensity=1.0, Temperature=1000)


def _sequence(path: Path) -> None:
    data = _volume(path, Density=3).data
    data.is_sequence, data.frame_start, data.frame_duration, data.frame_offset = True, 10, 3, 1
    bpy.context.scene.frame_set(10)


def _missing(path: Path) -> None:
    _volume(path.with_name("nowhere.vdb"))


def _generated(path: Path) -> None:
    _volume("")


def _unread(path: Path) -> None:
    """It asks for a grid that the file has not."""
    _volume(path, Density_Attribute="smoke")


def _lacking(path: Path) -> list[str]:
    """What is said where no module reads the file."""
    parts.clear()
    parts.camera()
    _volume(path)
    with patch.dict(sys.modules, openvdb=None, pyopenvdb=None):
        return record().reports


def _values(recording: Recording) -> Any:
    def plain(value: Any) -> Any:
        if isinstance(value, dict):
            return {key: plain(each) for key, each in value.items()}
        return np.array(value).tolist() if isinstance(value, np.ndarray) else value

    return {
        "media": {name: plain(asdict(medium)) for name, medium in recording.media.items()},
        "without_surface": sorted(recording.without_surface),
        "meshes": {mesh.name: [mesh.positions.tolist(), mesh.corner_vertices.tolist()] for mesh in recording.meshes},
        "triangles": [mesh.triangle_corners.tolist() for mesh in recording.meshes],
        "instances": {group.name: group.materials for group in recording.instances},
        "reports": recording.reports,
    }
