"""The Rendered viewport of a Blender with a window: viewport_case.py -- FOLDER writes FOLDER/result.json and quits.

Each step waits until the middle of the 3D view has the colour it is to have: first a red lamp's, then, moved, a green
one's behind it, then, the view turned about, the world's blue.
"""

from __future__ import annotations

import math
import sys
from collections.abc import Callable, Iterator
from functools import partial
from pathlib import Path
from typing import Any

import bpy

# isort: split
import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent))
import parts
import window

DRAWN_S = 0.15  # a panel is by then
seen: list[list[float]] = []


def middle() -> list[float]:
    """RGB of the middle of the 3D view, as the screen shows it."""
    own = window.region()
    return window.pixels([(own.width // 2, own.height // 2)])[0]


def shows(channel: int) -> Callable[[], bool]:
    """Whether it is the only bright one."""

    def done() -> bool:
        pixel = middle()
        is_so = all((value > 0.9) == (i == channel) for i, value in enumerate(pixel))
        if is_so:
            seen.append(pixel)
        return is_so

    return done


def lamp(name: str, colour: tuple[float, float, float, float], z: float) -> Any:
    made = parts.quad(name, (0, 0, z), parts.shaded(name, "ShaderNodeEmission", Color=colour)[0])
    made.scale = (9, 9, 1)
    return made


def hide_the_sun(scene: Any) -> None:
    """A green ground before all, under a sun that is behind a lid, which rays to lights meet and the view does not."""
    green = parts.shaded("ground", "ShaderNodeBsdfDiffuse", Color=(0, 1, 0, 1))[0]
    parts.quad("ground", (0, 0, -1), green).scale = (9, 9, 1)
    lamp("lid", (0, 0, 0, 1), -2).visible_camera = False
    parts.light("sun", "SUN", energy=20).rotation_euler = (math.pi, 0, 0)
    scene.world.node_tree.nodes["Background"].inputs["Color"].default_value = (0, 0, 0, 1)


def preview_of(owner: Any) -> Any:
    """(height, width, 4), or nothing yet."""
    width, height = owner.preview.image_size if owner.preview else (0, 0)
    return np.array(owner.preview.image_pixels_float[:] if width else (), np.float32).reshape(height, width, 4)


def is_previewed(owner: Any) -> bool:
    preview = preview_of(owner)
    return bool(preview.size and preview[..., 3].max() > 0)


def steps() -> Iterator[Callable[[], bool]]:
    window.clear()
    yield window.now  # the window is drawn anew first
    viewports = window.Viewports()
    main, area = window.view()
    scene = main.scene
    scene.render.engine, scene.view_settings.view_transform, scene.pivot.samples = "PIVOT", "Standard", 4
    background = scene.world.node_tree.nodes["Background"]
    background.inputs["Color"].default_value = (0, 0, 1, 1)
    red = lamp("red", (1, 0, 0, 1), 1)
    lamp("green", (0, 1, 0, 1), 0)
    space = area.spaces.active
    space.overlay.show_overlays = False
    space.region_3d.view_rotation = (1, 0, 0, 0)  # from above
    space.shading.type = "RENDERED"
    yield shows(0)
    red.location.x = 100
    yield shows(1)
    space.region_3d.view_rotation = (0, 1, 0, 0)  # from below, where the lamps are as bright
    bpy.data.objects["green"].location.x = 100
    yield shows(2)
    space.region_3d.view_perspective = "ORTHO"
    red.location.x = 0
    yield shows(0)
    scene.pivot.integrator = "ANALYTIC"
    yield shows(0)
    hide_the_sun(scene)
    yield window.after(DRAWN_S, viewports.rest)  # what a script sets then is to be seen as well
    scene.pivot.occlusion = "NONE"
    yield shows(1)
    # Every panel is drawn once; one that fails prints a traceback.
    light = parts.light("light", "POINT")
    main.view_layer.objects.active = light
    properties = next(area for area in main.screen.areas if area.type == "PROPERTIES").spaces.active
    for properties.context in ("RENDER", "OUTPUT", "VIEW_LAYER", "WORLD", "OBJECT"):
        yield window.after(DRAWN_S)
    for light.data.type in ("POINT", "SPOT", "SUN", "AREA"):
        properties.context = "DATA"
        yield window.after(DRAWN_S)
    background.inputs["Color"].default_value = (0, 0, 1, 1)
    previewed = {"red": bpy.data.materials["red"], "world": scene.world}
    for owner in previewed.values():  # one after the other: a job that waits for another would hold Python meanwhile
        owner.asset_generate_preview()
        yield partial(is_previewed, owner)
    previews = {name: preview_of(owner)[..., :3].mean((0, 1)).tolist() for name, owner in previewed.items()}
    said = sorted(sys.modules["pivot.engine"].PivotRenderEngine.said_in_job)
    window.write({"seen": seen, "previews": previews, "said": said})


window.follow(steps(), deadline_s=60.0)
