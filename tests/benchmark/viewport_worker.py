"""What viewport.py does in a Blender with a window: viewport_worker.py -- FOLDER ENGINE. Writes FOLDER/result.json."""

from __future__ import annotations

import json
import statistics
import sys
import time
import traceback
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import bpy

# isort: split
import addon_utils
import bmesh
from mathutils import Quaternion

FOLDER, ENGINE = Path(sys.argv[-2]), sys.argv[-1]
TICK_S = 0.004
ORBIT_S = 6.0
REST_S = 2.5
EDITS = 6
GRID_SIDE = 500  # of each of two grids; twice its square are triangles

events: dict[str, Any] = {"orbit": [], "edits": {}}
draws: list[float] = []
starts: list[tuple[float, float, float]] = []  # when a picture was begun, by the clock and CPU, and its pixels' edge
exported: list[float] = []  # when a mesh was


def watch_pivot() -> None:
    module: Any = sys.modules["pivot.viewport"]
    scene: Any = sys.modules["pivot.export.scene"]
    draw, start, arrays = module.Viewport.draw, module.Viewport._start, scene.mesh_arrays

    def watched_draw(*arguments: Any) -> None:
        since_s = time.perf_counter()
        draw(*arguments)
        draws.append(time.perf_counter() - since_s)

    def watched_start(viewport: Any, settings: Any, pixel_px: float) -> None:
        start(viewport, settings, pixel_px)
        starts.append((time.monotonic(), time.thread_time(), pixel_px))

    def watched_arrays(mesh: Any) -> Any:
        exported.append(time.monotonic())
        return arrays(mesh)

    module.Viewport.draw, module.Viewport._start, scene.mesh_arrays = watched_draw, watched_start, watched_arrays


def grid(z: float) -> Any:
    mesh = bpy.data.meshes.new("grid")
    made = bmesh.new()
    bmesh.ops.create_grid(made, x_segments=GRID_SIDE + 1, y_segments=GRID_SIDE + 1, size=2)
    made.to_mesh(mesh)
    made.free()
    result = bpy.data.objects.new("grid", mesh)
    result.location.z = z
    bpy.context.scene.collection.objects.link(result)
    return result


def steps() -> Iterator[float]:
    """Yields how long to wait."""
    bpy.ops.wm.read_homefile(use_empty=False, use_factory_startup=True)
    addon_utils.enable("pivot")
    addon_utils.enable("cycles")
    yield 0.5
    window = bpy.context.window_manager.windows[0]
    area = next(area for area in window.screen.areas if area.type == "VIEW_3D")
    with bpy.context.temp_override(window=window, area=area):
        bpy.ops.screen.screen_full_area(use_hide_panels=True)
    yield 0.5
    area = next(area for area in window.screen.areas if area.type == "VIEW_3D")
    region = next(region for region in area.regions if region.type == "WINDOW")
    events["size"] = region.width, region.height
    space, scene = area.spaces.active, window.scene
    space.overlay.show_overlays = space.show_gizmo = False
    scene.render.engine = ENGINE
    scene.pivot.samples = scene.cycles.preview_samples = 1
    if ENGINE == "PIVOT":
        watch_pivot()
    space.shading.type = "RENDERED"
    yield 4.0
    draws.clear()
    starts.clear()
    began_s, cpu_s = time.monotonic(), time.process_time()
    turn = Quaternion((0, 0, 1), 0.01)
    while time.monotonic() < began_s + ORBIT_S:
        space.region_3d.view_rotation = turn @ space.region_3d.view_rotation
        yield TICK_S
    events["orbit"], events["cpu_s"] = [began_s, time.monotonic()], time.process_time() - cpu_s
    if draws:
        events["draw_ms"] = [1e3 * value for value in statistics.quantiles(draws, n=20)][9::9]
        events["draws"] = len(draws)
        events["pixel_px"] = statistics.median(edge_px for *_, edge_px in starts if edge_px > 1)
    yield REST_S
    cube, lamp = bpy.data.objects["Cube"], bpy.data.objects["Light"]
    for name, moved in (("object in the default scene", cube), ("object", None), ("lamp", lamp)):
        if moved is None:
            moved = grid(-1.5)
            grid(1.5)
            yield 3 * REST_S
        events["edits"][name] = []
        for number in range(EDITS):
            exported.clear()
            starts.clear()
            edited_s, cpu_s = time.monotonic(), time.thread_time()
            moved.location.x += 0.5 if number % 2 == 0 else -0.5
            yield REST_S
            start_ms = 1e3 * (starts[0][0] - edited_s) if starts else None
            cpu_ms = 1e3 * (starts[0][1] - cpu_s) if starts else None
            events["edits"][name].append(
                {"time_s": edited_s, "meshes": len(exported), "start_ms": start_ms, "cpu_ms": cpu_ms}
            )
    (FOLDER / "result.json").write_text(json.dumps(events))


def main() -> None:
    todo = steps()

    def tick() -> float | None:
        try:
            return next(todo)
        except StopIteration:
            pass
        except BaseException:
            traceback.print_exc()
        bpy.ops.wm.quit_blender()
        return None

    bpy.context.preferences.view.show_splash = False
    bpy.app.timers.register(tick, first_interval=0.5, persistent=True)


main()
