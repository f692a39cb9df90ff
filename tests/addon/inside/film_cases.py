"""Balls with thin films on plastic, on glass and beneath a coat, rendered by Cycles and by Pivot."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import bpy
import parts
from cycles_cases import SPHERE, _ball, _cycles, _pivot, _save

DARK, LIGHT = (0.05, 0.05, 0.06, 1), (0.7, 0.4, 0.3, 1)
CASES: dict[str, dict[str, Any]] = {
    "soap": {"Base_Color": DARK, "Roughness": 0.25, "Thin_Film_Thickness": 400.0},
    "oil": {"Base_Color": LIGHT, "Roughness": 0.5, "Thin_Film_Thickness": 600.0, "Thin_Film_IOR": 1.8},
    "tinted": {
        "Base_Color": LIGHT,
        "Roughness": 0.3,
        "Thin_Film_Thickness": 300.0,
        "Specular_Tint": (0.3, 1.0, 0.5, 1),
        "Anisotropic": 0.6,
    },
    "coated": {"Base_Color": DARK, "Roughness": 0.4, "Thin_Film_Thickness": 500.0, "Coat_Weight": 1.0},
    "glass": {
        "Base_Color": (1, 1, 1, 1),
        "Roughness": 0.3,
        "Thin_Film_Thickness": 450.0,
        "Thin_Film_IOR": 1.7,
        "Transmission_Weight": 1.0,
    },
}


def main(folder: Path) -> Any:
    if bpy.app.version < (4, 2):
        return []
    for name, inputs in CASES.items():
        _scene(name, inputs)
        bounces = 4 if name == "glass" else 1
        _cycles(folder / f"{name}_CYCLES.exr", bounces)
        _pivot(folder / f"{name}_MONTE_CARLO.exr", bounces, "JOINT")
        if name == "glass":
            continue
        _cycles(folder / f"{name}_direct_CYCLES.exr", 0)
        scene = bpy.context.scene
        scene.render.engine, scene.pivot.integrator = "PIVOT", "ANALYTIC"
        scene.pivot.samples, scene.pivot.max_bounces = 8, 0
        _save(folder / f"{name}_direct_ANALYTIC.exr")
    return list(CASES)


def _scene(name: str, inputs: dict[str, Any]) -> None:
    parts.clear()
    parts.size(48, 32)
    parts.camera((0, -7, 0.9), (1.5708, 0, 0)).data.lens = 45
    material, node = parts.shaded(name, "ShaderNodeBsdfPrincipled", **inputs)
    node.distribution = "MULTI_GGX" if name == "oil" else "GGX"
    parts.quad("floor", material=parts.shaded("ground", "ShaderNodeBsdfDiffuse", Color=LIGHT)[0]).scale = (8, 8, 1)
    _ball("left", (-1.2, 0, 1), material)
    _ball("right", (1.2, 1, 1), material)
    parts.world((0.3, 0.35, 0.4))
    parts.light("behind", "POINT", (0.5, 4, 3), energy=300, **SPHERE)
    parts.light("key", "AREA", (-2, -4, 5), energy=400, shape="SQUARE", size=3.0).rotation_euler = (0.7, 0, -0.4)
