"""Bumpy sheets of flat and smooth faces, sharp edges and normals of their own, which emit their normals: tiles by
Cycles and by Pivot, as files."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import bpy
import numpy as np
import parts

TILE_PX = 48
FLAT = (0, 4)  # of six faces
KINDS = {  # the flat faces, whether an edge is sharp, whether corners have normals of their own
    "smooth": ((), False, False),
    "flat": (range(6), False, False),
    "mixed": (FLAT, False, False),
    "sharp edge": ((), True, False),
    "mixed, sharp edge": (FLAT, True, False),
    "custom": ((), False, True),
    "mixed, custom": (FLAT, False, True),
}


def main(folder: Path) -> Any:
    """Returns the names of the tiles."""
    parts.clear()
    material = _emitting_its_normal()
    for column, (name, settings) in enumerate(KINDS.items()):
        mesh = _sheet(name, *settings)
        mesh.materials.append(material)
        parts.link(name, mesh, (2.5 * column + 1.25, 0, 0))
    camera = parts.camera((1.25 * len(KINDS), 0, 60))
    camera.data.sensor_width = 36
    camera.data.lens = 60 * 36 / (2.5 * len(KINDS))
    parts.size(TILE_PX * len(KINDS), TILE_PX)
    for engine in ("PIVOT", "CYCLES"):
        parts.render_steady(folder / f"{engine}.exr", engine)
    return list(KINDS)


def _emitting_its_normal() -> Any:
    """Half of it, and 0.5."""
    material, emission = parts.shaded("normal", "ShaderNodeEmission")
    tree = emission.id_data
    geometry, scaled = tree.nodes.new("ShaderNodeNewGeometry"), tree.nodes.new("ShaderNodeVectorMath")
    scaled.operation = "MULTIPLY_ADD"
    scaled.inputs[1].default_value = scaled.inputs[2].default_value = (0.5, 0.5, 0.5)
    tree.links.new(geometry.outputs["Normal"], scaled.inputs[0])
    tree.links.new(scaled.outputs[0], emission.inputs["Color"])
    return material


def _sheet(name: str, flat: Any, has_sharp_edge: bool, has_custom: bool) -> Any:
    """Two rows of three quads that are not planar."""
    x, y = np.meshgrid(np.linspace(-1, 1, 4), np.linspace(-1, 1, 3))
    z = 0.5 * np.cos(1.3 * x + 0.4) * np.cos(1.1 * y - 0.3) + 0.2 * x * y
    corners = [(4 * row + column, 4 * row + column + 1) for row in range(2) for column in range(3)]
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(np.stack([x, y, z], -1).reshape(-1, 3).tolist(), [], [(a, b, b + 4, a + 4) for a, b in corners])
    mesh.polygons.foreach_set("use_smooth", [face not in flat for face in range(6)])
    if bpy.app.version < (4, 1):
        mesh.use_auto_smooth, mesh.auto_smooth_angle = has_sharp_edge or has_custom, 3.14159
    if has_sharp_edge:
        next(edge for edge in mesh.edges if set(edge.vertices) == {5, 6}).use_edge_sharp = True
    if has_custom:
        normals = np.random.default_rng(1).normal(size=(len(mesh.loops), 3))
        normals[:, 2] = np.abs(normals[:, 2]) + 2
        mesh.normals_split_custom_set((normals / np.linalg.norm(normals, axis=1)[:, None]).tolist())
    return mesh
