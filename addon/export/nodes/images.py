"""Nodes that look up images. [C] is Cycles 4.5, scene/shader_nodes.cpp and kernel/svm/image.h."""

from __future__ import annotations

from collections.abc import Callable

from ..program import Value
from .geometry import uv
from .row import Node, Row
from .texture_mapping import mapped

_PINK = (1.0, 0.0, 1.0, 1.0)  # what is missing [C]
_INTERPOLATIONS = {"Closest": 0, "Linear": 1, "Cubic": 2, "Smart": 2}  # the core's
_EXTENSIONS = {"REPEAT": 0, "EXTEND": 1, "CLIP": 2, "MIRROR": 3}


def _image_texture(node: Node) -> Value:
    projection = node.node.projection
    if projection == "BOX":
        return _looked_up(node, "image_box", _mapped_uv, _EXTENSIONS[node.node.extension])
    project = {"FLAT": lambda at: at[:2], "SPHERE": _by("project_sphere"), "TUBE": _by("project_tube")}[projection]
    closed = projection != "FLAT"
    return _looked_up(node, "image", lambda at: project(_mapped_uv(at)), _EXTENSIONS[node.node.extension], closed)


def _environment_texture(node: Node) -> Value:
    equirectangular = node.node.projection == "EQUIRECTANGULAR"
    project = _by("project_equirectangular" if equirectangular else "project_mirror_ball")
    return _looked_up(node, "image", lambda at: project(_mapped_direction(at)), _EXTENSIONS["REPEAT"], equirectangular)


def _by(op: str) -> Callable[[Value], Value]:
    return lambda at: at.program.op(op, at)


def _looked_up(
    node: Node, op: str, coordinate: Callable[[Node], Value], extension: int, closed_u: bool = False
) -> Value:
    """The output that is asked for. coordinate: of the node at a place, or beside it."""
    blender_node = node.node
    program = node.program
    if blender_node.image is None:
        node.warn("it has no image and is shown in pink. Fix: choose one")
        picture = None
    else:
        picture = program.images.picture(blender_node.image, blender_node.image_user, node.warn)
    if picture is None:
        return _output(node, program.colour(_PINK))
    wants_alpha = any(output.is_linked for output in blender_node.outputs if output.identifier == "Alpha")
    unassociate = picture.is_associated and wants_alpha
    settings = [_INTERPOLATIONS[blender_node.interpolation], extension, unassociate, closed_u]
    places = _footprint(node, coordinate)
    if op == "image_box":
        settings.append(blender_node.projection_blend)
    elif picture.is_tiled:
        rgba = program.colour(_PINK)
        for tile, image in picture.tiles.items():
            rgba = node.op("image_tile", *places, rgba, settings=[*settings, *tile], image=image)
        return _output(node, rgba)
    image = picture.tiles.get((0, 0))
    return _output(node, node.op(op, *places, settings=settings, image=image) if image else program.colour(_PINK))


def _footprint(node: Node, coordinate: Callable[[Node], Value]) -> list[Value]:
    """Where the image is looked up, and two places at the edges of what is averaged.

    Where bump mapping looks, that is as large as at the place itself: else its differences were those of averages.
    """
    own = coordinate(node)
    here, *others = (coordinate(node.beside(other)) for other in range(3))
    if node.neighbour == 0:
        return [own, *others]
    return [own, *(own + (other - here) for other in others)]


def _output(node: Node, rgba: Value) -> Value:
    return rgba[3] if node.output == "Alpha" else rgba[:3]


def _mapped_uv(node: Node) -> Value:
    at = node.vector("Vector") if node.is_linked("Vector") else uv(node)
    return mapped(at, node.node.texture_mapping)


def _mapped_direction(node: Node) -> Value:
    direction = node.vector("Vector") if node.is_linked("Vector") else node.op("position")
    return mapped(direction, node.node.texture_mapping)


ROWS: dict[str, Row] = {
    "TEX_IMAGE": _image_texture,
    "TEX_ENVIRONMENT": _environment_texture,
}
