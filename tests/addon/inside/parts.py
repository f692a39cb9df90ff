"""Small parts of test scenes."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import bpy

QUAD = ([(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)], [(0, 1, 2, 3)])


def link(name: str, data: Any = None, location: Sequence[float] = (0, 0, 0)) -> Any:
    """A new object in the scene's collection."""
    made = bpy.data.objects.new(name, data)
    made.location = location
    bpy.context.scene.collection.objects.link(made)
    return made


def quad(name: str, location: Sequence[float] = (0, 0, 0), material: Any = None) -> Any:
    """A 2 m square facing +z."""
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(QUAD[0], [], QUAD[1])
    if material:
        mesh.materials.append(material)
    return link(name, mesh, location)


def camera(location: Sequence[float] = (0, 0, 5), rotation: Sequence[float] = (0, 0, 0)) -> Any:
    """The scene's camera; it looks down unless turned."""
    made = link("Camera", bpy.data.cameras.new("Camera"), location)
    made.rotation_euler = rotation
    bpy.context.scene.camera = made
    return made


def light(name: str, kind: str, location: Sequence[float] = (0, 0, 0), **settings: Any) -> Any:
    data = bpy.data.lights.new(name, kind)
    for key, value in settings.items():
        setattr(data, key, value)
    return link(name, data, location)


def material(name: str) -> tuple[Any, Any]:
    """A material with an empty node tree but for its output, and the tree."""
    made = bpy.data.materials.new(name)
    if bpy.app.version < (5, 0):
        made.use_nodes = True
    tree = made.node_tree
    for node in list(tree.nodes):
        if node.type != "OUTPUT_MATERIAL":
            tree.nodes.remove(node)
    return made, tree


def shaded(name: str, kind: str, **inputs: Any) -> tuple[Any, Any]:
    """A material of one shader node, and the node. inputs: by socket name, underscores for spaces."""
    made, tree = material(name)
    node = tree.nodes.new(kind)
    for key, value in inputs.items():
        node.inputs[key.replace("_", " ")].default_value = value
    tree.links.new(node.outputs[0], tree.nodes["Material Output"].inputs["Surface"])
    return made, node


def world(radiance: Sequence[float]) -> Any:
    made = bpy.data.worlds.new("World")
    if bpy.app.version < (5, 0):
        made.use_nodes = True
    background = made.node_tree.nodes["Background"]
    background.inputs["Color"].default_value = (*radiance, 1)
    bpy.context.scene.world = made
    return made


def size(width: int, height: int) -> None:
    render = bpy.context.scene.render
    render.resolution_x, render.resolution_y, render.resolution_percentage = width, height, 100


def clear() -> None:
    """An empty scene of 16 x 16 pixels, the addon enabled."""
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    size(16, 16)


def render_steady(path: Path, engine: str, samples: int = 1, filter_px: float = 0.01) -> None:
    """Samples at each pixel's centre, or about it, as an EXR of 32 bits."""
    scene = bpy.context.scene
    scene.render.engine = engine
    if engine == "CYCLES":
        scene.cycles.device, scene.cycles.samples, scene.cycles.filter_width = "CPU", samples, filter_px
        scene.cycles.use_denoising = scene.cycles.use_adaptive_sampling = False
    else:
        scene.pivot.samples, scene.render.filter_size = samples, filter_px
    scene.render.image_settings.file_format, scene.render.image_settings.color_depth = "OPEN_EXR", "32"
    scene.render.filepath = str(path)
    bpy.ops.render.render(write_still=True)
