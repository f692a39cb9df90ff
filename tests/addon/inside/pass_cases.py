"""Balls, a lamp and a panel that shines, with all passes and an exposed film, by Cycles and by Pivot."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import bpy
import parts
from cycles_cases import SPHERE, _ball, _cycles, _pivot, on_clay
from visibility_cases import _glossy

LIGHT = tuple(
    f"{kind}_{part}" for kind in ("diffuse", "glossy", "transmission") for part in ("direct", "indirect", "color")
)
MATTES = ("cryptomatte_object", "cryptomatte_material", "cryptomatte_asset")
PASSES = (*LIGHT, *MATTES, "emit", "environment", "uv", "mist", "object_index", "material_index", "ambient_occlusion")


def main(folder: Path) -> Any:
    clay, ground = on_clay((4, 6))
    clay.pass_index, ground.pass_index = 7, 3
    uv = ground.data.uv_layers.new(name="UVMap")
    uv.data.foreach_set("uv", [0.0, 0.0, 1.0, 0.0, 1.0, 1.0, 0.0, 1.0])
    _ball("shiny", (-1.3, 0, 1), _glossy("shiny", 0.4)).pass_index = 5
    glass, node = parts.shaded("glass", "ShaderNodeBsdfGlass", Roughness=0.3, Color=(0.9, 0.95, 1, 1))
    node.distribution = "GGX"
    glass.pass_index = 2
    _ball("glass", (1.3, 0, 1), glass).parent = bpy.data.objects["shiny"]
    bpy.data.objects["glass"].matrix_parent_inverse = bpy.data.objects["shiny"].matrix_world.inverted()
    glow, _ = parts.shaded("glow", "ShaderNodeEmission", Color=(1, 0.4, 0.2, 1), Strength=2)
    parts.quad("panel", (0, 2.5, 1), glow).rotation_euler = (math.radians(90), 0, 0)
    parts.light("lamp", "POINT", (0, -2, 3.5), energy=150, **SPHERE)
    parts.world((0.2, 0.25, 0.3)).mist_settings.start = 4
    mist = bpy.context.scene.world.mist_settings
    mist.depth, mist.falloff = 6, "QUADRATIC"
    bpy.context.scene.world.light_settings.distance = 1.5
    bpy.context.scene.cycles.film_exposure = 1.5
    layer = bpy.context.view_layer
    for name in PASSES:
        setattr(layer, f"use_pass_{name}", True)
    _cycles(folder / "CYCLES.exr", 2, file_format="OPEN_EXR_MULTILAYER")
    _pivot(folder / "MONTE_CARLO.exr", 2, "JOINT", 256, file_format="OPEN_EXR_MULTILAYER")
    bpy.context.scene.pivot.integrator = "ANALYTIC"
    _pivot(folder / "ANALYTIC.exr", 0, "JOINT", file_format="OPEN_EXR_MULTILAYER")
    return None
