"""Nodes that turn normals, and take vectors from one space to another."""

from __future__ import annotations

import bpy

from ..program import Value
from .geometry import mesh_attribute
from .row import Node, Row

# Footprints to the places that bump mapping compares heights with, where a node does not tell.
DISPLACEMENT_FILTER_WIDTH = 0.1 if bpy.app.version >= (4, 5) else 1.0

# Before Blender 4.0 normals were turned into other spaces as vectors are, and tangent space scaled as the others.
_OLD_NORMALS = bpy.app.version < (4, 0)


def bump_settings(filter_width: float) -> list[float]:
    """Of the op: how far it looks, whether in object space, and whether it keeps normals from mirroring downwards."""
    return [filter_width, 0.0, float(bpy.app.version < (3, 6))]


def _vector_transform(node: Node) -> Value:
    value = node.vector("Vector")
    kind, start, end = (part.lower() for part in (node.node.vector_type, node.node.convert_from, node.node.convert_to))
    steps = [step for step in (f"world_from_{start}", f"{end}_from_world") if step != "world_from_world"]
    if start == end:
        steps = []
    for step in steps:
        is_direction = kind == "normal" and ("camera" in step or _OLD_NORMALS)  # a camera's axes are unit
        value = node.op(f"{step}_{'vector' if is_direction else kind}", value)
    return node.op("vector_normalize", value) if kind == "normal" and (steps or _OLD_NORMALS) else value


def _normal_map(node: Node) -> Value:
    space = node.node.space
    colour, strength = node.colour("Color"), node.number("Strength")
    if getattr(node.node, "convention", "OPENGL") == "DIRECTX":  # since Blender 5.2
        colour = node.program.joined(colour[0], 1.0 - colour[1], colour[2])
    if space == "TANGENT":
        tangent = mesh_attribute(node, f"tangent:{node.node.uv_map}", 0.0)
        if _OLD_NORMALS:
            whole = node.op("normal_map_tangent", colour, node.program.number(1.0), tangent[:4])
            return node.op("normal_part", whole, strength)
        return node.op("normal_map_tangent", colour, strength, tangent[:4])
    if space.startswith("BLENDER_"):  # whose second and third axes are turned round
        colour = node.program.joined(colour[0], 1.0 - colour[1], 1.0 - colour[2])
    return node.op(f"normal_map_{space.removeprefix('BLENDER_').lower()}", colour, strength)


def _bump(node: Node) -> Value:
    normal = node.normal()
    if not node.is_linked("Height"):
        return normal
    width = node.own_value("Filter Width") if node.has("Filter Width") else 1.0
    places = (node, *node.bumped(width))
    heights = node.program.joined(*(place.number("Height") for place in places))
    distance = node.number("Distance")
    if node.node.invert:
        distance = 0.0 - distance
    return node.op("bump", normal, heights, node.number("Strength"), distance, settings=bump_settings(width))


def _displacement(node: Node) -> Value:
    amount = (node.number("Height") - node.number("Midlevel")) * node.number("Scale")
    normal = node.normal()
    if node.node.space == "OBJECT":
        return node.op("world_from_object_vector", node.op("object_from_world_normal", normal) * amount)
    return normal * amount


def _bevel(node: Node) -> Value:
    node.warn("Bevel nodes are not supported, edges stay sharp")
    return node.normal()


def _vector_displacement(node: Node) -> Value:
    node.warn("Vector Displacement nodes are not supported, it displaces nothing")
    return node.program.colour((0, 0, 0))


ROWS: dict[str, Row] = {
    "VECT_TRANSFORM": _vector_transform,
    "NORMAL_MAP": _normal_map,
    "BUMP": _bump,
    "BEVEL": _bevel,
    "DISPLACEMENT": _displacement,
    "VECTOR_DISPLACEMENT": _vector_displacement,
}
