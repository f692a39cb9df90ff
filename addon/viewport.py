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
from .export.images import ImageCache
from .export.scene import export_scene
from .report import RenderError, Reporter
from .settings import render_settings, sample_count, setting_values

_REDRAW_S = 0.1
_COARSE_PX = 4  # edge of a pixel of the first picture
_COARSE_SAMPLES = 2
_COARSE_WAIT_S = 0.05  # a draw waits this long for a coarse picture, so that it shows its own view
_LARGEST_HALF = 65504.0


class Viewport:
    """What one 3D view renders. An edit exports the scene again; a move of the view only restarts the samples.

    A coarse picture is never stopped before it can be shown, so there are pictures while things move without pause.
    It keeps no reference to its engine: the two are freed together, and with them the threads.
    """

    def __init__(self) -> None:
        self._said: set[str] = set()  # warnings on the console
        self._warnings: list[str] = []  # of the scene as exported
        self._stale = True  # the scene has changed since
        self._visible: Any = None  # of the scene as exported
        self._frame: int | None = None  # of the images in the scene; None: they are of any
        self._core: Any = None
        self._scene: Any = None  # pivot_core.Scene; None before the first export and after a fault
        self._images = ImageCache()
        self._session: Any = None
        self._pixel_px = 1  # of the session
        self._size = (0, 0)  # of what the session shows, as are the next two
        self._view: RegionView | None = None
        self._settings: dict[str, Any] = {}
        self._pixels: NDArray[np.float32] | None = None  # the last picture, until it is drawn
        self._texture: Any = None  # the last that was drawn

    def update(self, engine: bpy.types.RenderEngine, depsgraph: bpy.types.Depsgraph) -> None:
        """Export an edit, once there is a picture of the edit before: until then draws ask to be called again.

        Only here may Blender's data be written to, which reading some images needs.
        """
        moved_on = self._frame not in {None, depsgraph.scene.frame_current}
        if moved_on or any(map(_changes_picture, depsgraph.updates)) or _visible(depsgraph) != self._visible:
            self._stale = True
        with _faults_shown(engine):
            if self._stale and not self._awaits_coarse_picture(self._take_picture(0.0)):
                self._export(depsgraph)
        engine.tag_redraw()

    def draw(self, engine: bpy.types.RenderEngine, context: bpy.types.Context, depsgraph: bpy.types.Depsgraph) -> None:
        """Draw the picture as it stands, and see that it gets better."""
        with _faults_shown(engine):
            finished = self._take_picture(0.0)
            scene = depsgraph.scene
            size = (context.region.width, context.region.height)
            if self._stale:
                if not self._awaits_coarse_picture(finished):
                    engine.tag_update()
                finished = False
            elif self._scene is not None and not self._awaits_coarse_picture(finished):
                view = region_view(context.region_data, context.space_data)
                settings = setting_values(scene, sample_count(depsgraph), scene.pivot.max_bounces)
                if self._session is None or not self._shows(size, view, settings):
                    self._size, self._view, self._settings = size, view, settings
                    self._start(scene, _COARSE_PX)
                    self._take_picture(_COARSE_WAIT_S)
                    finished = False
                elif finished and self._pixel_px > 1:
                    self._start(scene, 1)
                    finished = False
            if self._session is None:
                return
            if self._pixels is not None:
                self._texture, self._pixels = _texture(self._pixels), None
            if self._texture is not None:
                _draw_texture(engine, scene, self._texture, size)
            samples = f"Sample {self._session.samples_done}/{self._settings['samples']}"
            engine.update_stats("Pivot", " | ".join(["Finished" if finished else samples, *_in_short(self._warnings)]))
            if not finished:
                _redraw_soon(engine)

    def _export(self, depsgraph: bpy.types.Depsgraph) -> None:
        """Take over the scene, and say on the console what of it is left out."""
        self._stop()
        self._scene, self._stale, self._visible = None, False, _visible(depsgraph)
        self._core = core.load()
        reporter = Reporter(_print_warning, self._said)
        self._warnings = reporter.warnings
        exported = export_scene(self._core, depsgraph, reporter, lambda: None, self._images)
        self._images.sweep()
        self._scene = exported.scene
        self._frame = exported.images.frame if exported.images.shows_frames else None

    def _take_picture(self, wait_s: float) -> bool:
        """Take over what the session has done within wait_s, and return whether it has ended."""
        if self._session is None:
            return False
        finished = self._session.wait(wait_s)
        if self._session.samples_done > 0:
            self._pixels = self._session.read("Combined")
        return finished

    def _awaits_coarse_picture(self, finished: bool) -> bool:
        return self._session is not None and self._pixel_px > 1 and not finished and self._session.samples_done == 0

    def _shows(self, size: tuple[int, int], view: RegionView, settings: dict[str, Any]) -> bool:
        """Whether the session is of this view."""
        return (size, settings) == (self._size, self._settings) and view.same_as(self._view)

    def _start(self, scene: bpy.types.Scene, pixel_px: int) -> None:
        """Begin a session. pixel_px: the edge of its pixels."""
        self._stop()
        view, settings = self._view, self._settings
        width, height = (max(1, side // pixel_px) for side in self._size)
        self._scene.set_camera(view.camera_to_world, width=width, height=height, **view.optics.arguments(self._core))
        if pixel_px > 1:
            settings = settings | {"samples": min(settings["samples"], _COARSE_SAMPLES)}
        self._session = self._core.Session(self._scene, render_settings(self._core, scene, settings))
        self._session.start()
        self._pixel_px = pixel_px

    def _stop(self) -> None:
        if self._session is not None:
            self._session.stop()
            self._session = None


def _changes_picture(update: bpy.types.DepsgraphUpdate) -> bool:
    """Selecting, renaming an object and the like come as updates that say of no part that it changed.

    So does a value in a light's nodes, of the light; and a hidden object, of the scene, which is said to have changed
    altogether when a setting of scene.pivot is: see _visible.
    """
    if isinstance(update.id, (bpy.types.Light, bpy.types.World)):
        return True
    if isinstance(update.id, bpy.types.Scene):
        return False
    if isinstance(update.id, bpy.types.Camera) or (
        isinstance(update.id, bpy.types.Object) and update.id.type == "CAMERA"
    ):
        return False  # each draw reads the 3D view's own
    return update.is_updated_geometry or update.is_updated_transform or update.is_updated_shading


def _visible(depsgraph: bpy.types.Depsgraph) -> Any:
    """What an export depends on and updates do not tell from a selection."""
    layer, scene = depsgraph.view_layer, depsgraph.scene
    objects = [
        (
            visible.original.as_pointer(),
            visible.is_holdout,
            visible.original.holdout_get(view_layer=layer),
            visible.original.indirect_only_get(view_layer=layer),
        )
        for visible in depsgraph.objects
    ]
    override, world = layer.material_override, scene.world
    # The integrators leave out different things, which an export says.
    of_scene = world and world.as_pointer(), scene.pivot.integrator
    return objects, layer.use_solid, override and override.as_pointer(), of_scene


def _print_warning(_: set[str], text: str) -> None:
    """On the console: RenderEngine.report reaches nobody from the viewport."""
    print(f"Warning: {text}", flush=True)


def _in_short(warnings: list[str]) -> list[str]:
    """What a line in the 3D view has room for."""
    if not warnings:
        return []
    count = "1 thing is" if len(warnings) == 1 else f"{len(warnings)} things are"
    return [f"{count} not shown as set: {warnings[0]}"]


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
