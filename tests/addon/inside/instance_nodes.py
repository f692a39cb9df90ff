"""Geometry Nodes whose instances keep attributes for their materials."""

from __future__ import annotations

from typing import Any

import bpy


def paired_on_points(shown: Any) -> Any:
    """A pair of instances of an object on each vertex: "kept" is the pair's place, "part" tells its halves apart."""
    tree = bpy.data.node_groups.new("pairs", "GeometryNodeTree")
    for direction in ("INPUT", "OUTPUT"):
        tree.interface.new_socket("Geometry", in_out=direction, socket_type="NodeSocketGeometry")
    start, end = tree.nodes.new("NodeGroupInput"), tree.nodes.new("NodeGroupOutput")
    info = tree.nodes.new("GeometryNodeObjectInfo")
    info.inputs["Object"].default_value, info.inputs["As Instance"].default_value = shown, True
    line = tree.nodes.new("GeometryNodeMeshLine")
    line.inputs["Count"].default_value, line.inputs["Offset"].default_value = 2, (0.1, 0, 0)
    index, place = tree.nodes.new("GeometryNodeInputIndex"), tree.nodes.new("GeometryNodeInputPosition")
    placed = _on_points(tree, line.outputs[0], info.outputs["Geometry"])
    placed.node.inputs["Scale"].default_value = (0.04, 0.2, 1)
    halves = _stored(tree, "part", "INT", index, placed)
    pairs = _stored(tree, "kept", "FLOAT_VECTOR", place, _on_points(tree, start.outputs[0], halves))
    tree.links.new(pairs, end.inputs[0])
    return tree


def _on_points(tree: Any, points: Any, instance: Any) -> Any:
    node = tree.nodes.new("GeometryNodeInstanceOnPoints")
    tree.links.new(points, node.inputs["Points"])
    tree.links.new(instance, node.inputs["Instance"])
    return node.outputs[0]


def _stored(tree: Any, name: str, kind: str, value: Any, geometry: Any) -> Any:
    node = tree.nodes.new("GeometryNodeStoreNamedAttribute")
    node.data_type, node.domain, node.inputs["Name"].default_value = kind, "INSTANCE", name
    tree.links.new(geometry, node.inputs["Geometry"])
    tree.links.new(value.outputs[0], next(socket for socket in node.inputs if socket.name == "Value"))
    return node.outputs[0]
