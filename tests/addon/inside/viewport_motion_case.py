"""The Rendered viewport while things change without pause: viewport_motion_case.py -- FOLDER writes FOLDER/result.json.

The view stands in the middle of a ring of lamps, the k-th of radiance k + 1, so that the middle of a picture tells
where the view looked, or how strong the lamp before it was, when it was rendered.
"""

from __future__ import annotations

import math
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

# isort: split
from mathutils import Euler

sys.path.insert(0, str(Path(__file__).resolve().parent))
import parts
import window

SECTORS = 40
TICK_S = 0.01
QUIET_S = 1.5  # without a new session


class Watch:
    """What the viewport did since the last clear()."""

    def __init__(self) -> None:
        self.k = 0  # what a picture of this moment shows
        self.started_s = 0.0  # the last session
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

    def quiet(self) -> Callable[[], bool]:
        """Once no session has been started for a while from now on."""
        return window.after(QUIET_S, lambda: time.monotonic() - self.started_s > QUIET_S)


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


def steps() -> Iterator[Callable[[], bool]]:
    window.clear()
    watch.install()
    yield window.now
    main, area = window.view()
    scene, layer = main.scene, main.view_layer
    lamps = [lamp(k) for k in range(SECTORS)]
    light = parts.light("fill", "POINT", (0, 0, 100))
    parts.light("oval", "SPOT", (0, 0, 200), energy=0.001).scale = (1, 2, 1)
    scene.render.engine = "PIVOT"
    scene.pivot.samples = 256
    region = area.spaces.active.region_3d
    region.view_perspective, region.view_location, region.view_distance = "PERSP", (0, 0, 0), 0.001
    look_at(region, 0)
    area.spaces.active.shading.type = "RENDERED"
    yield window.now
    result = {}
    yield lambda: len(watch.pictures) > 0

    watch.clear()
    for k in range(SECTORS):
        look_at(region, k)
        yield window.now
    result["orbit"] = watch.seen()
    look_at(region, 0)
    scene.pivot.samples = 4
    yield watch.quiet()

    watch.clear()
    strength = lamps[0].active_material.node_tree.nodes["Emission"].inputs["Strength"]
    for watch.k in range(SECTORS):
        strength.default_value = watch.k + 1
        light.location.x = watch.k
        yield window.now
    result["drag"] = watch.seen()
    yield watch.quiet()

    watch.clear()
    for made in (lamps[1], light):
        made.select_set(True)
        layer.objects.active = made
        yield window.now
    lamps[1].name = "renamed"
    yield window.now
    scene.name = "also renamed"
    next(area for area in main.screen.areas if area.type == "PROPERTIES").spaces.active.context = "WORLD"
    yield window.now
    area.spaces.active.overlay.show_floor = False
    yield watch.quiet()
    result["idle"] = watch.seen()

    watch.clear()
    for scene.pivot.seed in range(1, 4):
        yield window.now
    scene.pivot.max_bounces = 2
    yield watch.quiet()
    result["settings"] = watch.seen()

    watch.clear()
    lamps[1].hide_set(True)
    yield watch.quiet()
    result["hidden"] = watch.seen()
    result["text"] = watch.text
    window.write(result)


window.follow(steps(), deadline_s=60.0, poll_s=TICK_S)
