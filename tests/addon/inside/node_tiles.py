"""A plane of tiles, each the emission of one node, as both engines render it."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import bpy
import parts

COLUMNS = 24


def tiles(kinds: Iterator[tuple[str, Callable[[Any, Any], Any]]], tile_px: int) -> dict[str, Any]:
    """Make an empty scene of a tile for each kind, a function of a node tree and of the tile's middle.

    Returns the names of the tiles from the lower left, row by row, "" for what this Blender does not have.
    """
    parts.clear()
    names = []
    for index, (name, make) in enumerate(kinds):
        middle = (2 * (index % COLUMNS) + 1, 2 * (index // COLUMNS) + 1, 0)
        names.append(name if _tile(name, make, middle) else "")
    rows = math.ceil(len(names) / COLUMNS)
    width_m, height_m = 2 * COLUMNS, 2 * rows
    camera = parts.camera((width_m / 2, height_m / 2, 100))
    camera.data.sensor_width = 36
    camera.data.lens = 100 * 36 / max(width_m, height_m)
    parts.size(tile_px * COLUMNS, tile_px * rows)
    return {"names": names, "columns": COLUMNS, "tile_px": tile_px}


def _tile(name: str, make: Callable[[Any, Any], Any], middle: Any) -> bool:
    material, emission = parts.shaded(name, "ShaderNodeEmission")
    tree = emission.id_data
    try:
        output = make(tree, middle)
    except (TypeError, RuntimeError, AttributeError):
        return False
    tree.links.new(output, emission.inputs["Strength" if output.type == "VALUE" else "Color"])
    parts.quad(name, middle, material)
    return True


def render(engine: str, path: Path) -> None:
    """At the pixels' centres."""
    scene = bpy.context.scene
    scene.render.engine = engine
    if engine == "CYCLES":
        scene.cycles.device, scene.cycles.samples = "CPU", 1
        scene.cycles.use_denoising = scene.cycles.use_adaptive_sampling = False
        scene.cycles.filter_width = 0.01
    else:
        scene.pivot.samples = 1
    render = scene.render
    render.filter_size = 0.01
    render.image_settings.file_format, render.image_settings.color_depth = "OPEN_EXR", "32"
    render.filepath = str(path)
    bpy.ops.render.render(write_still=True)
