"""What of a scene the Rendered viewport shows, and where: viewport_view_case.py -- FOLDER writes FOLDER/result.json.

Before a blue world stand a red and a green lamp. Blender tells where in the 3D view they are.
"""

from __future__ import annotations

import json
import math
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import bpy

# isort: split
from bpy_extras.view3d_utils import location_3d_to_region_2d
from mathutils import Vector

sys.path.insert(0, str(Path(__file__).resolve().parent))
import parts
import window

STEP_S = 6.0
NAMES = ("red", "green", "blue")
RED, GREEN = (-0.5, 0, 0), (0.7, 0.3, 0)
WIDE = 0.6  # half the angle that a panorama sees
EDGE_PX = 8  # between a place that must be of a lamp, and one that must not, are twice as many


def lamp(colour: str, place: tuple[float, float, float]) -> Any:
    rgba = (*(float(colour == name) for name in NAMES), 1.0)
    material = parts.shaded(colour, "ShaderNodeEmission", Color=rgba)[0]
    made = parts.quad(colour, place, material)
    made.scale = (0.25, 0.25, 1)
    return made


def name_of(rgb: list[float]) -> str:
    bright = [name for name, value in zip(NAMES, rgb, strict=True) if value > 0.9]
    return bright[0] if len(bright) == 1 and sum(rgb) < 1.3 else "other"


def place(point: tuple[float, float, float]) -> tuple[float, float]:
    """In pixels of the 3D view."""
    return tuple(location_3d_to_region_2d(window.region(), window.view()[1].spaces.active.region_3d, point))


def share(x: float, y: float) -> tuple[float, float]:
    region = window.region()
    return x * region.width, y * region.height


def lamp_places() -> list[tuple[float, float]]:
    """The middle of both lamps, and what lies just within and just beyond the left edge of the red one."""
    edge = place((RED[0] - 0.25, 0, 0))
    return [place(RED), place(GREEN), (edge[0] + EDGE_PX, edge[1]), (edge[0] - EDGE_PX, edge[1])]


def on_sphere(camera: Any, point: tuple[float, float, float]) -> tuple[float, float]:
    """In pixels of the 3D view, where a camera that sees WIDE angles to all sides sees a point."""
    right, up, depth = (camera.matrix_world.inverted() @ Vector(point)) * Vector((1, 1, -1))
    angles = math.atan2(right, depth), math.atan2(up, math.hypot(right, depth))
    corners = [place(camera.matrix_world @ corner) for corner in camera.data.view_frame(scene=bpy.context.scene)]
    (x1, y1), (x0, y0) = corners[0], corners[2]
    u, v = (0.5 + angle / (2 * WIDE) for angle in angles)
    return x0 + (u - camera.data.shift_x) * (x1 - x0), y0 + v * (y1 - y0)


ALL = ["red", "green", "red", "blue"]


