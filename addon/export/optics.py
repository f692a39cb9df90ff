"""What a camera sees through: its projection, the part of the projection's plane that is its frame, and its lens."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from types import ModuleType, SimpleNamespace
from typing import Any

import bpy
import numpy as np
from numpy.typing import NDArray

from ..report import RenderError

ViewPlane = tuple[float, float, float, float]  # (left, right, bottom, top), in places of the projection

_LEAST_FSTOP = 1e-5  # Cycles' own
_LEAST_FOCUS_M = 1e-5
_SPOT_LENS = 16.0  # over the tangent of half a spot's cone
_NEW_SPOT_RAD = math.radians(45)  # what lights that show no cone have for one


@dataclass(frozen=True)
class Optics:
    """All but the place of a camera, in the core's terms. Plain values, so that two can be compared."""

    view_plane: ViewPlane  # of the full frame
    clip_m: tuple[float, float]
    projection: tuple[Any, ...] = ("Perspective",)  # a class of pivot_core and its arguments
    lens: tuple[Any, ...] | None = None  # the arguments of pivot_core.Lens; None: a pinhole

    def arguments(self, core: ModuleType) -> dict[str, Any]:
        """Those of Scene.set_camera beside where the camera is and its pixels."""
        name, *numbers = self.projection
        return {
            "view_plane": self.view_plane,
            "clip_start_m": self.clip_m[0],
            "clip_end_m": self.clip_m[1],
            "projection": getattr(core, name)(*numbers),
            "lens": core.Lens(*self.lens) if self.lens else None,
        }


def camera_settings(camera: bpy.types.Object) -> Any:
    """A camera's, or those that another object is looked through with. [Cycles 4.5 blender/camera.cpp]"""
    if camera.type == "CAMERA":
        return camera.data
    settings = SimpleNamespace(type="PERSP", lens=50.0, sensor_width=36.0, sensor_height=24.0, sensor_fit="AUTO")
    settings.shift_y, settings.clip_start, settings.clip_end = 0.0, 1e-5, 1e5
    settings.dof = SimpleNamespace(use_dof=False)
    if camera.type == "LIGHT":
        half_cone = getattr(camera.data, "spot_size", _NEW_SPOT_RAD) / 2
        settings.lens = _SPOT_LENS / math.tan(half_cone) if half_cone < math.pi / 2 else settings.lens
    return settings


def optics_of(
    camera: bpy.types.Object, camera_to_world: NDArray[np.float64], shift_x: float, width: float, height: float
) -> Optics:
    """Raises RenderError for a camera Pivot cannot render.

    camera: evaluated. camera_to_world: with unit axes. width, height: of the frame in pixels, times the pixel aspect.
    """
    data = camera_settings(camera)
    settings = panorama_settings(data) if data.type == "PANO" else data
    kind = settings.panorama_type if data.type == "PANO" else data.type
    if kind not in _KINDS:
        name = data.bl_rna.properties["type"].enum_items[data.type].name.lower()
        raise RenderError(
            f"camera '{camera.name}' is {name}. Fix: set its lens type to Perspective, Orthographic or Panoramic"
        )
    fitted_mm, is_horizontal = _fitted_sensor(data, width, height)
    pixel = 1 / (width if is_horizontal else height)
    half_x, half_y = width * pixel / 2, height * pixel / 2
    plane = shift_x - half_x, shift_x + half_x, data.shift_y - half_y, data.shift_y + half_y
    scale = {"PERSP": fitted_mm / data.lens, "ORTHO": getattr(data, "ortho_scale", 0.0)}.get(data.type)
    if scale is not None:
        plane = tuple(side * scale for side in plane)
    else:
        plane = shift_x, 1 + shift_x, data.shift_y, 1 + data.shift_y
    sensor_mm = width * pixel * fitted_mm, height * pixel * fitted_mm
    lens = lens_of(data, camera_to_world)
    made = _KINDS[kind]
    projection = made.projection, *made.arguments([getattr(settings, name) for name in made.names], sensor_mm)
    return Optics(plane, (data.clip_start, data.clip_end), projection, lens)


