"""Shader AOVs: what AOV Output nodes hand to passes that a view layer names."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import bpy

from .nodes import Owner, Socket, colour, number
from .program import Value
from .surface import Surface


def valid_aovs(view_layer: bpy.types.ViewLayer) -> list[Any]:
    """In the order of the core's."""
    return [aov for aov in view_layer.aovs if aov.is_valid]


def aov_shaders(tree: bpy.types.NodeTree, owner: Owner, view_layer: bpy.types.ViewLayer) -> list[tuple[int, Any]]:
    """Each AOV that a material's or world's tree gives, by its place, and the core's shader that emits its value."""
    places = {aov.name: (place, aov.type) for place, aov in enumerate(valid_aovs(view_layer))}
    shaders = []
    for node, groups in _output_nodes(tree, ()) if places else ():
        place, kind = places.get(_name_of(node), (None, ""))
        if place is None:
            continue
        try:
            value = _value(Socket(node.inputs["Color" if kind == "COLOR" else "Value"], groups), owner)
        except RecursionError:
            owner.warn(node, "its nodes form a loop, its AOV is black")
            continue
        shaders.append((place, Surface.of(owner.program, emission=value).core_shader(owner.program.core)))
    return shaders


def _value(target: Socket, owner: Owner) -> Value:
    return colour(target, owner) if target.socket.name == "Color" else number(target, owner).widened()


def _name_of(node: Any) -> str:
    """Before Blender 4.2 a node of this kind had no other name."""
    return str(getattr(node, "aov_name", node.name))


def _output_nodes(
    tree: bpy.types.NodeTree, groups: tuple[bpy.types.Node, ...]
) -> Iterator[tuple[Any, tuple[bpy.types.Node, ...]]]:
    for node in tree.nodes:
        if node.mute:
            continue
        if node.type == "OUTPUT_AOV":
            yield node, groups
        elif node.type == "GROUP" and node.node_tree:
            yield from _output_nodes(node.node_tree, (*groups, node))
