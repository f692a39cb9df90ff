"""The engine Blender calls: final and preview renders, and the Rendered viewport."""

from __future__ import annotations

import sys
import traceback
from collections.abc import Mapping
from typing import Any, ClassVar

import bpy
from bpy.app.handlers import persistent

from . import core, denoise
from .denoised_passes import denoised_passes
from .export.camera import Frame, export_camera, render_frame
from .export.context import Context
from .export.images import ImageCache
from .export.motion import export_motion, in_the_middle, shutter_of
from .export.scene import export_scene
from .frame_line import FrameCount, frame_line, other_engine_line
from .memory import check_memory, picture_bytes
from .named_passes import named_pass_values, named_passes
from .pass_reader import PassReader
from .passes import (
    channel_count,
    fill_layer,
    has_denoising_passes,
    has_mattes,
    has_surface_passes,
    register_passes,
    report_passes,
    stamp_mattes,
)
from .progress import Progress
from .report import RenderError, Reporter
from .settings import render_settings, sample_count, setting_values, surface_pass_values
from .shadow_catchers import catcher_passes, catcher_values
from .viewport import Viewport

_POLL_S = 0.05  # how soon Esc is seen
_UPDATE_S = 0.4  # between pictures shown while rendering
_PREVIEW_UPDATE_S = 0.1
_PREVIEW_SAMPLES = 16
_PREVIEW_BOUNCES = 4
_PREVIEW_S = 0.4  # later a preview begins no more samples than its first


class _Cancelled(Exception):
    """The artist pressed Esc."""


