"""The Rendered viewport while things change without pause: viewport_motion_case.py -- FOLDER writes FOLDER/result.json.

The view stands in the middle of a ring of lamps, the k-th of radiance k + 1, so that the middle of a picture tells
where the view looked, or how strong the lamp before it was, when it was rendered.
"""

from __future__ import annotations

import json
import math
import sys
import time
import traceback
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import bpy

# isort: split
import addon_utils
from mathutils import Euler

sys.path.insert(0, str(Path(__file__).resolve().parent))
import parts

SECTORS = 40
TICK_S = 0.01
QUIET_S = 1.5  # without a new session
DEADLINE_S = 60.0
FOLDER = Path(sys.argv[sys.argv.index("--") + 1])


class Watch:
    """What the viewport did since the last clear()."""

    def __init__(self) -> None:
        self.k = 0  # what a picture of this moment shows
        self.started_s = 0.0  # the last session, or step
        self.text: list[str] = []  # of the reports, in the last draw
        self.clear()

    def clear(self) -> None:
        self.sessions = self.exports = 0
        self.draws: list[int] = []  # k at each draw
        self.pictures: list[int] = []  # how many draws old, each picture once
        self._last: Any = None

    def install(self) -> None:
        viewport: Any = sys.modules["pivot.viewport"]
        draw, start, export = viewport.Viewport.draw, viewport.Viewport._start, viewport.Viewport._export
        draw_picture, in_short = viewport.draw_picture, viewport._in_short

        def watched_draw(*arguments: Any) -> None:
            self.draws.append(self.k)
            draw(*arguments)

        def watched_start(*arguments: Any) -> None:
            self.sessions += 1
            self.started_s = time.monotonic()
            start(*arguments)

        def watched_export(*arguments: Any) -> None:
            self.exports += 1
            export(*arguments)

        def watched_picture(engine: Any, scene: Any, shown: Any, view: Any) -> None:
            texture = shown.texture
            if texture is not self._last:
                row = texture.read()[texture.height // 2]
                k = round(row[texture.width // 2][0]) - 1
                draws_ago = self.draws[::-1].index(k) if k in self.draws else -1
                self.pictures.append(draws_ago)
            self._last = texture
            draw_picture(engine, scene, shown, view)

        def watched_in_short(warnings: list[str]) -> list[str]:
            self.text = in_short(warnings)
            return self.text

        viewport.Viewport.draw, viewport.Viewport._start = watched_draw, watched_start
        viewport.Viewport._export = watched_export
        viewport.draw_picture, viewport._in_short = watched_picture, watched_in_short

    def seen(self) -> dict[str, Any]:
        return {"sessions": self.sessions, "exports": self.exports, "draws": len(self.draws), "pictures": self.pictures}

    def is_quiet(self) -> bool:
        return time.monotonic() - self.started_s > QUIET_S


watch = Watch()


def lamp(k: int) -> Any:
    angle = 2 * math.pi * k / SECTORS
    material = parts.shaded(f"lamp {k}", "ShaderNodeEmission", Color=(1, 1, 1, 1), Strength=k + 1)[0]
    made = parts.quad(f"lamp {k}", (5 * math.cos(angle), 5 * math.sin(angle), 0), material)
    made.rotation_euler = (math.pi / 2, 0, angle + math.pi / 2)
    made.scale = (0.35, 0.35, 1)
    return made


def look_at(region: Any, k: int) -> None:
    region.view_rotation = Euler((math.pi / 2, 0, 2 * math.pi * k / SECTORS - math.pi / 2)).to_quaternion()
    watch.k = k


def steps() -> Iterator[bool]:
    """Does one thing at a time; yields whether the viewport must come to rest before the next."""
    bpy.ops.wm.read_homefile(use_empty=False, use_factory_startup=True)
    addon_utils.enable("pivot")
    watch.install()
    for made in list(bpy.data.objects):
        bpy.data.objects.remove(made)
    yield False
    window = bpy.context.window_manager.windows[0]
    scene, layer = window.scene, window.view_layer
    area = next(area for area in window.screen.areas if area.type == "VIEW_3D")
    lamps = [lamp(k) for k in range(SECTORS)]
    light = parts.light("fill", "POINT", (0, 0, 100))
    parts.quad("catcher", (0, 0, 200)).is_shadow_catcher = True
    scene.render.engine = "PIVOT"
    scene.pivot.samples = 256
    region = area.spaces.active.region_3d
    region.view_perspective, region.view_location, region.view_distance = "PERSP", (0, 0, 0), 0.001
    look_at(region, 0)
    area.spaces.active.shading.type = "RENDERED"
    yield False
    result = {}
    while not watch.pictures:
        yield False

    watch.clear()
    for k in range(SECTORS):
        look_at(region, k)
        yield False
    result["orbit"] = watch.seen()
    look_at(region, 0)
    scene.pivot.samples = 4
    yield True

    watch.clear()
    strength = lamps[0].active_material.node_tree.nodes["Emission"].inputs["Strength"]
    for watch.k in range(SECTORS):
        strength.default_value = watch.k + 1
        light.location.x = watch.k
        yield False
    result["drag"] = watch.seen()
    yield True

    watch.clear()
    for made in (lamps[1], light):
        made.select_set(True)
        layer.objects.active = made
        yield False
    lamps[1].name = "renamed"
    yield False
    scene.name = "also renamed"
    next(area for area in window.screen.areas if area.type == "PROPERTIES").spaces.active.context = "WORLD"
    yield False
    area.spaces.active.overlay.show_floor = False
    yield True
    result["idle"] = watch.seen()

    watch.clear()
    for scene.pivot.seed in range(1, 4):
        yield False
    scene.pivot.max_bounces = 2
    yield True
    result["settings"] = watch.seen()

    watch.clear()
    lamps[1].hide_set(True)
    yield True
    result["hidden"] = watch.seen()
    result["text"] = watch.text
    (FOLDER / "result.json").write_text(json.dumps(result))


todo, began_s, must_rest = steps(), time.monotonic(), False


def tick() -> float | None:
    global must_rest
    late = time.monotonic() - began_s > DEADLINE_S
    if must_rest and not watch.is_quiet() and not late:
        return TICK_S
    try:
        must_rest = next(todo)
    except BaseException as ended:
        if not isinstance(ended, StopIteration):
            traceback.print_exc()
        late = True
    if late:
        bpy.ops.wm.quit_blender()
        return None
    watch.started_s = time.monotonic()
    return TICK_S


bpy.context.preferences.view.show_splash = False
bpy.app.timers.register(tick, first_interval=0.5, persistent=True)
