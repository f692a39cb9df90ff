"""Lights, in Cycles' units: [C] is Cycles' scene/light.cpp at the tag of the Blender version in hand.

A light's strength is its energy times its colours and 2^exposure. From it, with A the emitting area in m^2:
point and spot: intensity P / (4 pi); sun: irradiance P; area: radiance P / (pi A), before Blender 4.0 P / (4 A).
A light that is not normalized keeps its radiance when it grows: P stands for P x surface area. [C]
"""

from __future__ import annotations

import math
from typing import Any

import bpy
import numpy as np
from numpy.typing import NDArray

from ..report import RenderError, Reporter, naming
from .census import report_left_out
from .context import Context
from .light_groups import light_group
from .nodes import Owner, active_tree
from .program import Program, Value
from .shader import light_emission
from .surface import Surface
from .visibility import Visible

_AREA_EXITANCE_PER_RADIANCE = math.pi if bpy.app.version >= (4, 0) else 4.0


def export_light(
    context: Context,
    light_object: bpy.types.Object,
    object_to_world: NDArray[np.float64],
    visible: Visible,
    links: tuple[int, int],
) -> None:
    """Add one light object. Raises RenderError naming it.

    object_to_world: (4, 4). links: masks of LightLinks.
    """
    data: Any = light_object.data
    if not np.isfinite(object_to_world).all():
        raise RenderError(
            f"light '{light_object.name}': its transform is not finite. Fix: check its location, rotation, scale, "
            "drivers and constraints"
        )
    if _is_portal(data):
        return
    owner = f"light '{light_object.name}'"
    for described in (light_object, data):
        report_left_out(described, owner, context.reporter)
    _warn_of_uneven_scale(owner, data, object_to_world, context.reporter)
    with naming(owner, "give its power, colour and size finite values"):
        make, strength, shader = _LIGHTS[data.type], _strength(data), None
        tree = active_tree(data)
        if tree is not None:
            share = _share(context, data, tree, owner, object_to_world)
            if share.is_constant:
                strength *= share.numbers
            elif (light := make(context, data, np.ones(3), object_to_world)) is not None:
                # What a lamp is chosen by is its mean, so that is its strength.
                mean = context.core.mean_lamp_share(_emitting(share), light) or 1.0
                strength *= mean
                shader = _emitting(share / mean)
        light = make(context, data, strength, object_to_world)
        if light is not None:
            context.scene.add_light(
                light_object.name,
                light,
                hidden_from=_hidden_from(visible, data),
                max_bounces=_max_bounces(data),
                light_group=light_group(context.depsgraph.view_layer, light_object),
                links=links,
                shader=shader,
            )


def _hidden_from(visible: Visible, data: Any) -> list[str]:
    """What it does not light, as the core names it, and SHADOW where nothing hides it."""
    cycles = getattr(data, "cycles", None)
    # Blender 4.5 dropped Cycles' own switch for Blender's.
    casts_shadows = cycles.cast_shadow if hasattr(cycles, "cast_shadow") else data.use_shadow
    lit = [name for name in visible.hidden_from if name not in {"CAMERA", "SHADOW"}]  # those are for surfaces
    return lit if casts_shadows else [*lit, "SHADOW"]


def _max_bounces(data: Any) -> int:
    return int(getattr(getattr(data, "cycles", None), "max_bounces", 1024))


def _is_portal(data: Any) -> bool:
    """Whether the light only helps Cycles to find the world through a window."""
    return data.type == "AREA" and getattr(getattr(data, "cycles", None), "is_portal", False)


def _strength(data: Any) -> NDArray[np.float64]:
    """(3,): power in W (sun: irradiance in W/m^2) times colour."""
    strength = np.array(data.color, float) * data.energy * 2.0 ** getattr(data, "exposure", 0.0)
    if getattr(data, "use_temperature", False):
        strength *= np.array(data.temperature_color)
    return strength


def _emitting(value: Value) -> Any:
    return Surface.of(value.program, emission=value).core_shader(value.program.core)


def _share(
    context: Context, data: Any, tree: bpy.types.NodeTree, name: str, object_to_world: NDArray[np.float64]
) -> Value:
    """What the lamp's nodes leave of its light, colour by colour."""
    program = Program(context.core, context.scene, context.images)
    owner = Owner(name, context.reporter, program, data, lamp_axes=object_to_world[:3, :3].T)
    share = light_emission(tree, owner)
    if not share.is_constant and context.depsgraph.scene_eval.pivot.integrator == "ANALYTIC":
        context.reporter.warn(f"{name}: in the analytic integrator it shines alike everywhere. Fix: use Monte Carlo")
    return share


def _normalized(data: Any) -> bool:
    return getattr(data, "normalize", True)