class PivotRenderEngine(bpy.types.RenderEngine):
    bl_idname = "PIVOT"
    bl_label = "Pivot"
    bl_use_preview = True
    bl_use_eevee_viewport = True  # for Material Preview

    said_in_job: ClassVar[set[str]] = set()  # warnings, cleared when a job begins; on a terminal, with a new file
    # Of the frame being rendered, a FrameCount: typing keeps what ClassVar is given, and bpy 4.5 then hangs at exit.
    frame_count: ClassVar[Any] = FrameCount()
    images: ClassVar[Any] = ImageCache()  # of the job: Blender makes an engine for each frame
    preview_images: ClassVar[Any] = ImageCache()  # of the one before and this one
    strict: ClassVar[bool] = False  # warnings are errors
    viewport: Viewport | None = None  # of the 3D view this engine draws

    # Blender 4.4 renders nothing without it, and from 4.5 calls it twice per engine: no state is made here.
    def __init__(self, *args: Any, **kwargs: Any) -> None:
        super().__init__(*args, **kwargs)

    def update_render_passes(
        self, scene: bpy.types.Scene | None = None, renderlayer: bpy.types.ViewLayer | None = None
    ) -> None:
        register_passes(self, scene, renderlayer)

    def render(self, depsgraph: bpy.types.Depsgraph) -> None:
        """Render one view layer, every view of it. Called once per view layer and frame."""
        context: Context | None = None
        try:
            for view in self._views(depsgraph.scene):
                context = self._render_view(depsgraph, view, context)
        except _Cancelled:
            pass
        except KeyboardInterrupt:  # Ctrl-C, which Blender as a Python module leaves to Python
            self._fail("interrupted")
        except RenderError as error:
            self._fail(str(error))
        except MemoryError:
            self._fail("out of memory. Fix: use fewer or simpler meshes, or instances in place of copies")
        except Exception as error:
            traceback.print_exc()
            self._fail(f"internal error: {type(error).__name__}: {error}")
        if self.is_preview:
            self.preview_images.sweep()

    def _fail(self, text: str) -> None:
        """Say what is wrong. The report makes headless Blender exit with a fault and write no picture."""
        self.report({"ERROR"}, f"Pivot: {text}")
        self.error_set(f"Pivot: {text}")

    def _views(self, scene: bpy.types.Scene) -> list[str]:
        if not scene.render.use_multiview:
            return [""]
        stereo = {"left", "right"} if scene.render.views_format == "STEREO_3D" else None
        return [view.name for view in scene.render.views if view.use and (stereo is None or view.name in stereo)]

    def _render_view(self, depsgraph: bpy.types.Depsgraph, view: str, context: Context | None) -> Context:
        """Render one view ("": the only one). The scene is exported for the first and returned for the next."""
        if view:
            self.active_view_set(view)
        frame = render_frame(depsgraph.scene.render, self.resolution_x, self.resolution_y)
        native = core.load()
        self._check_memory(native, depsgraph.scene, frame)
        result = self.begin_result(0, 0, *frame.window_size, layer=depsgraph.view_layer.name, view=view)
        done = False
        try:
            context = self._export(native, depsgraph, frame, context)
            if self.strict:
                context.reporter.refuse()
            samples, bounces = sample_count(depsgraph), depsgraph.scene.pivot.max_bounces
            if self.is_preview:
                samples, bounces = min(samples, _PREVIEW_SAMPLES), min(bounces, _PREVIEW_BOUNCES)
            scene, mode = depsgraph.scene, denoise.mode_of(depsgraph.scene, context.reporter)
            values = setting_values(scene, samples, bounces)
            values["denoising_passes"] = mode != "NONE" or has_denoising_passes(depsgraph.view_layer)
            if has_mattes(depsgraph.view_layer):
                values["mattes"] = True
            values |= surface_pass_values(context.scene, scene, depsgraph.view_layer)
            values |= named_pass_values(depsgraph.view_layer)
            values |= catcher_values(context.scene, f"scene '{scene.name}'", scene.pivot.denoise, context.reporter)
            report_passes(scene, depsgraph.view_layer, context.reporter)
            settings = render_settings(context.core, scene, values)
            session = context.core.Session(context.scene, settings)
            reader = PassReader(scene, depsgraph.view_layer, values)
            mode = mode if reader.denoises else "NONE"
            self._run(session, samples, mode, result, reader, context.reporter)
            stamp_mattes(self.get_result(), context.mattes, depsgraph.view_layer)
            done = True
        finally:
            self.end_result(result, cancel=not done)
        return context

    def _export(self, native: Any, depsgraph: bpy.types.Depsgraph, frame: Frame, known: Context | None) -> Context:
        """The scene and this view's camera. known: the scene as another view has it, None for the first."""
        shutter = None if self.is_preview else shutter_of(depsgraph.scene, depsgraph.view_layer)
        shown = depsgraph.scene.frame_current
        with in_the_middle(self, depsgraph.scene, shutter):
            context = known
            if context is None:
                self.update_stats("", "Exporting the scene")
                say, said = (_say_nothing, set()) if self.is_preview else (self.report, self.said_in_job)
                reporter = Reporter(say, said)
                cache = self.preview_images if self.is_preview else self.images
                context = export_scene(native, depsgraph, reporter, self._check_cancel, cache, frame=shown)
            motion = None
            if shutter is not None:
                motion = export_motion(context, self, shutter, self._check_cancel, only_camera=known is not None)
            export_camera(context, self, frame, motion)
        return context

    def view_update(self, context: bpy.types.Context, depsgraph: bpy.types.Depsgraph) -> None:
        """Called when the Rendered viewport opens and after each edit."""
        self.viewport = self.viewport or Viewport()
        self.viewport.update(self, context, depsgraph)

    def view_draw(self, context: bpy.types.Context, depsgraph: bpy.types.Depsgraph) -> None:
        """Called whenever the 3D view is drawn, also when only the view has moved."""
        if self.viewport is not None:
            self.viewport.draw(self, context, depsgraph)

    def _check_memory(self, native: Any, scene: bpy.types.Scene, frame: Frame) -> None:
        """Raise RenderError where the picture cannot fit in memory."""
        views = len(self._views(scene))
        channels = [channel_count(layer) for layer in scene.view_layers if layer.use for _ in range(views)]
        width, height = frame.window_size
        denoises = scene.pivot.denoise != "NONE" or any(map(has_denoising_passes, scene.view_layers))
        of_surfaces = any(map(has_surface_passes, scene.view_layers))
        film_pixel_bytes = native.Session.bytes_per_pixel(
            scene.pivot.adaptive,
            denoises,
            of_surfaces,
            any(map(has_mattes, scene.view_layers)),
            max(2 * len(named_passes(layer)) for layer in scene.view_layers) + catcher_passes(scene),
        )
        check_memory(width, height, picture_bytes(width, height, film_pixel_bytes, channels))

    def _check_cancel(self) -> None:
        if self.test_break():
            raise _Cancelled

    def _run(self, session: Any, samples: int, mode: str, result: Any, reader: PassReader, reporter: Reporter) -> None:
        """Render to the end, showing progress and, in the interface, the picture. Raises _Cancelled.

        mode: scene.pivot.denoise, or 'NONE' where that cannot be had.
        """
        progress = Progress(self, samples)
        shown_s, update_s = 0.0, _PREVIEW_UPDATE_S if self.is_preview else _UPDATE_S

        def read(name: str) -> Any:
            return reader.read(session, name)

        def show(known: Mapping[str, Any] | None = None) -> None:
            def read_known(name: str) -> Any:
                return known[name] if known and name in known else read(name)

            layer, exposure = result.layers[0], reader.exposure
            fill_layer(layer, session.width, session.height, reader.named, read_known, exposure)
            self.update_result(result)

        session.start()
        try:
            while not session.wait(_POLL_S):
                self._check_cancel()
                progress.show(session)
                if self.is_preview and progress.elapsed_s > _PREVIEW_S and session.samples_done > 0:
                    session.stop()
                if not bpy.app.background and progress.elapsed_s - shown_s > update_s:
                    show()
                    shown_s = progress.elapsed_s
        finally:
            session.stop()
        progress.show(session, last=True)
        try:
            denoiser = denoise.Denoiser(reader.filter_width_px, self.is_preview)
            show(denoised_passes(denoiser, mode, read, reader.wanted, reader.groups) if mode != "NONE" else None)
        except denoise.DenoiserError as error:  # the picture is there, with its noise
            show()
            reporter.warn(str(error))
        for sample in session.bad_samples:
            reporter.warn(f"a sample was not finite and was left out: {sample}")
        if self.strict:
            reporter.refuse()
        if self.is_preview:
            return
        self.frame_count.samples = max(self.frame_count.samples, samples)
        self.frame_count.samples_done.append(session.samples_done)
        if session.virtual_lights[0] > 0:
            self.frame_count.virtual_lights.append(session.virtual_lights)
        self.frame_count.warnings.update(reporter.warnings)


