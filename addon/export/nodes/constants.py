"""Nodes that are one number or vector, which Blender 5.0 and later have beside Value and RGB."""

from __future__ import annotations

from ..program import Value
from .row import Node, Row


def _boolean(node: Node) -> Value:
    return node.program.number(float(node.node.boolean))


def _integer(node: Node) -> Value:
    return node.program.number(float(node.node.integer))


def _vector(node: Node) -> Value:
    return node.program.colour(node.node.vector[:3])


def _scene_time(node: Node) -> Value:
    images = node.program.images
    if node.output == "Frame":
        images.shows_frames = True
        return node.program.number(float(images.frame))
    node.warn(f"{node.output} is not supported, it is 0")
    return node.program.number(0.0)


ROWS: dict[str, Row] = {
    "INPUT_BOOL": _boolean,
    "INPUT_INT": _integer,
    "INPUT_VECTOR": _vector,
    "INPUT_SCENE_TIME": _scene_time,
}