def _direction(object_to_world: NDArray[np.float64]) -> NDArray[np.float64]:
    """Where the light shines: its -z axis, unit; zero where it has none."""
    direction = -object_to_world[:3, 2]
    length = float(np.linalg.norm(direction))
    return direction / length if length > 0 else direction


def _intensity(data: Any, strength: NDArray[np.float64]) -> NDArray[np.float64]:
    """W/sr of a point or spot light."""
    intensity = strength / (4 * math.pi)
    if not _normalized(data):
        radius_m = data.shadow_soft_size
        intensity *= 4 * math.pi * radius_m**2 if radius_m > 0 else 4.0
    return intensity


def _is_facing_disk(data: Any) -> bool:
    """Whether a point or spot light is a disk turned to each point it lights: soft falloff, and Blender 3. [C]"""
    return getattr(data, "use_soft_falloff", bpy.app.version < (4, 0))


def _point(context: Context, data: Any, strength: NDArray[np.float64], object_to_world: NDArray[np.float64]) -> Any:
    return context.core.SphereLight(
        position=object_to_world[:3, 3].tolist(),
        radius_m=data.shadow_soft_size,
        intensity=_intensity(data, strength).tolist(),
        facing_disk=_is_facing_disk(data),
    )


def _spot(context: Context, data: Any, strength: NDArray[np.float64], object_to_world: NDArray[np.float64]) -> Any:
    direction = _direction(object_to_world)
    if not direction.any():
        return None
    return context.core.SpotLight(
        position=object_to_world[:3, 3].tolist(),
        radius_m=data.shadow_soft_size,
        intensity=_intensity(data, strength).tolist(),
        direction=direction.tolist(),
        cos_half_angle=math.cos(data.spot_size / 2),
        blend=data.spot_blend,
        facing_disk=_is_facing_disk(data),
        cosine=bpy.app.version < (4, 0),
    )


def _sun(context: Context, data: Any, strength: NDArray[np.float64], object_to_world: NDArray[np.float64]) -> Any:
    direction = _direction(object_to_world)
    if not direction.any():
        return None
    half_angle_rad = data.angle / 2
    irradiance = strength
    if not _normalized(data) and half_angle_rad > 0:
        irradiance = strength * math.pi * math.sin(half_angle_rad) ** 2
    return context.core.SunLight(
        direction=(-direction).tolist(), half_angle_rad=half_angle_rad, irradiance=irradiance.tolist()
    )


def _area(context: Context, data: Any, strength: NDArray[np.float64], object_to_world: NDArray[np.float64]) -> Any:
    size_x = data.size
    size_y = data.size_y if data.shape in {"RECTANGLE", "ELLIPSE"} else data.size
    ellipse = data.shape in {"DISK", "ELLIPSE"}
    # It emits to the side of cross(half_u, half_v), which is to be -z also when the object is mirrored.
    half_u = object_to_world[:3, 1] * (size_y / 2)
    half_v = object_to_world[:3, 0] * (size_x / 2)
    if np.dot(np.cross(half_u, half_v), object_to_world[:3, 2]) > 0:
        half_u = -half_u
    area_m2 = 4 * float(np.linalg.norm(half_u) * np.linalg.norm(half_v)) * (math.pi / 4 if ellipse else 1.0)
    if area_m2 == 0:
        return None
    radiance = strength / _AREA_EXITANCE_PER_RADIANCE
    if _normalized(data):
        radiance = radiance / area_m2
    return context.core.AreaLight(
        center=object_to_world[:3, 3].tolist(),
        half_u=half_u.tolist(),
        half_v=half_v.tolist(),
        radiance=radiance.tolist(),
        ellipse=ellipse,
        spread_rad=data.spread,
    )


_LIGHTS = {"POINT": _point, "SPOT": _spot, "SUN": _sun, "AREA": _area}


def _warn_of_uneven_scale(owner: str, data: Any, object_to_world: NDArray[np.float64], reporter: Reporter) -> None:
    """Cycles' cones are as elliptic as their object's scale, and its sheared panels are neither of both shapes."""
    axes = object_to_world[:3, :3]
    scale = np.linalg.norm(axes, axis=0)
    if data.type == "SPOT" and not np.allclose(scale, scale.mean(), rtol=1e-3):
        reporter.warn(f"{owner}: an uneven Scale is not supported, the cone is round and as wide as its Spot Size")
    cosines = (axes.T @ axes) / np.maximum(np.outer(scale, scale), 1e-30)
    if data.type == "AREA" and np.abs(cosines - np.diag(np.diag(cosines))).max() > 1e-3:
        reporter.warn(
            f"{owner}: its transform is sheared, it shines from the slanted shape as a mesh would. "
            "Fix: give its parents an even Scale"
        )
