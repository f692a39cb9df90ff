"""The Sky Texture, and the sun in it. [C] is Cycles 4.5, scene/shader_nodes.cpp and kernel/svm/sky.h."""

from __future__ import annotations

import math
from typing import Any

import bpy
import numpy as np

from ..program import Value
from ..sky import LIMB_DARKENING, Air, horizon_rad, preetham, single_scattering, sun_disk
from .geometry import generated
from .ray import CAMERA_RAY
from .row import Node, Row
from .texture_mapping import mapped

_SCATTERING = {"NISHITA", "SINGLE_SCATTERING", "MULTIPLE_SCATTERING"}
_INSTEAD = {
    "HOSEK_WILKIE": "the sky of Hosek and Wilkie is not supported, it is Preetham's",
    "MULTIPLE_SCATTERING": "Multiple Scattering is not supported, light is scattered once",
}
_LINEAR, _EXTEND = 1, 1  # the core's
_SUN_HIDES_SKY = bpy.app.version < (5, 0)
_LIMB_MEAN = 1 - LIMB_DARKENING / 3  # over the sun's disk


def _sky_texture(node: Node) -> Value:
    blender_node, program = node.node, node.program
    if blender_node.sky_type in _INSTEAD:
        node.warn(_INSTEAD[blender_node.sky_type])
    vector = node.vector("Vector") if node.has("Vector") and node.is_linked("Vector") else generated(node)
    vector = mapped(vector, blender_node.texture_mapping)  # of any length: [C] takes z for the sine of the elevation
    if blender_node.sky_type not in _SCATTERING:
        sun = tuple(blender_node.sun_direction)
        image = program.images.sky(
            ("PREETHAM", sun, blender_node.turbidity), lambda: preetham(np.array(sun), blender_node.turbidity)
        )
        return _looked_up(node, vector, math.atan2(sun[1], sun[0]), image)
    air, azimuth_rad = _air(blender_node)
    image = program.images.sky(air, lambda: single_scattering(program.core, air))
    sky = _looked_up(node, vector, azimuth_rad, image)
    if not blender_node.sun_disc:
        return sky
    sun, is_there = _sun(node, program.op("vector_normalize", vector), air, azimuth_rad)
    return sky * (1.0 - is_there) + sun if _SUN_HIDES_SKY else sky + sun


def sun_light(core: Any, blender_node: Any) -> tuple[list[float], float, Any] | None:
    """Where a sky's sun is, its half angle in radians, and its irradiance, linear RGB; None: it has none."""
    if blender_node.sky_type not in _SCATTERING or not blender_node.sun_disc or not is_sun_a_lamp(blender_node):
        return None
    air, azimuth_rad = _air(blender_node)
    half_rad = blender_node.sun_size / 2
    if air.sun_elevation_rad < -half_rad:
        return None
    low, high = sun_disk(core, air, 2 * half_rad)
    solid_angle = 2 * math.pi * (1 - math.cos(half_rad))
    irradiance = np.maximum((low + high) / 2, 0) * (blender_node.sun_intensity * _LIMB_MEAN * solid_angle)
    return _sun_direction(air, azimuth_rad).tolist(), half_rad, irradiance


def is_sun_a_lamp(blender_node: Any) -> bool:
    """Whether all that the sky's colour does is to light the world as it is: then its sun can be a lamp."""
    return not any(socket.is_linked for socket in blender_node.inputs) and _is_only_background(blender_node)


def _is_only_background(blender_node: Any) -> bool:
    links = blender_node.outputs["Color"].links
    if len(links) != 1 or links[0].to_node.type != "BACKGROUND" or links[0].to_socket.identifier != "Color":
        return False
    background = links[0].to_node
    outputs = background.outputs[0].links
    return (
        not background.inputs["Strength"].is_linked
        and not background.mute
        and len(outputs) == 1
        and outputs[0].to_node.type == "OUTPUT_WORLD"
        and outputs[0].to_node.is_active_output
        and outputs[0].to_socket.identifier == "Surface"
    )


def _air(blender_node: Any) -> tuple[Air, float]:
    """And the azimuth of the sun, counted from x to y. Beyond the zenith it comes down on the other side. [C]"""
    elevation, azimuth = blender_node.sun_elevation, math.pi / 2 - blender_node.sun_rotation
    elevation = math.remainder(elevation, 2 * math.pi)
    if abs(elevation) > math.pi / 2:
        elevation, azimuth = math.copysign(math.pi, elevation) - elevation, azimuth + math.pi
    dust = blender_node.dust_density if hasattr(blender_node, "dust_density") else blender_node.aerosol_density
    altitude_m = blender_node.altitude
    return Air(elevation, altitude_m, blender_node.air_density, dust, blender_node.ozone_density), azimuth


def _sun_direction(air: Air, azimuth_rad: float) -> Any:
    across = math.cos(air.sun_elevation_rad)
    return np.array([across * math.cos(azimuth_rad), across * math.sin(azimuth_rad), math.sin(air.sun_elevation_rad)])


def _elevation(direction: Value) -> Value:
    return direction.program.each("math_arcsine", direction[2])


def _looked_up(node: Node, vector: Value, azimuth_rad: float, image: Any) -> Value:
    """Of a picture of export/sky.py, turned to the sun."""
    program = node.program
    turns = program.each("math_arctan2", vector[1], vector[0]) * (-0.5 / math.pi)
    u = program.each("math_fract", turns + (0.5 + azimuth_rad / (2 * math.pi)))
    elevation = _elevation(vector)
    level = (program.each("math_absolute", elevation) * (2 / math.pi)).root()
    v = program.each("math_sign", elevation) * level * 0.5 + 0.5
    at = program.joined(u, v)
    rgba = node.op("image", at, at, at, settings=[_LINEAR, _EXTEND, 0, 0], image=image)
    return rgba[:3].at_least(0.0)


def _sun(node: Node, direction: Value, air: Air, azimuth_rad: float) -> tuple[Value, Value]:
    """The disk, in the colours of its lower and upper edge, and 1 where it is.

    Only the camera sees it where a lamp lights the rest.
    """
    blender_node, program = node.node, node.program
    diameter_rad = blender_node.sun_size
    low, high = (edge * blender_node.sun_intensity for edge in sun_disk(program.core, air, diameter_rad))
    elevation = _elevation(direction)
    height = (elevation - air.sun_elevation_rad) / diameter_rad + 0.5
    from_middle = direction - program.colour(_sun_direction(air, azimuth_rad))
    rim = 2 * math.sin(diameter_rad / 4)
    share2 = program.op("vector_dot_product", from_middle, from_middle) / rim**2
    is_there = program.each("math_less_than", share2, 1.0)
    is_there = is_there * program.each("math_greater_than", elevation, -horizon_rad(air.altitude_m))
    if is_sun_a_lamp(blender_node):
        is_there = is_there * node.op("ray_is", settings=[CAMERA_RAY])
    limb = (1.0 - share2).at_least(0.0).root() * LIMB_DARKENING + (1 - LIMB_DARKENING)
    colour = program.colour(low) + (program.colour(high) - program.colour(low)) * height
    return colour.at_least(0.0) * (limb * is_there), is_there


ROWS: dict[str, Row] = {"TEX_SKY": _sky_texture}
