"""Cameras as exported, beside where Blender itself projects points."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import bpy
import numpy as np
import parts
from bpy_extras.object_utils import world_to_camera_view
from mathutils import Vector
from recording import record

POINTS = np.random.default_rng(1).uniform((-1, -1, -4), (1, 1, -2), (8, 3))  # in camera space
PLAIN: dict[str, Any] = {
    "lens": 35.0,
    "sensor_width": 36.0,
    "sensor_height": 24.0,
    "clip_start": 0.25,
    "clip_end": 70.0,
}
CASES: dict[str, dict[str, Any]] = {
    "wide": {},
    "tall": {"size": (40, 90)},
    "square": {"size": (64, 64)},
    "shift": {"shift_x": 0.2, "shift_y": -0.35},
    "shift_tall": {"shift_x": 0.2, "shift_y": -0.35, "size": (40, 90)},
    "horizontal_tall": {"sensor_fit": "HORIZONTAL", "shift_y": 0.1, "size": (40, 90)},
    "vertical_wide": {"sensor_fit": "VERTICAL", "shift_x": 0.3, "shift_y": 0.1},
    "vertical_tall": {"sensor_fit": "VERTICAL", "shift_x": 0.3, "size": (40, 90)},
    "anamorphic": {"aspect": (2.0, 1.0), "shift_x": 0.1},
    "anamorphic_tall": {"aspect": (1.0, 3.0), "shift_y": 0.1},
    "half_size": {"percentage": 50},
    "scaled": {"scale": (2.0, 0.5, -3.0)},
    "border": {"border": (0.25, 0.75, 0.1, 0.6)},
    "cropped": {"border": (0.25, 0.75, 0.1, 0.6), "crop": True},
    "orthographic": {"type": "ORTHO", "ortho_scale": 7.0, "shift_x": 0.2, "shift_y": -0.1},
    "orthographic_tall": {"type": "ORTHO", "ortho_scale": 7.0, "size": (40, 90), "aspect": (2.0, 1.0)},
}
PANORAMAS: dict[str, dict[str, Any]] = {
    "EQUIRECTANGULAR": {"longitude_min": -2, "longitude_max": 1, "latitude_min": -0.5, "latitude_max": 1.5},
    "EQUIANGULAR_CUBEMAP_FACE": {},
    "MIRRORBALL": {},
    "FISHEYE_EQUIDISTANT": {"fisheye_fov": 3},
    "FISHEYE_EQUISOLID": {"fisheye_fov": 3, "fisheye_lens": 12},
    "FISHEYE_LENS_POLYNOMIAL": {"fisheye_fov": 2} | {f"fisheye_polynomial_k{k}": 0.25 * k - 1 for k in range(5)},
}
if bpy.app.version >= (4, 5):
    PANORAMAS["CENTRAL_CYLINDRICAL"] = {
        "central_cylindrical_range_u_min": -2,
        "central_cylindrical_range_u_max": 1,
        "central_cylindrical_range_v_min": -0.5,
        "central_cylindrical_range_v_max": 1.5,
        "central_cylindrical_radius": 2,
    }


def main(folder: Path) -> Any:
    return {
        "projected": {name: _measure(dict(case)) for name, case in CASES.items()},
        "stereo": _stereo(),
        "panoramas": {name: _panorama(name, settings) for name, settings in PANORAMAS.items()},
        "lenses": _lenses(),
        "stand_ins": _stand_ins(),
        "spherical_stereo": _spherical_stereo(),
    }


def _measure(case: dict[str, Any]) -> Any:
    parts.clear()
    camera = parts.camera(location=(3, -2, 1), rotation=(1.1, 0.2, 0.7))
    camera.scale = case.pop("scale", (1, 1, 1))
    render = bpy.context.scene.render
    parts.size(*case.pop("size", (96, 40)))
    render.resolution_percentage = case.pop("percentage", 100)
    render.pixel_aspect_x, render.pixel_aspect_y = case.pop("aspect", (1, 1))
    border = case.pop("border", None)
    render.use_border = border is not None
    render.use_crop_to_border = case.pop("crop", False)
    if border:
        render.border_min_x, render.border_max_x, render.border_min_y, render.border_max_y = border
    for key, value in (PLAIN | case).items():
        setattr(camera.data, key, value)
    exported = record().camera
    unit = camera.matrix_world.copy()
    for axis in range(3):
        unit.col[axis] = unit.col[axis].normalized()
    points = [unit @ Vector(point) for point in POINTS]
    views = [world_to_camera_view(bpy.context.scene, camera, point) for point in points]
    return {
        "camera_to_world": np.array(exported.camera_to_world).tolist(),
        "view_plane": exported.view_plane,
        "projection": exported.projection,
        "frame": [exported.width, exported.height],
        "window": exported.window,
        "clip": [exported.clip_start_m, exported.clip_end_m],
        "points": [list(point) for point in points],
        "blender": [[view.x, view.y] for view in views],
    }


def _panorama(kind: str, settings: dict[str, Any]) -> Any:
    parts.clear()
    parts.size(40, 90)
    data = parts.camera().data
    data.type, data.shift_x, data.shift_y = "PANO", 0.25, -0.5
    owner = sys.modules["pivot.export.optics"].panorama_settings(data)
    for key, value in {"panorama_type": kind, **settings}.items():
        setattr(owner, key, value)
    exported = record().camera
    return {"projection": exported.projection, "view_plane": exported.view_plane}


def _lenses() -> Any:
    """The arguments of each, by what is set beside the default's."""
    parts.clear()
    camera = parts.camera((0, 0, 5))
    dof = camera.data.dof
    dof.use_dof, dof.focus_distance, dof.aperture_fstop = True, 4.0, 2.0
    dof.aperture_blades, dof.aperture_rotation, dof.aperture_ratio = 6, 0.5, 1.5
    lenses = {"plain": record().camera.lens}
    camera.data.type = "ORTHO"
    lenses["orthographic"] = record().camera.lens
    camera.data.type, dof.aperture_fstop, dof.focus_distance = "PERSP", 0.0, 0.0
    lenses["nothing"] = record().camera.lens
    dof.focus_object = parts.link("focus", None, (3, 4, 2))
    lenses["object"] = record().camera.lens
    armature = parts.link("armature", bpy.data.armatures.new("armature"), (0, 0, 1))
    bpy.context.view_layer.objects.active = armature
    bpy.ops.object.mode_set(mode="EDIT")
    bone = armature.data.edit_bones.new("bone")
    bone.head, bone.tail = (0, 0, 2), (0, 0, 3)
    bpy.ops.object.mode_set(mode="OBJECT")
    dof.focus_object, dof.focus_subtarget = armature, "bone"
    lenses["bone"] = record().camera.lens
    dof.use_dof = False
    lenses["off"] = record().camera.lens
    return lenses


