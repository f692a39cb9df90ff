"""A ball, and a slab lit from behind, of what light goes beneath by each of Cycles' methods; by Cycles and by Pivot."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import parts
from cycles_cases import OLD, SPHERE, _ball, _cycles, _pivot

SKIN = (0.8, 0.5, 0.35, 1)
RADIUS = {"Radius": (1.0, 0.4, 0.2)}
NODE, PRINCIPLED = "ShaderNodeSubsurfaceScattering", "ShaderNodeBsdfPrincipled"
if OLD:
    FIXED, ADAPTED = "RANDOM_WALK_FIXED_RADIUS", "RANDOM_WALK"
    whole = {"Subsurface": 1.0, "Subsurface_Color": SKIN, "Subsurface_Radius": (1.0, 0.4, 0.2)}
    part = whole | {"Subsurface": 0.4, "Base_Color": (0.2, 0.3, 0.6, 1), "Roughness": 0.7}
else:
    FIXED, ADAPTED = "RANDOM_WALK", "RANDOM_WALK_SKIN"
    whole = {"Subsurface_Weight": 1.0, "Base_Color": SKIN, "Subsurface_Scale": 0.7}
    part = whole | {"Subsurface_Weight": 0.5, "Roughness": 0.3}
CASES: dict[str, tuple[str, dict[str, Any]]] = {
    "wax": (NODE, {"Color": SKIN, "Scale": 1.0, "method": FIXED} | RADIUS),
    "skin": (NODE, {"Color": SKIN, "Scale": 0.3, "method": ADAPTED} | RADIUS),
    "forward": (NODE, {"Color": SKIN, "Scale": 1.0, "Anisotropy": 0.7, "method": FIXED} | RADIUS),
    "burley": (NODE, {"Color": SKIN, "Scale": 1.0, "method": "BURLEY"} | RADIUS),
    "principled": (PRINCIPLED, whole | {"method": FIXED}),
    "half": (PRINCIPLED, part | {"method": ADAPTED}),
}


def main(folder: Path) -> Any:
    for name, (kind, inputs) in CASES.items():
        _scene(name, kind, dict(inputs))
        _cycles(folder / f"{name}_CYCLES.exr", 1)
        _pivot(folder / f"{name}_MONTE_CARLO.exr", 1, "JOINT")
    return list(CASES)


def _scene(name: str, kind: str, inputs: dict[str, Any]) -> None:
    parts.clear()
    parts.size(48, 32)
    parts.camera((0, -7, 0.9), (math.radians(90), 0, 0)).data.lens = 45
    method = inputs.pop("method")
    material, node = parts.shaded(name, kind, **inputs)
    setattr(node, "falloff" if kind == NODE else "subsurface_method", method)
    if kind == PRINCIPLED:
        node.distribution = "GGX"
    ground = parts.quad("floor", material=parts.shaded("ground", "ShaderNodeBsdfDiffuse", Color=(0.5, 0.5, 0.5, 1))[0])
    ground.scale = (8, 8, 1)
    _ball("left", (-1.2, 0, 1), material)
    slab = _ball("slab", (1.2, 0.5, 1.2), material)
    slab.scale = (1.0, 0.08, 1.0)
    parts.world((0.1, 0.12, 0.15))
    parts.light("behind", "POINT", (1.2, 3.5, 2.5), energy=500, **SPHERE)
    lamp = parts.light("key", "AREA", (-3, -3, 4), energy=200, shape="SQUARE", size=1.0)
    lamp.rotation_euler = (math.radians(50), 0, math.radians(-45))
