"""A shadow catcher under balls, a lamp and a world, shown each way that Cycles has, by Cycles and by Pivot."""

from __future__ import annotations

import math
import sys
from pathlib import Path
from typing import Any

import bpy
import parts
from cycles_cases import SPHERE, _ball, _cycles, _pivot, on_clay
from visibility_cases import _glossy

# Whether the film is transparent, whether there is a pass of the catcher, and the density of the world's fog; the last
# by a lens that sees a circle.
CASES = {
    "over_world": (False, False, 0.0),
    "over_nothing": (True, False, 0.0),
    "beside": (True, True, 0.0),
    "foggy_world": (False, False, 0.04),
    "foggy": (True, False, 0.04),
    "fisheye": (False, False, 0.0),
}


def main(folder: Path) -> Any:
    _, ground = on_clay()
    ground.is_shadow_catcher = True
    red, _ = parts.shaded("red", "ShaderNodeBsdfDiffuse", Color=(0.8, 0.1, 0.1, 1))
    _ball("red", (-1.2, 0, 1), red)
    _ball("shiny", (1.2, 0, 1), _glossy("shiny", 0.3))
    glow, _ = parts.shaded("glow", "ShaderNodeEmission", Color=(0.2, 0.4, 1, 1), Strength=4)
    panel = parts.quad("panel", (3, -1, 0.6), glow)
    panel.rotation_euler = (0, math.radians(-90), 0)
    panel.scale = (0.5, 0.5, 1)
    parts.light("key", "POINT", (-3, -2, 3), energy=200, **SPHERE)
    tree = parts.world((0.2, 0.25, 0.3)).node_tree
    scatter = tree.nodes.new("ShaderNodeVolumeScatter")
    for name, (is_transparent, has_pass, density) in CASES.items():
        scatter.inputs["Density"].default_value = density
        surround = tree.nodes["World Output"].inputs["Volume"]
        for link in surround.links:
            tree.links.remove(link)
        if density:
            tree.links.new(scatter.outputs[0], surround)
        if name == "fisheye":
            _see_a_circle(bpy.context.scene.camera.data)
        bpy.context.scene.render.film_transparent = is_transparent
        bpy.context.view_layer.cycles.use_pass_shadow_catcher = has_pass
        bounces = 0 if density else 1  # fog that scatters twice is noisy
        _cycles(folder / f"{name}_CYCLES.exr", bounces, file_format="OPEN_EXR_MULTILAYER")
        _pivot(folder / f"{name}_MONTE_CARLO.exr", bounces, "JOINT", file_format="OPEN_EXR_MULTILAYER")
        if name == "beside":
            pivot = bpy.context.scene.pivot
            pivot.integrator, pivot.indirect = "ANALYTIC", "VSGL"
            _pivot(folder / f"{name}_ANALYTIC.exr", 1, "JOINT", 8, file_format="OPEN_EXR_MULTILAYER")
            pivot.integrator = "MONTE_CARLO"
    return list(CASES)


def _see_a_circle(camera: bpy.types.Camera) -> None:
    camera.type = "PANO"
    settings = sys.modules["pivot.export.optics"].panorama_settings(camera)
    settings.panorama_type, settings.fisheye_fov = "FISHEYE_EQUISOLID", 1.6
    settings.fisheye_lens = 20
