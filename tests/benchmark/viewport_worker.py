"""What viewport.py does in a Blender with a window: viewport_worker.py -- FOLDER ENGINE. Writes FOLDER/result.json."""

from __future__ import annotations

import statistics
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import bpy

# isort: split
import addon_utils
import bmesh
from mathutils import Quaternion

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "addon" / "inside"))
import window

ENGINE = sys.argv[-1]
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
    groups: Any = sys.modules["pivot.export.groups"]
    draw, start, arrays = module.Viewport.draw, module.Viewport._start, groups.mesh_arrays

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

    module.Viewport.draw, module.Viewport._start, groups.mesh_arrays = watched_draw, watched_start, watched_arrays


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


def steps() -> Iterator[Callable[[], bool]]:
    bpy.ops.wm.read_homefile(use_empty=False, use_factory_startup=True)
    addon_utils.enable("pivot")
    addon_utils.enable("cycles")
    yield window.after(0.5)
    with window.in_view():
        bpy.ops.screen.screen_full_area(use_hide_panels=True)
    yield window.after(0.5)
    main, area = window.view()
    region = window.region()
    events["size"] = region.width, region.height
    space, scene = area.spaces.active, main.scene
    space.overlay.show_overlays = space.show_gizmo = False
    scene.render.engine = ENGINE
    scene.pivot.samples = scene.cycles.preview_samples = 1
    if ENGINE == "PIVOT":
        watch_pivot()
    space.shading.type = "RENDERED"
    yield window.after(4.0)
    draws.clear()
    starts.clear()
    began_s, cpu_s = time.monotonic(), time.process_time()
    turn = Quaternion((0, 0, 1), 0.01)
    while time.monotonic() < began_s + ORBIT_S:
        space.region_3d.view_rotation = turn @ space.region_3d.view_rotation
        yield window.now
    events["orbit"], events["cpu_s"] = [began_s, time.monotonic()], time.process_time() - cpu_s
    if draws:
        events["draw_ms"] = [1e3 * value for value in statistics.quantiles(draws, n=20)][9::9]
        events["draws"] = len(draws)
        events["pixel_px"] = statistics.median(edge_px for *_, edge_px in starts if edge_px > 1)
    yield window.after(REST_S)
    cube, lamp = bpy.data.objects["Cube"], bpy.data.objects["Light"]
    for name, moved in (("object in the default scene", cube), ("object", None), ("lamp", lamp)):
        if moved is None:
            moved = grid(-1.5)
            grid(1.5)
            yield window.after(3 * REST_S)
        events["edits"][name] = []
        for number in range(EDITS):
            exported.clear()
            starts.clear()
            edited_s, cpu_s = time.monotonic(), time.thread_time()
            moved.location.x += 0.5 if number % 2 == 0 else -0.5
            yield window.after(REST_S)
            start_ms = 1e3 * (starts[0][0] - edited_s) if starts else None
            cpu_ms = 1e3 * (starts[0][1] - cpu_s) if starts else None
            events["edits"][name].append(
                {"time_s": edited_s, "meshes": len(exported), "start_ms": start_ms, "cpu_ms": cpu_ms}
            )
    window.write(events)


window.follow(steps(), deadline_s=300.0, poll_s=TICK_S)
