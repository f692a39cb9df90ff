"""Nodes that lamps alone have a use for, and what the coordinates of others mean on a lamp.

[C] is Cycles 4.5: kernel/svm/light_path.h and ies.h, scene/shader_nodes.cpp.
"""

from __future__ import annotations

import math

import bpy

from ..ies import IesError, ies_picture
from ..program import Value
from .row import Node, Row

_LINEAR, _EXTEND = 1, 1  # the core's


def on_lamp(node: Node, output: str) -> Value:
    """An output of Texture Coordinate on a lamp: in place of a UV map, 0 to 1 over an area light. [C]"""
    if output == "Normal":
        return _in_own_axes(node, node.op("normal"))
    if output == "UV":
        return node.op("parametric")
    return node.op("position")


def _in_own_axes(node: Node, direction: Value) -> Value:
    """From world space, unit."""
    axes = (node.program.colour(axis) for axis in node.lamp_axes)
    return node.op(
        "vector_normalize", node.program.joined(*(node.op("vector_dot_product", direction, axis) for axis in axes))
    )


def _light_falloff(node: Node) -> Value:
    """[C]"""
    strength, smooth = node.number("Strength"), node.number("Smooth")
    if node.output == "Quadratic" and smooth.is_always(0):
        return strength
    distance = node.op("ray_length")
    squared = distance * distance
    if not smooth.is_always(0):
        strength = strength * (squared / (smooth.at_least(0.0) + squared))
    return strength * {"Quadratic": 1.0, "Linear": distance, "Constant": squared}[node.output]


def _ies(node: Node) -> Value:
    """A picture of what the file says, looked up by direction. [C]"""
    try:
        image = node.program.images.sky(("IES", _ies_text(node.node)), lambda: ies_picture(_ies_text(node.node)))
    except (OSError, IesError) as error:
        node.warn(f"its IES file cannot be read ({error}), it is 1. Fix: choose another")
        return node.number("Strength")
    vector = node.vector("Vector") if node.is_linked("Vector") else on_lamp(node, "Normal")
    direction, program = node.op("vector_normalize", vector), node.program
    around = program.each("math_arctan2", direction[0], direction[1]) * (0.5 / math.pi) + 0.5
    down = program.each("math_arccosine", 0.0 - direction[2]) * (1 / math.pi)
    at = program.joined(around, down)
    return node.number("Strength") * node.op("image", at, at, at, settings=[_LINEAR, _EXTEND, 0, 0], image=image)[0]


def _ies_text(blender_node: bpy.types.ShaderNodeTexIES) -> str:
    if blender_node.mode == "INTERNAL":
        if blender_node.ies is None:
            raise IesError("it has none")
        return str(blender_node.ies.as_string())
    with open(bpy.path.abspath(blender_node.filepath), encoding="latin-1") as file:
        return file.read()


ROWS: dict[str, Row] = {"LIGHT_FALLOFF": _light_falloff, "TEX_IES": _ies}
