"""The camera: where it stands, and the part of its view plane that is rendered."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import bpy
import numpy as np
from numpy.typing import NDArray

from ..report import RenderError, naming
from .census import report_left_out
from .context import Context

ViewPlane = tuple[float, float, float, float]  # (left, right, bottom, top) at z = -1 in camera space


@dataclass(frozen=True)
class Frame:
    """The full frame in pixels, and the window of it to render: (x0, y0, x1, y1) from the bottom left."""

    width: int
    height: int
    window: tuple[int, int, int, int]

    @property
    def window_size(self) -> tuple[int, int]:
        x0, y0, x1, y1 = self.window
        return x1 - x0, y1 - y0


def render_frame(render: bpy.types.RenderSettings, width: int, height: int) -> Frame:
    """The frame of a final render. Raises RenderError when the render region holds no pixel."""
    if not render.use_border:
        return Frame(width, height, (0, 0, width, height))
    x0, x1 = (_border_pixel(border, width) for border in (render.border_min_x, render.border_max_x))
    y0, y1 = (_border_pixel(border, height) for border in (render.border_min_y, render.border_max_y))
    if x1 <= x0 or y1 <= y0:
        raise RenderError("the render region holds no pixel. Fix: draw a larger one, or clear it")
    return Frame(width, height, (x0, y0, x1, y1))


def _border_pixel(border: float, size: int) -> int:
    return int(np.float32(border) * np.float32(size))  # Blender's own rounding, in single precision


def view_plane(camera: bpy.types.Camera, shift_x: float, width: float, height: float) -> ViewPlane:
    """Of the full frame.

    width, height: of the frame in pixels, times the pixel aspect.
    """
    horizontal = camera.sensor_fit == "HORIZONTAL" or (camera.sensor_fit == "AUTO" and width >= height)
    sensor = camera.sensor_height if camera.sensor_fit == "VERTICAL" else camera.sensor_width
    fitted = sensor / camera.lens  # extent of the fitted side, which shift is measured in
    pixel = fitted / (width if horizontal else height)
    center_x, center_y = shift_x * fitted, camera.shift_y * fitted
    half_x, half_y = width * pixel / 2, height * pixel / 2
    return center_x - half_x, center_x + half_x, center_y - half_y, center_y + half_y


def export_camera(context: Context, engine: bpy.types.RenderEngine, frame: Frame) -> None:
    """Set the core's camera to the one the engine renders with. Raises RenderError naming the camera and the fix."""
    scene = context.depsgraph.scene_eval
    original = engine.camera_override or scene.camera
    if original is None:
        raise RenderError(f"scene '{scene.name}' has no camera. Fix: add one and make it the scene's active camera")
    camera = original.evaluated_get(context.depsgraph)
    data = camera.data
    render = scene.render
    _check(camera)
    report_left_out(data, f"camera '{camera.name}'", context.reporter)
    camera_to_world = without_scale(np.array(engine.camera_model_matrix(camera)))
    if not np.isfinite(camera_to_world).all():
        raise RenderError(
            f"camera '{camera.name}': its transform is not finite or has no extent. Fix: check its location, rotation, "
            "scale, drivers and constraints"
        )
    width, height = frame.width * render.pixel_aspect_x, frame.height * render.pixel_aspect_y
    plane = view_plane(data, engine.camera_shift_x(camera), width, height)
    with naming(f"camera '{camera.name}'", "check its lens, shift and clip distances"):
        context.scene.set_camera(
            camera_to_world, plane, frame.width, frame.height, frame.window, data.clip_start, data.clip_end
        )


def _check(camera: bpy.types.Object) -> None:
    """Raise RenderError for a camera Pivot cannot render."""
    data: Any = camera.data
    if camera.type != "CAMERA":
        raise RenderError(f"object '{camera.name}' is the scene's camera but no camera. Fix: choose a camera object")
    if data.type != "PERSP":
        raise RenderError(
            f"camera '{camera.name}' is {data.bl_rna.properties['type'].enum_items[data.type].name.lower()}. "
            "Fix: set its lens type to Perspective, the one Pivot renders"
        )


def without_scale(matrix: NDArray[np.float64]) -> NDArray[np.float64]:
    """matrix (4, 4) with unit axes; not finite where an axis has no length."""
    result = matrix.copy()
    for axis in range(3):
        length = math.sqrt(float(np.sum(matrix[:3, axis] ** 2)))
        result[:3, axis] = matrix[:3, axis] / length if length > 0 else math.nan
    return result
