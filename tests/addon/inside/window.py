"""The 3D view of a Blender with a window, what the screen shows of it, and steps that wait for one another."""

from __future__ import annotations

import json
import struct
import sys
import time
import traceback
import weakref
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import addon_utils
import bpy

FOLDER = Path(sys.argv[sys.argv.index("--") + 1])
POLL_S = 0.02


def clear() -> None:
    """Blender as it starts, with the addon and without objects."""
    bpy.ops.wm.read_homefile(use_empty=False, use_factory_startup=True)
    addon_utils.enable("pivot")
    for made in list(bpy.data.objects):
        bpy.data.objects.remove(made)


def view() -> tuple[Any, Any]:
    """The window and its 3D view."""
    window = bpy.context.window_manager.windows[0]
    return window, next(area for area in window.screen.areas if area.type == "VIEW_3D")


def region() -> Any:
    return next(region for region in view()[1].regions if region.type == "WINDOW")


def in_view() -> Any:
    """Have operators act as if called in the 3D view."""
    window, area = view()
    return bpy.context.temp_override(window=window, area=area, region=region())


def pixels(places: list[tuple[float, float]]) -> list[list[float]]:
    """RGB at places of the 3D view, in pixels, as the screen shows them: its own screenshots may be black."""
    window, own = view()[0], region()
    data = (FOLDER / "Xvfb_screen0").read_bytes()
    header = struct.unpack(">25I", data[:100])  # XWD's
    header_size, height, row_size, color_count = (header[i] for i in (0, 5, 12, 19))
    first = header_size + 12 * color_count
    found = []
    for x, y in places:  # from below
        row = height - 1 - (window.y + own.y + int(y))
        pixel = first + row * row_size + 4 * (window.x + own.x + int(x))
        found.append([value / 255 for value in data[pixel : pixel + 3][::-1]])
    return found


class Viewports:
    """Those of pivot.viewport that are drawn."""

    def __init__(self) -> None:
        self.alive: weakref.WeakSet[Any] = weakref.WeakSet()
        module: Any = sys.modules["pivot.viewport"]
        draw = module.Viewport.draw

        def watched_draw(viewport: Any, *arguments: Any) -> None:
            self.alive.add(viewport)
            draw(viewport, *arguments)

        module.Viewport.draw = watched_draw

    @property
    def any(self) -> Any:
        return next(iter(self.alive))

    def have_pictures(self) -> bool:
        """Whether all have one of the scene as it is."""
        return len(self.alive) > 0 and all(
            not own._stale and own._session is not None and (not own._is_first or own._session.wait(0.0))
            for own in self.alive
        )

    def rest(self) -> bool:
        """Whether all have ended, and shown it."""
        return self.have_pictures() and all(
            not own._is_first and own._session.wait(0.0) and own._is_end_shown and own._denoiser.is_at_rest
            for own in self.alive
        )


def write(result: Any) -> None:
    """For the test."""
    (FOLDER / "result.json").write_text(json.dumps(result))


def now() -> bool:
    """What need not be waited for."""
    return True


def after(seconds: float, also: Callable[[], bool] = now) -> Callable[[], bool]:
    """What comes true once so long has passed and something else is true."""
    since_s = time.monotonic()
    return lambda: time.monotonic() > since_s + seconds and also()


def follow(steps: Iterator[Callable[[], bool]], deadline_s: float, poll_s: float = POLL_S) -> None:
    """Take the steps: each yields what must come true before the next, which is asked now and then. Then quit."""
    waiting: list[Callable[[], bool]] = [now]
    started_s = time.monotonic()

    def tick() -> float | None:
        try:
            if time.monotonic() > started_s + deadline_s:
                raise TimeoutError("the steps took too long")
            if waiting[0]():
                waiting[0] = next(steps)
            return poll_s
        except StopIteration:
            pass
        except BaseException:
            traceback.print_exc()
        bpy.ops.wm.quit_blender()
        return None

    bpy.context.preferences.view.show_splash = False
    bpy.app.timers.register(tick, first_interval=0.5, persistent=True)
