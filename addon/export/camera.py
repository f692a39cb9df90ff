"""The camera: where it stands, and the part of its view plane that is rendered."""

from __future__ import annotations

import math
from dataclasses import dataclass

import bpy
import numpy as np
from numpy.typing import NDArray

from ..report import RenderError, naming
from .census import report_left_out
from .context import Context
from .optics import optics_of


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


@dataclass(frozen=True)
class CameraMotion:
    """A camera while its shutter is open."""

    places: NDArray[np.float64] | None  # (S, 4, 4), at even times; None: it stays where it is
    openness: list[float] | None  # at even times; None: open all the time


def active_camera(context: Context, engine: bpy.types.RenderEngine) -> bpy.types.Object:
    """The one that the engine renders with. Raises RenderError without."""
    scene = context.depsgraph.scene_eval
    camera = engine.camera_override or scene.camera
    if camera is None:
        raise RenderError(f"scene '{scene.name}' has no camera. Fix: add one and make it the scene's active camera")
    return camera.original


def camera_place(context: Context, engine: bpy.types.RenderEngine, camera: bpy.types.Object) -> NDArray[np.float64]:
    """Where a camera stands, (4, 4) with unit axes, as the engine's view has it."""
    return without_scale(np.array(engine.camera_model_matrix(camera.evaluated_get(context.depsgraph))))


def export_camera(
    context: Context, engine: bpy.types.RenderEngine, frame: Frame, motion: CameraMotion | None = None
) -> None:
    """Set the core's camera to the one the engine renders with. Raises RenderError naming the camera and the fix."""
    scene, original = context.depsgraph.scene_eval, active_camera(context, engine)
    camera = original.evaluated_get(context.depsgraph)
    render, owner = scene.render, f"camera '{camera.name}'"
    if camera.type == "CAMERA":
        report_left_out(camera.data, owner, context.reporter)
        if render.use_multiview and camera.data.type == "PANO" and camera.data.stereo.use_spherical_stereo:
            context.reporter.warn(f"{owner}: Spherical Stereo is not supported, its eyes stand side by side")
    camera_to_world = camera_place(context, engine, original)
    if not np.isfinite(camera_to_world).all():
        raise RenderError(
            f"{owner}: its transform is not finite or has no extent. Fix: check its location, rotation, "
            "scale, drivers and constraints"
        )
    width, height = frame.width * render.pixel_aspect_x, frame.height * render.pixel_aspect_y
    # Blender reads any object's data as a camera's there.
    shift_x = engine.camera_shift_x(camera) if camera.type == "CAMERA" else 0.0
    optics = optics_of(camera, camera_to_world, shift_x, width, height)
    with naming(owner, "check its lens, shift, clip distances and depth of field"):
        context.scene.set_camera(
            camera_to_world,
            width=frame.width,
            height=frame.height,
            window=frame.window,
            motion=motion.places if motion else None,
            shutter=motion.openness if motion else None,
            **optics.arguments(context.core),
        )


def without_scale(matrix: NDArray[np.float64]) -> NDArray[np.float64]:
    """matrix (4, 4) with unit axes; not finite where an axis has no length."""
    result = matrix.copy()
    for axis in range(3):
        length = math.sqrt(float(np.sum(matrix[:3, axis] ** 2)))
        result[:3, axis] = matrix[:3, axis] / length if length > 0 else math.nan
    return result
