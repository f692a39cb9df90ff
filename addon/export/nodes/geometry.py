"""Nodes that tell where a place is on its surface."""

from __future__ import annotations

import bpy

from ..program import Value
from . import lamps
from .row import Node, Row

_TEXTURE_COORDINATES = {
    "Normal": "normal_object",
    "Object": "position_object",
    "Camera": "position_camera",
    "Window": "window",
    "Reflection": "reflection",
}
_GEOMETRY = {
    "Position": "position",
    "Normal": "normal",
    "True Normal": "true_normal",
    "Incoming": "incoming",
    "Parametric": "parametric",
    "Backfacing": "backfacing",
}


def mesh_attribute(node: Node, name: str, missing: float = 1.0) -> Value:
    """Three numbers of a mesh's attribute, a fourth, `missing` where there is no such attribute, and all as one."""
    return node.op("attribute", settings=[node.program.attribute_id(name), missing])


def uv(node: Node, name: str = "") -> Value:
    """Of a UV map, or the active one."""
    return mesh_attribute(node, f"uv:{name}")[:3] if node.lamp_axes is None else lamps.on_lamp(node, "UV")


def generated(node: Node) -> Value:
    """Generated coordinates; of the world, the direction, of a lamp the place."""
    return (
        node.op("position") if node.is_world or node.lamp_axes is not None else mesh_attribute(node, "generated:")[:3]
    )


def _texture_coordinate(node: Node) -> Value:
    from_instancer, target = node.node.from_instancer, node.node.object
    if node.output == "Generated":
        return node.op("instance_generated") if from_instancer else generated(node)
    if node.output == "UV":
        return node.op("instance_uv") if from_instancer else uv(node)
    if node.output == "Object" and target is not None:
        return node.op("position_in", settings=_rows_of_inverse(target))
    if node.lamp_axes is not None and node.output in {"Normal", "Object"}:
        return lamps.on_lamp(node, node.output)
    return node.op(_TEXTURE_COORDINATES[node.output])


def _rows_of_inverse(target: bpy.types.Object) -> list[float]:
    """The upper rows of what takes world space to an object's."""
    matrix = target.matrix_world.inverted_safe()
    return [number for row in matrix[:3] for number in row]


def _uv_map(node: Node) -> Value:
    if node.node.from_instancer:
        return node.op("instance_uv")
    return uv(node, node.node.uv_map)


def _geometry(node: Node) -> Value:
    if node.output == "Normal":
        return node.normal()
    if node.output in _GEOMETRY:
        return node.op(_GEOMETRY[node.output])
    if node.output == "Tangent":
        return default_tangent(node)
    if node.output == "Random Per Island":
        return mesh_attribute(node, "island:")[0]
    return mesh_attribute(node, "pointiness:", 0.0)[0]


def default_tangent(node: Node) -> Value:
    """Along curves; of meshes around z."""
    return node.op("along_curve", _radial_tangent(node, "Z"))


def _radial_tangent(node: Node, axis: str) -> Value:
    centred = generated(node) - 0.5
    x, y, z = (centred[i] for i in range(3))
    zero = node.program.number(0.0)
    parts = {"X": (zero, 0.0 - z, y), "Y": (0.0 - z, zero, x), "Z": (0.0 - y, x, zero)}[axis]
    return node.op("tangent", *parts)


def _tangent(node: Node) -> Value:
    if node.node.direction_type == "RADIAL":
        return _radial_tangent(node, node.node.axis)
    return node.op("tangent", mesh_attribute(node, f"tangent:{node.node.uv_map}", 0.0)[:3])


def _wireframe(node: Node) -> Value:
    return node.op("wireframe", node.number("Size"), settings=[node.node.use_pixel_size])


ROWS: dict[str, Row] = {
    "TEX_COORD": _texture_coordinate,
    "UVMAP": _uv_map,
    "NEW_GEOMETRY": _geometry,
    "TANGENT": _tangent,
    "WIREFRAME": _wireframe,
}
