"""The Rendered viewport: a coarse picture at once, then the full one, refined sample by sample."""

from __future__ import annotations

import contextlib
import traceback
from collections.abc import Iterator
from typing import Any

import bpy
import numpy as np
from numpy.typing import NDArray

from . import core
from .export.camera import RegionView, region_view
from .export.scene import export_scene
from .report import RenderError, Reporter
from .settings import render_settings, sample_count

_REDRAW_S = 0.1
_COARSE_PX = 4  # edge of a pixel of the first picture
_COARSE_SAMPLES = 2
_LARGEST_HALF = 65504.0


class Viewport:
    """What one 3D view renders. An edit exports the scene again; a move of the view only restarts the samples.

    It keeps no reference to its engine: the two are freed together, and with them the threads.
    """

    def __init__(self) -> None:
        self._said: set[str] = set()  # warnings
        self._core: Any = None
        self._scene: Any = None  # pivot_core.Scene; None before the first export and after a fault
        self._settings: dict[int, Any] = {}  # pivot_core.RenderSettings by the edge of a pixel
        self._samples = 0
        self._session: Any = None
        self._pixel_px = 1  # of the session
        self._size = (0, 0)
        self._view: RegionView | None = None  # of the session
        self._texture: Any = None  # the last picture

    def update(self, engine: bpy.types.RenderEngine, depsgraph: bpy.types.Depsgraph) -> None:
        """Take over the scene after an edit."""
        self._stop()
        self._scene, self._view = None, None
        with _faults_shown(engine):
            self._core = core.load()
            reporter = Reporter(engine.report, self._said)
            scene, self._samples = depsgraph.scene, sample_count(depsgraph)
            self._settings = {
                pixel_px: render_settings(self._core, scene, samples, scene.pivot.max_bounces)
                for pixel_px, samples in ((1, self._samples), (_COARSE_PX, min(self._samples, _COARSE_SAMPLES)))
            }
            self._scene = export_scene(self._core, depsgraph, reporter, lambda: None).scene
        engine.tag_redraw()

    def draw(self, engine: bpy.types.RenderEngine, context: bpy.types.Context, scene: bpy.types.Scene) -> None:
        """Draw the picture as it stands, and see that it gets better."""
        if self._scene is None:
            return
        with _faults_shown(engine):
            size = (context.region.width, context.region.height)
            view = region_view(context.region_data, context.space_data)
            if size != self._size or not view.same_as(self._view):
                self._size, self._view = size, view
                self._start(_COARSE_PX, size, view)
            finished = self._session.wait(0.0)
            if self._session.samples_done > 0:
                self._texture = _texture(self._session.read("Combined"))
            if finished and self._pixel_px > 1:
                self._start(1, size, view)
                finished = False
            if self._texture is not None:
                _draw_texture(engine, scene, self._texture, size)
            samples = f"Sample {self._session.samples_done}/{self._samples}"
            engine.update_stats("Pivot", "Finished" if finished else samples)
            if not finished:
                _redraw_soon(engine)

    def _start(self, pixel_px: int, size: tuple[int, int], view: RegionView) -> None:
        self._stop()
        width, height = (max(1, side // pixel_px) for side in size)
        self._scene.set_camera(
            view.camera_to_world, view.view_plane, width, height, (0, 0, width, height), *view.clip_m
        )
        self._session = self._core.Session(self._scene, self._settings[pixel_px])
        self._session.start()
        self._pixel_px = pixel_px

    def _stop(self) -> None:
        if self._session is not None:
            self._session.stop()
            self._session = None


@contextlib.contextmanager
def _faults_shown(engine: bpy.types.RenderEngine) -> Iterator[None]:
    """Show a fault in the 3D view's corner: an exception there would come again with each redraw."""
    try:
        yield
    except (RenderError, MemoryError) as error:
        engine.update_stats("Pivot", str(error) or "out of memory")
    except Exception as error:
        traceback.print_exc()
        engine.update_stats("Pivot", f"internal error: {type(error).__name__}: {error}")


def _redraw_soon(engine: bpy.types.RenderEngine) -> None:
    def redraw() -> None:
        with contextlib.suppress(ReferenceError):  # the engine may be freed by then
            engine.tag_redraw()

    bpy.app.timers.register(redraw, first_interval=_REDRAW_S)


def _texture(pixels: NDArray[np.float32]) -> Any:
    """A texture of (height, width, 4) pixels, the bottom row first."""
    import gpu  # is not there in the background

    height, width = pixels.shape[:2]
    values = np.clip(pixels, -_LARGEST_HALF, _LARGEST_HALF).ravel()
    buffer = gpu.types.Buffer("FLOAT", values.size, values)
    return gpu.types.GPUTexture((width, height), format="RGBA16F", data=buffer)


def _draw_texture(engine: bpy.types.RenderEngine, scene: bpy.types.Scene, texture: Any, size: tuple[int, int]) -> None:
    import gpu
    from gpu_extras.presets import draw_texture_2d

    gpu.state.blend_set("ALPHA_PREMULT")
    engine.bind_display_space_shader(scene)
    draw_texture_2d(texture, (0, 0), *size)
    engine.unbind_display_space_shader()
    gpu.state.blend_set("NONE")