def panorama_settings(data: Any) -> Any:
    """What has a camera's panorama_type and what belongs to it: in older Blenders Cycles' settings."""
    return data if hasattr(data, "panorama_type") else data.cycles


def _fitted_sensor(data: Any, width: float, height: float) -> tuple[float, bool]:
    """The side of the sensor that the frame is fitted to, in mm, and whether it is the horizontal one."""
    is_horizontal = data.sensor_fit == "HORIZONTAL" or (data.sensor_fit == "AUTO" and width >= height)
    return (data.sensor_height if data.sensor_fit == "VERTICAL" else data.sensor_width), is_horizontal


def lens_of(data: Any, camera_to_world: NDArray[np.float64]) -> tuple[Any, ...] | None:
    """The arguments of pivot_core.Lens, None of a camera in which all is sharp."""
    dof = data.dof
    if not dof.use_dof:
        return None
    length_m = 1.0 if data.type == "ORTHO" else data.lens * 1e-3
    radius_m = length_m / (2 * max(dof.aperture_fstop, _LEAST_FSTOP))
    focus_m = max(_focus_distance(dof, camera_to_world), _LEAST_FOCUS_M)
    return radius_m, focus_m, dof.aperture_blades, dof.aperture_rotation, dof.aperture_ratio


def _focus_distance(dof: Any, camera_to_world: NDArray[np.float64]) -> float:
    """Of an object, or one of its bones: along the camera's axis."""
    if dof.focus_object is None:
        return dof.focus_distance
    place = dof.focus_object.matrix_world
    bones = dof.focus_object.pose.bones if dof.focus_object.pose else {}
    if dof.focus_subtarget in bones:
        place = place @ bones[dof.focus_subtarget].matrix
    return abs(float(camera_to_world[:3, 2] @ (camera_to_world[:3, 3] - np.array(place.translation))))


@dataclass(frozen=True)
class _Kind:
    """A lens type or panorama: the settings it has, and the class of pivot_core that they and a sensor make."""

    projection: str
    names: tuple[str, ...] = ()
    arguments: Callable[[list[float], tuple[float, float]], tuple[Any, ...]] = lambda *_: ()


_RANGE_NAMES = ("longitude_min", "longitude_max", "latitude_min", "latitude_max")
_CYLINDER_NAMES = tuple(f"central_cylindrical_range_{axis}_{end}" for axis in "uv" for end in ("min", "max"))
_KINDS = {
    "PERSP": _Kind("Perspective"),
    "ORTHO": _Kind("Orthographic"),
    "EQUIRECTANGULAR": _Kind("Equirectangular", _RANGE_NAMES, lambda v, _: (v[0:2], v[2:4])),
    "EQUIANGULAR_CUBEMAP_FACE": _Kind("CubeMapFace"),
    "MIRRORBALL": _Kind("MirrorBall"),
    "FISHEYE_EQUIDISTANT": _Kind("FisheyeEquidistant", ("fisheye_fov",), lambda v, _: (v[0],)),
    "FISHEYE_EQUISOLID": _Kind(
        "FisheyeEquisolid", ("fisheye_lens", "fisheye_fov"), lambda v, sensor_mm: (*v, sensor_mm)
    ),
    "FISHEYE_LENS_POLYNOMIAL": _Kind(
        "FisheyePolynomial",
        ("fisheye_fov", *(f"fisheye_polynomial_k{power}" for power in range(5))),
        lambda v, sensor_mm: (v[1:], v[0], sensor_mm),
    ),
    "CENTRAL_CYLINDRICAL": _Kind(
        "CentralCylindrical",
        (*_CYLINDER_NAMES, "central_cylindrical_radius"),
        lambda v, _: (v[0:2], [side / v[4] for side in v[2:4]]),
    ),
}


def panorama_names(panorama_type: str) -> tuple[str, ...]:
    """The settings that a panorama of this type has."""
    return _KINDS[panorama_type].names if panorama_type in _KINDS else ()
