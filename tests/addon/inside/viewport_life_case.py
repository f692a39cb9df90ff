"""What befalls 3D views while they are Rendered: viewport_life_case.py -- FOLDER writes FOLDER/result.json and quits.

After each, the scene of every viewport that is drawn must be the same as one that is exported from nothing.
"""

from __future__ import annotations

import gc
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import bpy

sys.path.insert(0, str(Path(__file__).resolve().parent))
import parts
import window
from scene_compared import differing

UNDOS = 50
SWITCHES = 50
MODES = ("EDIT", "SCULPT", "VERTEX_PAINT", "WEIGHT_PAINT", "TEXTURE_PAINT", "OBJECT")
FEW_S = 0.05


def scene() -> None:
    """A ball that moves with time, a floor and a lamp."""
    bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=2)
    ball = bpy.context.object
    ball.name = "ball"
    for frame, x in ((1, -2), (50, 2)):
        ball.location.x = x
        ball.keyframe_insert("location", frame=frame)
    parts.quad("floor", (0, 0, -1)).scale = (6, 6, 1)
    parts.light("lamp", "POINT", (1, 1, 4), energy=800.0)


def render_all() -> None:
    """Blender itself begins with them solid."""
    for area in window.view()[0].screen.areas:
        if area.type == "VIEW_3D":
            area.spaces.active.shading.type = "RENDERED"


def steps() -> Iterator[Callable[[], bool]]:
    bpy.context.preferences.edit.undo_steps = UNDOS + 10
    window.clear()
    yield window.now
    viewports = window.Viewports()
    main, area = window.view()
    main.scene.render.engine, main.scene.pivot.samples = "PIVOT", 1
    area.spaces.active.overlay.show_overlays = False
    with window.in_view():
        scene()
    area.spaces.active.shading.type = "RENDERED"
    yield viewports.have_pictures
    result: dict[str, Any] = {"wrong": [], "views": {}}

    def settled(name: str) -> Callable[[], bool]:
        """Once pictures are there, notes what is wrong in them, and in how many views they are."""

        def done() -> bool:
            if not viewports.have_pictures():
                return False
            result["wrong"] += [name for own in viewports.alive if differing(own)]
            result["views"][name] = len(viewports.alive)
            return True

        return window.after(FEW_S, done)

    for mode in MODES:
        with window.in_view():
            bpy.ops.object.mode_set(mode=mode)
            if mode == "EDIT":
                bpy.ops.transform.resize(value=(1.2, 1.2, 1.2))
        yield settled(mode)

    with window.in_view():
        bpy.ops.screen.animation_play()
    frame = main.scene.frame_current
    yield lambda: main.scene.frame_current > frame + 5
    with window.in_view():
        bpy.ops.screen.animation_play()
    yield settled("playback")

    with window.in_view():
        bpy.ops.ed.undo_push(message="before")
    for number in range(UNDOS):
        bpy.data.objects["floor"].location.z -= 0.01
        bpy.data.lights["lamp"].energy += 10
        if number % 5 == 0:
            bpy.data.meshes["floor"].vertices[0].co.z += 0.1
        with window.in_view():
            bpy.ops.ed.undo_push(message=str(number))
    yield settled("edits")
    for number in range(UNDOS):
        with window.in_view():
            bpy.ops.ed.undo()
        yield window.now if number % 10 else settled("undo")
    yield settled("undos")
    result["undone"] = round(bpy.data.objects["floor"].location.z, 4)

    for number in range(SWITCHES):
        window.view()[0].scene.render.engine = ("BLENDER_WORKBENCH", "PIVOT")[number % 2]
        yield window.after(0.0 if number % 2 else FEW_S, viewports.have_pictures if number % 2 else window.now)
    gc.collect()
    yield settled("switches")

    with window.in_view():
        bpy.ops.screen.region_quadview()
    yield window.after(FEW_S, lambda: len(viewports.alive) == 4)
    yield settled("quad view")
    bpy.data.objects["lamp"].location.x = 2
    yield settled("edit in quad view")
    with window.in_view():
        bpy.ops.screen.region_quadview()
    yield settled("quad view left")
    with window.in_view():
        bpy.ops.screen.area_split(direction="VERTICAL", factor=0.5)
    render_all()
    yield window.after(FEW_S, lambda: len(viewports.alive) >= 2)
    yield settled("two views")
    bpy.data.objects["ball"].scale.x = 2
    yield settled("edit in two views")

    path = str(window.FOLDER / "saved.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path)
    bpy.ops.wm.open_mainfile(filepath=path)
    gc.collect()
    yield window.after(4 * FEW_S)
    render_all()
    yield settled("file loaded")
    window.write(result)


window.follow(steps(), deadline_s=100.0)
