"""The Rendered viewport: a coarse picture at once, then the full one, refined sample by sample."""

from __future__ import annotations

import contextlib
import time
import traceback
import weakref
from collections.abc import Iterator
from typing import Any

import bpy

from . import core, denoise
from .export.images import ImageCache
from .export.mesh_cache import MeshCache
from .export.scene import export_scene
from .passes import exposed, film_exposure
from .report import RenderError, Reporter
from .settings import render_settings, sample_count, setting_values
from .shadow_catchers import catcher_picture, catcher_values
from .viewport_denoise import ViewportDenoiser
from .viewport_draw import Picture, draw_picture
from .viewport_pace import Pace
from .viewport_passes import as_colours, core_name, is_light
from .viewport_view import Corners, View, local_parts, shows_all, view_of

_POLL_S = 0.005  # how soon a first picture is seen to be there
_REST_S = 0.02  # a view that has been seen so long is at rest; the hand moves it more often


class Viewport:
    """What one 3D view renders. An edit exports the scene again; a move of the view only restarts the samples.

    The first picture of a view is as coarse as its Pace says and never stopped before it can be shown, so there are
    pictures while things move without pause. The full one begins once that is on the screen and the view rests: before,
    it would take the time of what the hand is to see. It keeps no reference to its engine: the two are freed together,
    and with them the threads.
    """

    def __init__(self) -> None:
        self._said: set[str] = set()  # warnings on the console
        self._warnings: list[str] = []  # of the scene as exported
        self._stale = True  # the scene has changed since
        self._visible: Any = None  # of the scene as exported
        self._local: Any = None  # likewise, what this 3D view shows of it
        self._frame: int | None = None  # of the images in the scene; None: they are of any
        self._core: Any = None
        self._scene: Any = None  # pivot_core.Scene; None before the first export and after a fault
        self._images = ImageCache()
        self._meshes: MeshCache | None = None
        self._layer: Any = None  # that the meshes are of
        self._pace = Pace()
        self._session: Any = None
        self._lights: Any = None  # pivot_core.SessionLights of the scene as exported; None: not known
        self._is_first = False  # whether the session is to give the first picture of its view
        self._seen_s: float | None = None  # when that was on the screen
        self._whole: tuple[Any, float] | None = None  # settings and pixel edge of the session that is to follow it
        self._covers_px: Corners = (0.0, 0.0, 0.0, 0.0)  # by the session's pixels
        self._view: View | None = None  # of the session
        self._settings: dict[str, Any] = {}  # of what it shows
        self._mode = "NONE"  # of denoising, in the session
        self._denoiser = ViewportDenoiser()
        self._is_clean = False  # whether the session's picture was shown without noise
        self._is_end_shown = False  # of the session
        self._samples_read = 0  # of the session
        self._read_s = 0.0
        self._pass = "COMBINED"  # that is shown
        self._exposure = 1.0  # of the film, as shown
        self._of_catchers: dict[str, Any] = {}  # settings that the scene's shadow catchers take
        self._catcher_picture = "WORLD"  # what is shown in their place
        self._picture: Picture | None = None
        self._is_watched = False

    def update(
        self, engine: bpy.types.RenderEngine, context: bpy.types.Context, depsgraph: bpy.types.Depsgraph
    ) -> None:
        """Export an edit, once there is a picture of the edit before: until then draws ask to be called again.

        Only here may Blender's data be written to, which reading some images needs.
        """
        space = context.space_data
        if self._meshes is not None:
            self._meshes.forget(depsgraph.updates)
        moved_on = self._frame not in {None, depsgraph.scene.frame_current}
        if moved_on or any(map(_changes_picture, depsgraph.updates)) or _visible(depsgraph, space) != self._visible:
            self._stale = True
        with _faults_shown(engine):
            if depsgraph.scene.pivot.preview_pause:
                return
            self._choose(space, depsgraph)
            finished = self._take_picture(0.0)
            if self._stale and not self._awaits_first_picture(finished):
                self._export(depsgraph, space)
                self._advance(engine, context, depsgraph, finished=False)
        engine.tag_redraw()

    def draw(self, engine: bpy.types.RenderEngine, context: bpy.types.Context, depsgraph: bpy.types.Depsgraph) -> None:
        """Draw the picture as it stands, and see that it gets better."""
        with _faults_shown(engine):
            self._pace.draw_begins()
            finished = True
            if depsgraph.scene.pivot.preview_pause:
                self._stop()
                state = "Paused"
            else:
                finished = self._follow(engine, context, depsgraph)
                if self._session is None:
                    return
                samples = f"Sample {self._session.samples_done}/{self._settings['samples']}"
                state = "Finished" if finished else samples
            if self._picture is not None:
                draw_picture(engine, depsgraph.scene, self._picture, view_of(context, depsgraph))
            engine.update_stats("Pivot", " | ".join([state, *_in_short(self._warnings)]))
            self._pace.draw_ends()
            if not finished:
                self._watch(engine)

    def _follow(
        self, engine: bpy.types.RenderEngine, context: bpy.types.Context, depsgraph: bpy.types.Depsgraph
    ) -> bool:
        """Take over what there is, and begin what comes next. Returns whether all that is to be shown is there."""
        self._choose(context.space_data, depsgraph)
        finished = self._take_picture(0.0)
        if self._local != local_parts(context.space_data):
            self._stale = True
        if self._awaits_first_picture(finished):
            finished = self._take_picture(self._pace.wait_s)
        if self._awaits_first_picture(finished):
            return False
        if self._stale:
            engine.tag_update()
            return False
        self._is_end_shown = finished = self._advance(engine, context, depsgraph, finished)
        if self._awaits_first_picture(finished) and self._samples_read == 0:
            self._take_picture(self._pace.wait_s)
        return finished and self._denoiser.is_at_rest

    def _choose(self, space: bpy.types.SpaceView3D, depsgraph: bpy.types.Depsgraph) -> None:
        """Take over what of a session is to be shown."""
        scene = depsgraph.scene
        mode = "NONE" if self._of_catchers else denoise.viewport_mode_of(scene)
        catchers, exposure = catcher_picture(scene, depsgraph.view_layer), film_exposure(scene)
        choice = space.shading.pivot.render_pass, mode, catchers, exposure
        if choice != (self._pass, self._mode, self._catcher_picture, self._exposure):
            self._pass, self._mode, self._catcher_picture, self._exposure = choice
            self._samples_read, self._is_clean = 0, False
            self._denoiser.forget()

    def _advance(
        self,
        engine: bpy.types.RenderEngine,
        context: bpy.types.Context,
        depsgraph: bpy.types.Depsgraph,
        finished: bool,
    ) -> bool:
        """Begin what is to be rendered next, where the session is of another view or only gave the first picture.

        finished: whether it has ended. Returns whether all is rendered.
        """
        if self._scene is None:
            return False
        scene, view = depsgraph.scene, view_of(context, depsgraph)
        samples = scene.pivot.preview_samples or sample_count(depsgraph)
        settings = setting_values(scene, samples, scene.pivot.max_bounces)
        settings |= {"denoising_passes": self._mode != "NONE"} | self._of_catchers
        finest_px = engine.get_preview_pixel_size(scene)
        if self._session is None or (view, settings) != (self._view, self._settings):
            self._view, self._settings = view, settings
            self._whole = render_settings(self._core, scene, settings), finest_px
            self._start_first(render_settings(self._core, scene, settings | {"samples": 1}), finest_px)
            return False
        return finished and not self._is_first

    def _export(self, depsgraph: bpy.types.Depsgraph, space: bpy.types.SpaceView3D) -> None:
        """Take over the scene, and say on the console what of it is left out."""
        _ending = self._end()  # it does while the scene is exported
        self._scene, self._lights, self._stale, self._visible = None, None, False, _visible(depsgraph, space)
        self._local = local_parts(space)
        self._core = core.load()
        layer = depsgraph.scene.as_pointer(), depsgraph.view_layer.name
        if self._meshes is None or self._layer != layer:
            self._meshes, self._layer = MeshCache(self._core), layer
        reporter = Reporter(_print_warning, self._said)
        self._warnings = reporter.warnings
        is_shown = None if shows_all(space) else lambda shown: shown.visible_in_viewport_get(space)
        exported = export_scene(self._core, depsgraph, reporter, lambda: None, self._images, self._meshes, is_shown)
        mode = denoise.viewport_mode_of(depsgraph.scene)
        self._of_catchers = catcher_values(exported.scene, "3D view", mode, reporter)
        self._choose(space, depsgraph)
        self._images.sweep()
        self._meshes.sweep()
        self._scene = exported.scene
        self._frame = exported.images.frame if exported.images.shows_frames else None

    def _take_picture(self, wait_s: float) -> bool:
        """Take over what the session has done within wait_s, and return whether it has ended."""
        session = self._session
        if session is None:
            return False
        finished = session.wait(wait_s)
        samples = session.samples_done
        if samples > self._samples_read and self._is_due(finished):
            if self._is_first:
                self._pace.took(session.sampling_s, session.width * session.height)
            if not self._is_clean:
                self._show(self._pixels_of(session))
            self._samples_read, self._read_s = samples, time.monotonic()
        cleaned = self._denoiser.take()
        has_what_it_takes = not self._is_first and self._settings["denoising_passes"]
        if has_what_it_takes and self._mode != "NONE" and self._pass == "COMBINED":
            if cleaned is not None:
                self._is_clean = True
                self._show(cleaned)
            self._denoiser.offer(self._mode, session, self._settings["filter_width_px"], samples, finished)
        return finished

    def _pixels_of(self, session: Any) -> Any:
        if self._pass == "COMBINED" and "shadow_catchers" in self._settings:
            return session.read_shadow_catchers(self._catcher_picture)
        return as_colours(self._pass, session.read(core_name(self._pass)))

    def _is_due(self, has_ended: bool) -> bool:
        """Whether samples that are new in the session are to be shown now."""
        return self._samples_read == 0 or has_ended or time.monotonic() > self._read_s + self._pace.redraw_s

    def _show(self, pixels: Any) -> None:
        if is_light(self._pass):
            pixels = exposed(pixels, self._exposure)
        self._picture = Picture(pixels, self._view, self._covers_px)

    def _awaits_first_picture(self, finished: bool) -> bool:
        return self._session is not None and self._is_first and not finished

    def _start_first(self, settings: Any, finest_px: float) -> None:
        """Begin with a view, by one sample of pixels that are ready soon."""
        left, bottom, right, top = self._view.window_px
        self._start(settings, self._pace.pixel_px((right - left) * (top - bottom), finest_px))
        self._is_first = True

    def _start(self, settings: Any, pixel_px: float) -> None:
        """Begin a session. settings: pivot_core.RenderSettings. pixel_px: the edge of its pixels."""
        self._stop()
        self._covers_px = self._view.set_camera(self._core, self._scene, pixel_px)
        self._session = self._core.Session(self._scene, settings, self._lights)
        self._session.start()
        self._denoiser.forget()
        self._is_first = self._is_clean = self._is_end_shown = False
        self._samples_read, self._seen_s = 0, None

    def _go_on_at_rest(self) -> None:
        """Begin the full picture of a view whose first picture has been on the screen for a while."""
        if not self._is_first or self._samples_read == 0 or self._stale:
            return
        now_s = time.monotonic()
        if self._seen_s is None:
            self._seen_s = now_s
        elif now_s > self._seen_s + _REST_S:
            self._start(*self._whole)

    def _stop(self) -> None:
        self._end()

    def _end(self) -> Any:
        """The session, which ends soon. Who lets go of it waits for that."""
        session, self._session = self._session, None
        if session is not None:
            session.stop()
            self._lights = session.lights or self._lights
        return session

    def _has_news(self) -> bool:
        """Whether a draw would show what the last did not."""
        ended = self._session.wait(0.0)
        if self._is_first:
            return ended and self._samples_read == 0
        if self._session.samples_done > self._samples_read:
            return self._is_due(ended)
        return self._denoiser.has_result or (ended and not self._is_end_shown)

    def _watch(self, engine: bpy.types.RenderEngine) -> None:
        """Have the 3D view drawn as soon as there are news."""
        if self._is_watched:
            return
        self._is_watched, viewport = True, weakref.ref(self)

        def look() -> float | None:
            own = viewport()
            with contextlib.suppress(ReferenceError):  # the engine may be freed by then
                if engine.is_preview or own is None:
                    return None
                with _faults_shown(engine):
                    own._pace.is_on_screen()
                    if own._session is not None and not own._has_news():
                        own._go_on_at_rest()
                        return _POLL_S
                own._is_watched = False
                engine.tag_redraw()
            return None

        bpy.app.timers.register(look)


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


def _visible(depsgraph: bpy.types.Depsgraph, space: bpy.types.SpaceView3D) -> Any:
    """What an export depends on and updates do not tell from a selection."""
    layer, scene, all_are_shown = depsgraph.view_layer, depsgraph.scene, shows_all(space)
    objects = [
        (
            visible.original.as_pointer(),
            visible.is_holdout,
            visible.original.holdout_get(view_layer=layer),
            visible.original.indirect_only_get(view_layer=layer),
            all_are_shown or visible.visible_in_viewport_get(space),
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