def _say_nothing(level: set[str], text: str) -> None:
    """For previews, whose scene is Blender's."""


@persistent
def _job_begins(scene: bpy.types.Scene, *_: Any) -> None:
    if bpy.app.background:  # there a frame is a job of its own: warnings are once a run, which is a file's
        line = other_engine_line(scene, sys.argv)
        if line is not None and line not in PivotRenderEngine.said_in_job:
            PivotRenderEngine.said_in_job.add(line)
            print(line, flush=True)
    else:
        PivotRenderEngine.said_in_job.clear()


@persistent
def _file_loaded(*_: Any) -> None:
    PivotRenderEngine.said_in_job.clear()


@persistent
def _frame_begins(*_: Any) -> None:
    PivotRenderEngine.frame_count = FrameCount()


@persistent
def _frame_ended(scene: bpy.types.Scene, *_: Any) -> None:
    count = PivotRenderEngine.frame_count
    if bpy.app.background and count.samples_done:  # none where another engine rendered, or this one failed
        print(frame_line(scene, count), flush=True)
    PivotRenderEngine.images.sweep()


@persistent
def _job_ended(*_: Any) -> None:
    PivotRenderEngine.images = ImageCache()


_HANDLERS = {
    "render_init": _job_begins,
    "load_post": _file_loaded,
    "render_pre": _frame_begins,
    "render_post": _frame_ended,
    "render_complete": _job_ended,
    "render_cancel": _job_ended,
}


def register() -> None:
    bpy.utils.register_class(PivotRenderEngine)
    for event, handler in _HANDLERS.items():
        getattr(bpy.app.handlers, event).append(handler)


def unregister() -> None:
    for event, handler in _HANDLERS.items():
        getattr(bpy.app.handlers, event).remove(handler)
    bpy.utils.unregister_class(PivotRenderEngine)
