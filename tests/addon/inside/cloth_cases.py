"""Balls and a floor seen along it, of each kind of rough, fibrous or drawn surface, rendered by Cycles and by Pivot."""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import bpy
import parts
from cycles_cases import OLD, SPHERE, _ball, by_both, directly_by_both

ANALYTIC_SAMPLES = 8
RED = (0.7, 0.3, 0.15, 1)
CASES: dict[str, tuple[str, dict[str, Any]]] = {
    "clay": ("ShaderNodeBsdfDiffuse", {"Color": RED, "Roughness": 0.4}),
    "chalk": ("ShaderNodeBsdfDiffuse", {"Color": RED, "Roughness": 1.0}),
    "default": ("ShaderNodeBsdfPrincipled", {}),
}
if OLD:
    CASES |= {
        "velvet": ("ShaderNodeBsdfVelvet", {"Color": RED, "Sigma": 0.6}),
        "plush": ("ShaderNodeBsdfVelvet", {"Color": RED, "Sigma": 0.25}),
        "smooth": ("ShaderNodeBsdfPrincipled", {"Base_Color": RED, "Roughness": 0.2}),
        "rough": ("ShaderNodeBsdfPrincipled", {"Base_Color": RED, "Roughness": 0.9, "Specular": 0.0}),
        "sheen": ("ShaderNodeBsdfPrincipled", {"Base_Color": RED, "Sheen": 1.0, "Sheen_Tint": 0.5}),
    }
else:
    fibre, tinted = "ShaderNodeBsdfSheen", {"Sheen_Tint": (0.6, 0.7, 1.0, 1)}
    CASES |= {
        "velvet": (fibre, {"Color": RED, "Roughness": 0.6, "distribution": "ASHIKHMIN"}),
        "plush": (fibre, {"Color": RED, "Roughness": 0.25, "distribution": "ASHIKHMIN"}),
        "fibre": (fibre, {"Color": RED, "Roughness": 0.5}),
        "fine_fibre": (fibre, {"Color": RED, "Roughness": 0.2}),
        # Samples of 3.4's Toon fade less towards its rim than the BSDF that they are of.
        "toon": ("ShaderNodeBsdfToon", {"Color": RED, "Size": 0.6, "Smooth": 0.3}),
        "toon_shine": ("ShaderNodeBsdfToon", {"Color": RED, "Size": 0.3, "Smooth": 0.1, "component": "GLOSSY"}),
        "dust": (fibre, {"Color": RED, "Roughness": 1.0}),
        "sheen": (
            "ShaderNodeBsdfPrincipled",
            {"Base_Color": RED, "Sheen_Weight": 1.0, "Sheen_Roughness": 0.4} | tinted,
        ),
    }
if bpy.app.version >= (4, 3):
    CASES["rough"] = ("ShaderNodeBsdfPrincipled", {"Base_Color": RED, "Diffuse_Roughness": 1.0, "Roughness": 0.4})


def main(folder: Path) -> Any:
    for name, (kind, inputs) in CASES.items():
        _scene(name, kind, dict(inputs))
        by_both(folder, name, 1)
        directly_by_both(folder, name, ANALYTIC_SAMPLES)
    return list(CASES)


def _scene(name: str, kind: str, inputs: dict[str, Any]) -> None:
    settings = {key: inputs.pop(key) for key in ("distribution", "component") if key in inputs}
    if kind.endswith("Principled"):
        settings["distribution"] = "GGX"

    def make() -> Any:
        material, node = parts.shaded(name, kind, **inputs)
        for key, value in settings.items():
            setattr(node, key, value)
        return material

    dress(make)


def dress(make: Callable[[], Any]) -> None:
    """Two balls and a floor of the material that is made once the scene is empty, and lights."""
    parts.clear()
    parts.size(48, 32)
    parts.camera((0, -7, 0.9), (math.radians(90), 0, 0)).data.lens = 45
    material = make()
    parts.quad("floor", material=material).scale = (8, 8, 1)
    _ball("left", (-1.2, 0, 1), material)
    _ball("right", (1.2, 1, 1), material)
    parts.world((0.2, 0.25, 0.3))
    parts.light("behind", "POINT", (0.5, 4, 3), energy=300, **SPHERE)
    lamp = parts.light("key", "AREA", (-3, -5, 4), energy=300, shape="SQUARE", size=1.5)
    lamp.rotation_euler = (math.radians(55), 0, math.radians(-30))
