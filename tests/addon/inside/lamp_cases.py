"""Lamps whose nodes vary, each above a part of the ground of its own, rendered by Cycles and by Pivot."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import bpy
import parts
from cycles_cases import _cycles, _pivot

IES = """IESNA:LM-63-1995
TILT=NONE
1 1000 1 7 3 1 2 0 0 0
1 1 50
0 15 30 45 60 75 90
0 45 90
1000 900 700 300 120 40 5
900 850 500 350 200 60 5
700 650 300 250 300 90 5
"""


def main(folder: Path) -> None:
    parts.clear()
    parts.size(64, 32)
    camera = parts.camera((0, 0, 20)).data
    camera.type, camera.ortho_scale = "ORTHO", 16
    ground = parts.quad("ground", material=parts.shaded("ground", "ShaderNodeBsdfDiffuse", Color=(0.8, 0.7, 0.6, 1))[0])
    ground.scale = (9, 9, 1)
    for place, make in enumerate((_measured, _falling, _checkered, _pictured)):
        lamp = make()
        lamp.location = (4 * place - 6, 0, 1.5)
        lamp.rotation_euler = (0.3, -0.2, 0.5)
    _cycles(folder / "lamps_CYCLES.exr", 0)
    _pivot(folder / "lamps_MONTE_CARLO.exr", 0, "JOINT")


def _lamp(kind: str, **settings: Any) -> tuple[Any, Any, Any]:
    """A light, its nodes, and the input that these are to feed."""
    lamp = parts.light(kind.lower(), kind, **settings)
    lamp.data.use_nodes = True
    tree = lamp.data.node_tree
    return lamp, tree, tree.nodes["Emission"].inputs


def _measured() -> Any:
    lamp, tree, inputs = _lamp("POINT", energy=1.5, shadow_soft_size=0.05)
    node = tree.nodes.new("ShaderNodeTexIES")
    node.mode, node.ies = "INTERNAL", bpy.data.texts.new("ies")
    node.ies.write(IES)
    tree.links.new(node.outputs[0], inputs["Strength"])
    return lamp


def _falling() -> Any:
    lamp, tree, inputs = _lamp("SPOT", energy=30, spot_size=math.radians(70), shadow_soft_size=0.05)
    node = tree.nodes.new("ShaderNodeLightFalloff")
    node.inputs["Strength"].default_value, node.inputs["Smooth"].default_value = 1.0, 0.5
    tree.links.new(node.outputs["Linear"], inputs["Strength"])
    return lamp


def _checkered() -> Any:
    lamp, tree, inputs = _lamp("SPOT", energy=60, spot_size=math.radians(70), shadow_soft_size=0.0)
    node, place = tree.nodes.new("ShaderNodeTexChecker"), tree.nodes.new("ShaderNodeTexCoord")
    node.inputs["Scale"].default_value = 6
    tree.links.new(place.outputs["Normal"], node.inputs["Vector"])
    tree.links.new(node.outputs["Color"], inputs["Color"])
    return lamp


def _pictured() -> Any:
    lamp, tree, inputs = _lamp("AREA", energy=30, shape="RECTANGLE", size=1.5, size_y=1.0)
    image = bpy.data.images.new("halves", 4, 4)
    image.pixels.foreach_set([1.0, 0.1, 0.1, 1.0, 1.0, 1.0, 0.1, 1.0, 0.1, 0.1, 1.0, 1.0, 0.1, 1.0, 0.1, 1.0] * 4)
    node, place = tree.nodes.new("ShaderNodeTexImage"), tree.nodes.new("ShaderNodeNewGeometry")
    node.image = image
    tree.links.new(place.outputs["Parametric"], node.inputs["Vector"])
    tree.links.new(node.outputs["Color"], inputs["Color"])
    return lamp
