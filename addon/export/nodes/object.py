"""Nodes that tell what a mesh and an object keep for shaders."""

from __future__ import annotations

from ..program import Value
from .geometry import mesh_attribute
from .row import Node, Row

_OBJECT_INFO = {
    "Location": "object_location",
    "Color": "object_color",
    "Alpha": "object_alpha",
    "Object Index": "object_index",
    "Random": "object_random",
}
_HAIR_INFO = {"Is Strand": "is_strand", "Thickness": "strand_thickness", "Tangent Normal": "strand_tangent_normal"}
_KINDS = {"OBJECT": "object", "INSTANCER": "instancer", "VIEW_LAYER": "layer"}


def _attribute(node: Node) -> Value:
    kind, name = node.node.attribute_type, node.node.attribute_name
    if kind == "GEOMETRY":
        value = mesh_attribute(node, f"attribute:{name}")
    else:
        id_ = node.program.attribute_id(f"{_KINDS[kind]}:{name}")
        value = node.op("object_attribute", settings=[id_, 1.0 if kind == "OBJECT" else 0.0])
    return {"Alpha": value[3], "Fac": value[4]}.get(node.output, value[:3])


def _color_attribute(node: Node) -> Value:
    name = node.node.layer_name
    value = mesh_attribute(node, f"attribute:{name}" if name else "color:", 0.0)
    return value[3] if node.output == "Alpha" else value[:3]


def _object_info(node: Node) -> Value:
    if node.output == "Material Index":
        return node.program.number(node.material_index)
    return node.op(_OBJECT_INFO[node.output])


def _particle_info(node: Node) -> Value:
    node.program.attributes.add("particle:")
    if node.output in {"Index", "Random"}:
        return node.op(f"particle_{node.output.lower()}")
    id_ = node.program.attribute_id(f"particle:{node.output}")
    value = node.op("object_attribute", settings=[id_, 0.0])
    return value[0] if node.output in {"Age", "Lifetime", "Size"} else value[:3]


def _hair_info(node: Node) -> Value:
    if node.output in _HAIR_INFO:
        return node.op(_HAIR_INFO[node.output])
    return mesh_attribute(node, f"strand:{node.output.lower()}")[0]


def _point_info(node: Node) -> Value:
    """Of a point cloud's balls, in world space; 0 of all else. [Cycles 4.5 geom/point.h]"""
    value = mesh_attribute(node, f"point:{node.output.lower()}", 0.0)
    if node.output == "Position":
        return node.op("world_from_object_point", value[:3]) * value[3]
    if node.output == "Radius":
        along = node.op("world_from_object_vector", node.program.colour([3**-0.5] * 3))
        return node.op("vector_length", along) * value[0]
    return value[0]


def _volume_info(node: Node) -> Value:
    value = mesh_attribute(node, f"attribute:{node.output.lower()}")
    return value[:3] if node.output == "Color" else value[4]


ROWS: dict[str, Row] = {
    "ATTRIBUTE": _attribute,
    "VERTEX_COLOR": _color_attribute,
    "OBJECT_INFO": _object_info,
    "PARTICLE_INFO": _particle_info,
    "POINT_INFO": _point_info,
    "VOLUME_INFO": _volume_info,
    "HAIR_INFO": _hair_info,
}
