"""The Rendered viewport of a Blender with a window: viewport_case.py -- FOLDER writes FOLDER/result.json and quits.

Each step waits until the middle of the 3D view has the colour it is to have: first a red lamp's, then, moved, a green
one's behind it, then, the view turned about, the world's blue.
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
import addon_utils

sys.path.insert(0, str(Path(__file__).resolve().parent))
from window import FOLDER, pixels, region, view

DEADLINE_S = 60.0
POLL_S = 0.5


def middle() -> list[float]:
    """RGB of the middle of the 3D view, as the screen shows it."""
    own = region()
    return pixels([(own.width // 2, own.height // 2)])[0]


def lamp(name: str, colour: tuple[float, float, float, float], z: float) -> Any:
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata([(-9, -9, 0), (9, -9, 0), (9, 9, 0), (-9, 9, 0)], [], [(0, 1, 2, 3)])
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    tree = material.node_tree
    emission = tree.nodes.new("ShaderNodeEmission")
    emission.inputs["Color"].default_value = colour
    tree.links.new(emission.outputs[0], tree.nodes["Material Output"].inputs["Surface"])
    mesh.materials.append(material)
    made = bpy.data.objects.new(name, mesh)
    made.location.z = z
    bpy.context.scene.collection.objects.link(made)
    return made


def hide_the_sun(scene: Any) -> None:
    """A green ground before all, under a sun that is behind a lid, which rays to lights meet and the view does not."""
    ground = lamp("ground", (0, 1, 0, 1), -1)
    tree = ground.active_material.node_tree
    diffuse = tree.nodes.new("ShaderNodeBsdfDiffuse")
    diffuse.inputs["Color"].default_value = (0, 1, 0, 1)
    tree.links.new(diffuse.outputs[0], tree.nodes["Material Output"].inputs["Surface"])
    lamp("lid", (0, 0, 0, 1), -2).visible_camera = False
    data = bpy.data.lights.new("sun", "SUN")
    data.energy = 20
    sun = bpy.data.objects.new("sun", data)
    sun.rotation_euler = (math.pi, 0, 0)
    scene.collection.objects.link(sun)
    scene.world.node_tree.nodes["Background"].inputs["Color"].default_value = (0, 0, 0, 1)


def steps() -> Iterator[int]:
    """Yields the channel that must then be the only bright one."""
    bpy.ops.wm.read_homefile(use_empty=False, use_factory_startup=True)
    addon_utils.enable("pivot")
    for made in list(bpy.data.objects):
        bpy.data.objects.remove(made)
    yield -1  # the window is drawn anew first
    window, area = view()
    window.scene.render.engine = "PIVOT"
    window.scene.view_settings.view_transform = "Standard"
    window.scene.pivot.samples = 4
    background = window.scene.world.node_tree.nodes["Background"]
    background.inputs["Color"].default_value = (0, 0, 1, 1)
    red = lamp("red", (1, 0, 0, 1), 1)
    lamp("green", (0, 1, 0, 1), 0)
    space = area.spaces.active
    space.overlay.show_overlays = False
    space.region_3d.view_rotation = (1, 0, 0, 0)  # from above
    space.shading.type = "RENDERED"
    yield 0
    red.location.x = 100
    yield 1
    space.region_3d.view_rotation = (0, 1, 0, 0)  # from below, where the lamps are as bright
    bpy.data.objects["green"].location.x = 100
    yield 2
    space.region_3d.view_perspective = "ORTHO"
    red.location.x = 0
    yield 0
    window.scene.pivot.integrator = "ANALYTIC"
    yield 0
    hide_the_sun(window.scene)
    yield from [-1] * 4  # until it rests: what a script sets then is to be seen as well
    window.scene.pivot.occlusion = "NONE"
    yield 1
    # Every panel is drawn once; one that fails prints a traceback.
    data = bpy.data.lights.new("light", "POINT")
    light = bpy.data.objects.new("light", data)
    window.scene.collection.objects.link(light)
    window.view_layer.objects.active = light
    properties = next(area for area in window.screen.areas if area.type == "PROPERTIES").spaces.active
    for context in ("RENDER", "OUTPUT", "VIEW_LAYER", "WORLD", "OBJECT"):
        properties.context = context
        yield -1
    for kind in ("POINT", "SPOT", "SUN", "AREA"):
        data.type = kind
        properties.context = "DATA"
        yield -1


def run() -> Callable[[], float | None]:
    """A timer that takes the next step when the last has come true, and writes what it saw."""
    started_s = time.monotonic()
    todo = steps()
    waiting_for = next(todo)
    seen: list[list[float]] = []

    def tick() -> float | None:
        nonlocal waiting_for
        late = time.monotonic() - started_s > DEADLINE_S
        pixel = middle() if waiting_for >= 0 else [0.0, 0.0, 0.0]
        if waiting_for < 0 or late or all((value > 0.9) == (i == waiting_for) for i, value in enumerate(pixel)):
            if waiting_for >= 0:
                seen.append(pixel)
            waiting_for = next(todo, None)
            if late or waiting_for is None:
                (FOLDER / "result.json").write_text(json.dumps(seen))
                bpy.ops.wm.quit_blender()
                return None
        return POLL_S

    return tick


bpy.context.preferences.view.show_splash = False
bpy.app.timers.register(run(), first_interval=POLL_S, persistent=True)
