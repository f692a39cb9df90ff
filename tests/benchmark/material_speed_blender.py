"""Inside Blender as a module: the balls of monte_carlo_scenes.py in the materials of material_speed.py.

material_speed_blender.py IMAGES < JOBS: does the jobs (see monte_carlo_worker.py) with the images of a folder.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

import bpy

# isort: split
import monte_carlo_blender
import monte_carlo_renderers as renderers
import monte_carlo_scenes as scenes
import monte_carlo_worker as worker
import numpy as np

PROCEDURAL = ("Noise", "Voronoi", "Wave", "Magic", "Brick", "Checker")
TEXTURES = 30
MIX_A, MIX_B, MIX_RESULT = 6, 7, 2  # of a Mix node's sockets, those of colours

Dress = Callable[[Any, Any], None]  # (node tree, its BSDF)


def build(dress: Dress) -> None:
    monte_carlo_blender.build(scenes.SCENES["balls"])
    for shape in bpy.context.scene.objects:
        if shape.type == "MESH":
            unwrap(shape.data)
            tree = shape.data.materials[0].node_tree
            dress(tree, next(node for node in tree.nodes if node.type.startswith("BSDF")))


def unwrap(mesh: Any) -> None:
    """By longitude and latitude of what is round, from above of what is flat."""
    positions, corners = np.empty(3 * len(mesh.vertices), np.float32), np.empty(len(mesh.loops), np.int32)
    mesh.vertices.foreach_get("co", positions)
    mesh.loops.foreach_get("vertex_index", corners)
    x, y, z = positions.reshape(-1, 3)[corners].T
    uv = np.stack([x, y], -1) / 2 + 0.5
    if z.any():
        longitude = (np.arctan2(y, x) / (2 * np.pi) % 1).reshape(-1, 3)
        longitude += (longitude < 0.5) & (np.ptp(longitude, axis=1, keepdims=True) > 0.5)  # across the seam
        uv = np.stack([longitude.ravel(), np.arccos(np.clip(-z, -1, 1)) / np.pi], -1)
    mesh.uv_layers.new().data.foreach_set("uv", uv.astype(np.float32).ravel())


def scale_roughness(tree: Any, bsdf: Any, by: Any) -> None:
    scaled = tree.nodes.new("ShaderNodeMath")
    scaled.operation = "MULTIPLY"
    scaled.inputs[1].default_value = bsdf.inputs["Roughness"].default_value
    tree.links.new(by, scaled.inputs[0])
    tree.links.new(scaled.outputs[0], bsdf.inputs["Roughness"])


def dress_in_images(folder: Path, tree: Any, bsdf: Any) -> None:
    def image(name: str) -> Any:
        node = tree.nodes.new("ShaderNodeTexImage")
        node.image = bpy.data.images.load(str(folder / f"{name}.png"), check_existing=True)
        if name != "color":
            node.image.colorspace_settings.name = "Non-Color"
        return node.outputs["Color"]

    tree.links.new(image("color"), bsdf.inputs["Color"])
    scale_roughness(tree, bsdf, image("roughness"))
    normal = tree.nodes.new("ShaderNodeNormalMap")
    tree.links.new(image("normal"), normal.inputs["Color"])
    tree.links.new(normal.outputs["Normal"], bsdf.inputs["Normal"])


def dress_in_textures(tree: Any, bsdf: Any) -> None:
    """The mean of them all."""
    mean = None
    for index in range(TEXTURES):
        texture = tree.nodes.new(f"ShaderNodeTex{PROCEDURAL[index % len(PROCEDURAL)]}")
        if "Scale" in texture.inputs:
            texture.inputs["Scale"].default_value = 4.0 + index
        if mean is None:
            mean = texture.outputs["Color"]
            continue
        mix = tree.nodes.new("ShaderNodeMix")
        mix.data_type = "RGBA"
        mix.inputs[0].default_value = 1 / (index + 1)
        tree.links.new(mean, mix.inputs[MIX_A])
        tree.links.new(texture.outputs["Color"], mix.inputs[MIX_B])
        mean = mix.outputs[MIX_RESULT]
    tree.links.new(mean, bsdf.inputs["Color"])
    scale_roughness(tree, bsdf, mean)


if __name__ == "__main__":
    dresses: dict[str, Dress] = {
        "constants": lambda tree, bsdf: None,
        "images": partial(dress_in_images, Path(sys.argv[1])),
        "procedural": dress_in_textures,
    }
    builders = {name: partial(build, dress) for name, dress in dresses.items()}
    worker.main({"cycles": renderers.Cycles, "pivot": renderers.Pivot}, builders)
