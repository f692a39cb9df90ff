"""Lamps, a panel that shines and a world in light groups, and what shaders give to AOVs, by Cycles and by Pivot."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import bpy
import parts
from cycles_cases import SPHERE, _ball, _cycles, _pivot, on_clay
from visibility_cases import _glossy

GROUPS = ("key", "panel", "sky", "nobody's")


def main(folder: Path) -> Any:
    clay, _ = on_clay()
    layer = bpy.context.view_layer
    for name in GROUPS:
        layer.lightgroups.add(name=name)
    for name, kind in (("tint", "COLOR"), ("height", "VALUE")):
        aov = layer.aovs.add()
        aov.name, aov.type = name, kind
    shiny = _glossy("shiny", 0.4)
    _ball("shiny", (-1.3, 0, 1), shiny)
    _ball("ghost", (1.3, 0, 1), _half_seen())
    glow, _ = parts.shaded("glow", "ShaderNodeEmission", Color=(1, 0.4, 0.2, 1), Strength=2)
    panel = parts.quad("panel", (0, 2.5, 1), glow)
    panel.rotation_euler = (math.radians(90), 0, 0)
    panel.lightgroup = "panel"
    parts.light("key", "POINT", (0, -2, 3.5), energy=150, **SPHERE).lightgroup = "key"
    parts.light("alone", "AREA", (-3, -1, 2), energy=20, size=0.5)
    world = parts.world((0.2, 0.25, 0.3))
    world.lightgroup = "sky"
    for data in (clay, shiny, world):
        _give_aovs(data)
    _cycles(folder / "CYCLES.exr", 2, file_format="OPEN_EXR_MULTILAYER")
    _pivot(folder / "MONTE_CARLO.exr", 2, "JOINT", file_format="OPEN_EXR_MULTILAYER")
    bpy.context.scene.pivot.integrator = "ANALYTIC"
    bpy.context.scene.pivot.indirect = "VSGL"
    _pivot(folder / "ANALYTIC.exr", 2, "JOINT", 8, file_format="OPEN_EXR_MULTILAYER")
    return None


def _half_seen() -> Any:
    """A material that hides a third of what is behind it, and tells AOVs of its own."""
    made, tree = parts.material("ghost")
    mix = tree.nodes.new("ShaderNodeMixShader")
    mix.inputs[0].default_value = 0.3
    for index, kind in enumerate(("Transparent", "Diffuse"), start=1):
        node = tree.nodes.new(f"ShaderNodeBsdf{kind}")
        node.inputs["Color"].default_value = (1, 1, 1, 1)  # by their colours Cycles chooses
        tree.links.new(node.outputs[0], mix.inputs[index])
    tree.links.new(mix.outputs[0], tree.nodes["Material Output"].inputs["Surface"])
    _give_aovs(made)
    return made


def _give_aovs(data: Any) -> None:
    """Where a place is, as a colour, and how high, as a number: by a group."""
    group = bpy.data.node_groups.new("height", "ShaderNodeTree")
    if hasattr(group, "interface"):  # from Blender 4.0
        group.interface.new_socket("Place", in_out="INPUT", socket_type="NodeSocketVector")
    else:
        group.inputs.new("NodeSocketVector", "Place")
    begin, split = group.nodes.new("NodeGroupInput"), group.nodes.new("ShaderNodeSeparateXYZ")
    group.links.new(begin.outputs[0], split.inputs[0])
    group.links.new(split.outputs["Z"], _aov_node(group, "height").inputs["Value"])
    tree = data.node_tree
    user = tree.nodes.new("ShaderNodeGroup")
    user.node_tree = group
    place = tree.nodes.new("ShaderNodeNewGeometry").outputs["Position"]
    tree.links.new(place, user.inputs[0])
    tree.links.new(place, _aov_node(tree, "tint").inputs["Color"])
    _aov_node(tree, "of no pass")


def _aov_node(tree: Any, name: str) -> Any:
    node = tree.nodes.new("ShaderNodeOutputAOV")
    setattr(node, "aov_name" if hasattr(node, "aov_name") else "name", name)
    return node