def steps() -> Iterator[Callable[[], bool]]:
    window.clear()
    yield lambda: True
    viewport: Any = sys.modules["pivot.viewport"]
    sizes: list[tuple[int, int]] = [(0, 0)]
    start = viewport.Viewport._start

    def watched_start(self: Any, *arguments: Any) -> None:
        start(self, *arguments)
        sizes[0] = self._session.width, self._session.height

    stretched: list[float] = []  # of a picture of another size: how much wider it is drawn than high
    draw_picture = viewport.draw_picture

    def watched_draw(engine: Any, scene: Any, shown: Any, view: Any) -> None:
        if shown.view.size_px != view.size_px:
            left, bottom, right, top = view.place_of((0, 0, *shown.view.size_px), shown.view)
            width, height = shown.view.size_px
            stretched.append((right - left) / (top - bottom) / (width / height))
        draw_picture(engine, scene, shown, view)

    held = [0]  # so often the viewport finds no new picture, and draws the one before
    take_picture = viewport.Viewport._take_picture

    def held_take(self: Any, wait_s: float) -> Any:
        held[0] -= 1
        return held[0] < 0 and take_picture(self, wait_s)

    viewport.Viewport._start, viewport.draw_picture = watched_start, watched_draw
    viewport.Viewport._take_picture = held_take
    result: dict[str, Any] = {}

    def seen(
        name: str, expected: list[str], places: Callable[[], list[tuple[float, float]]] = lamp_places
    ) -> Callable[[], bool]:
        """The colours at places, once they are as expected and the viewport rests, or time is over."""
        since_s = time.monotonic()

        def done() -> bool:
            area.tag_redraw()
            elapsed_s = time.monotonic() - since_s
            found = [name_of(rgb) for rgb in window.pixels(places())]
            result[name] = {"expected": expected, "found": found, "size": sizes[0]}
            return elapsed_s > STEP_S or (found == expected and elapsed_s > 0.7)

        return done

    main, area = window.view()
    scene, space, region_3d = main.scene, area.spaces.active, area.spaces.active.region_3d
    scene.world.node_tree.nodes["Background"].inputs["Color"].default_value = (0, 0, 1, 1)
    lamps = {"red": lamp("red", RED), "green": lamp("green", GREEN)}
    collection = bpy.data.collections.new("of green")
    scene.collection.children.link(collection)
    scene.collection.objects.unlink(lamps["green"])
    collection.objects.link(lamps["green"])
    camera = parts.camera((0, 0, 5))
    scene.render.engine, scene.view_settings.view_transform, scene.pivot.samples = "PIVOT", "Standard", 4
    space.overlay.show_overlays = False
    space.region_3d.view_rotation, space.region_3d.view_distance = (1, 0, 0, 0), 5
    region_3d.view_perspective = "PERSP"
    space.shading.type = "RENDERED"
    yield seen("perspective", ALL)
    region = window.region()
    result["region"] = region.width, region.height

    corners = [share(0.3, 0.3), share(0.7, 0.7), share(0.1, 0.5), share(0.9, 0.5)]
    space.use_render_border = True
    space.render_border_min_x, space.render_border_max_x = 0.25, 0.75
    space.render_border_min_y, space.render_border_max_y = 0.25, 0.75
    yield seen("border", ["blue", "blue", "other", "other"], lambda: corners)
    yield seen("in border", ["red"], lambda: [place(RED)])
    space.use_render_border = False
    scene.render.preview_pixel_size = "2"
    yield seen("large pixels", ALL)
    scene.render.preview_pixel_size = "1"

    region_3d.view_perspective = "CAMERA"
    yield seen("camera", ALL)
    region_3d.view_camera_zoom, region_3d.view_camera_offset = 20, (0.05, -0.1)
    camera.data.shift_x = 0.1
    yield seen("camera, moved", ALL)
    camera.data.clip_end = 4
    yield seen("camera, clipped", ["blue"] * 4)
    camera.data.clip_end = 100
    scene.render.use_border = True
    scene.render.border_min_x, scene.render.border_max_x = 0.5, 1.0
    scene.render.border_min_y, scene.render.border_max_y = 0.0, 1.0
    frame = camera.data.view_frame(scene=scene)
    middle = sum((camera.matrix_world @ corner for corner in frame), start=camera.location * 0) / 4
    yield seen(
        "camera border",
        ["other", "blue"],
        lambda: [(place(middle)[0] - EDGE_PX, place(middle)[1]), (place(middle)[0] + EDGE_PX, place(middle)[1])],
    )
    scene.render.use_border = False
    panorama = sys.modules["pivot.export.optics"].panorama_settings(camera.data)  # type: ignore[attr-defined]
    camera.data.type, panorama.panorama_type = "PANO", "EQUIRECTANGULAR"
    panorama.longitude_min, panorama.longitude_max = -WIDE, WIDE
    panorama.latitude_min, panorama.latitude_max = -WIDE, WIDE
    yield seen("panorama", ["red", "green"], lambda: [on_sphere(camera, RED), on_sphere(camera, GREEN)])
    camera.data.type = "PERSP"
    region_3d.view_perspective = "ORTHO"
    yield seen("orthographic", ALL)
    region_3d.view_perspective = "PERSP"

    lamps["red"].select_set(True)
    main.view_layer.objects.active = lamps["red"]
    with window.in_view():
        bpy.ops.view3d.localview(frame_selected=False)
    yield seen("local view", ["red", "blue"], lambda: lamp_places()[:2])
    with window.in_view():
        bpy.ops.view3d.localview(frame_selected=False)
    yield seen("local view left", ALL)
    space.use_local_collections = True
    with window.in_view():
        bpy.ops.object.hide_collection(collection_index=2, toggle=True)
    yield seen("local collections", ["red", "blue"], lambda: lamp_places()[:2])
    space.use_local_collections = False
    yield seen("all collections", ALL)
    space.show_object_viewport_mesh = False
    yield seen("no meshes", ["blue"] * 4)
    space.show_object_viewport_mesh = True
    lamps["green"].hide_viewport = True
    yield seen("hidden in viewports", ["red", "blue"], lambda: lamp_places()[:2])
    lamps["green"].hide_viewport = False
    for region_3d.view_perspective in ("PERSP", "ORTHO"):
        yield seen("before a resize", ALL)
        held[0] = 5
        with window.in_view():
            bpy.ops.screen.area_split(direction="VERTICAL", factor=0.7)
        yield seen("resized", ["blue"], lambda: [share(0.5, 0.1)])
    result["stretched"] = stretched
    (window.FOLDER / "result.json").write_text(json.dumps(result))


window.follow(steps(), deadline_s=140.0)
