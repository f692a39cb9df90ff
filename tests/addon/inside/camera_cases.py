"""Cameras as exported, beside where Blender itself projects points."""

from __future__ import annotations

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
}


def main(folder: Path) -> Any:
    return {name: _measure(dict(case)) for name, case in CASES.items()} | {"stereo": _stereo()}


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
        "frame": [exported.width, exported.height],
        "window": exported.window,
        "clip": [exported.clip_start_m, exported.clip_end_m],
        "points": [list(point) for point in points],
        "blender": [[view.x, view.y] for view in views],
    }


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