def _stand_ins() -> Any:
    """What other objects see as cameras."""
    parts.clear()
    made = {
        "empty": parts.link("empty"),
        "spot": parts.light("spot", "SPOT", spot_size=1.0),
        "point": parts.light("point", "POINT"),
    }
    seen = {}
    for name, thing in made.items():
        bpy.context.scene.camera = thing
        exported = record().camera
        seen[name] = {"view_plane": exported.view_plane, "clip": [exported.clip_start_m, exported.clip_end_m]}
    return seen


def _spherical_stereo() -> list[str]:
    parts.clear()
    data = parts.camera().data
    data.type, data.stereo.use_spherical_stereo = "PANO", True
    bpy.context.scene.render.use_multiview = True
    return record().reports


def _stereo() -> Any:
    """The distance between the eyes, and the x at z = -10 m that each sees in the middle of its frame."""
    parts.clear()
    camera = parts.camera()
    camera.data.stereo.interocular_distance = 0.5
    camera.data.stereo.convergence_distance = 10.0
    camera.data.stereo.pivot = "CENTER"
    bpy.context.scene.render.use_multiview = True
    bpy.context.scene.render.views_format = "STEREO_3D"
    eyes = record().cameras
    return [
        {
            "x": float(np.array(eye.camera_to_world)[0, 3]),
            "middle": float(np.array(eye.camera_to_world)[0, 3] + 10 * (eye.view_plane[0] + eye.view_plane[1]) / 2),
        }
        for eye in eyes
    ]
