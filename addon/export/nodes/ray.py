"""Nodes that tell of the ray that sees a place, of others that leave it, and of the camera."""

from __future__ import annotations

from ..program import Value
from .row import Node, Row

CAMERA_RAY, _DIFFUSE_RAY, _GLOSSY_RAY, _TRANSMISSION_RAY, _SHADOW_RAY = (1 << bit for bit in range(5))  # RayKind
_RAYS = {
    "Is Camera Ray": CAMERA_RAY,
    "Is Shadow Ray": _SHADOW_RAY,
    "Is Diffuse Ray": _DIFFUSE_RAY,
    "Is Glossy Ray": _GLOSSY_RAY,
    "Is Reflection Ray": _DIFFUSE_RAY | _GLOSSY_RAY,
    "Is Transmission Ray": _TRANSMISSION_RAY,
}
_WORLD_DISTANCE_M = 10.0  # as Blender adds worlds


def _light_path(node: Node) -> Value:
    if node.output in _RAYS:
        return node.op("ray_is", settings=[_RAYS[node.output]])
    if node.output == "Ray Length":
        return node.op("ray_length")
    if node.output == "Ray Depth":
        return node.op("ray_depth")
    if node.output == "Transparent Depth":
        return node.op("transparent_depth")
    node.warn(f"{node.output} is not supported, it is 0")
    return node.program.number(0.0)


def _ambient_occlusion(node: Node) -> Value:
    settings = node.node
    numbers = [settings.samples, settings.inside, settings.only_local]
    distance = node.number("Distance")
    if distance.is_always(0.0) and not node.is_linked("Distance"):
        node.warn(f"Distance 0, the world's, is not supported, it is {_WORLD_DISTANCE_M:g} m")
        distance = node.program.number(_WORLD_DISTANCE_M)
    share = node.op("openness", node.normal(), distance, settings=numbers)
    return share if node.output == "AO" else node.colour("Color") * share


def _camera_data(node: Node) -> Value:
    value = node.op("camera_data")
    return {"View Z Depth": value[3], "View Distance": value[4]}.get(node.output, value[:3])


def _layer_weight(node: Node) -> Value:
    return node.op(f"layer_weight_{node.output.lower()}", node.normal(), node.number("Blend"))


def _fresnel(node: Node) -> Value:
    return node.op("fresnel", node.normal(), node.number("IOR"))


ROWS: dict[str, Row] = {
    "LIGHT_PATH": _light_path,
    "AMBIENT_OCCLUSION": _ambient_occlusion,
    "CAMERA": _camera_data,
    "LAYER_WEIGHT": _layer_weight,
    "FRESNEL": _fresnel,
}
