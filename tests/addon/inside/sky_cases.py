"""Skies above a ball on the ground, or painted on a wall, all around the camera, rendered by Cycles and by Pivot."""

from __future__ import annotations

import math
import sys
from pathlib import Path
from typing import Any

import bpy
import parts
from cycles_cases import _ball, _cycles, _pivot

SINGLE = "NISHITA" if bpy.app.version < (5, 0) else "SINGLE_SCATTERING"
NOON: dict[str, Any] = {"sky_type": SINGLE, "sun_elevation": 0.9, "sun_rotation": 0.6, "sun_size": 0.1}
CASES: dict[str, dict[str, Any]] = {
    "noon": NOON | {"sun_intensity": 0.1},
    "dusk": NOON | {"sun_elevation": -0.02, "sun_disc": False, "altitude": 3000, "ozone_density": 3},
    "haze": NOON | {"sun_elevation": 2.6, "sun_disc": False, "air_density": 2, "altitude": 0},
    "unseen": NOON | {"sun_disc": False},
    "painted": NOON | {"sun_disc": False},
    "daylight": {"sky_type": "PREETHAM", "sun_direction": (0.5, 0.3, 0.81), "turbidity": 4},
}


def main(folder: Path) -> Any:
    for name, settings in CASES.items():
        parts.clear()
        parts.size(64, 32)
        data = parts.camera((0, 0, 1.5), (math.pi / 2, 0, 0)).data
        data.type = "PANO"
        sys.modules["pivot.export.optics"].panorama_settings(data).panorama_type = "EQUIRECTANGULAR"
        clay, _ = parts.shaded("clay", "ShaderNodeBsdfDiffuse", Color=(0.6, 0.6, 0.6, 1))
        parts.quad("ground", material=clay).scale = (3, 3, 1)
        metal, node = parts.shaded("metal", "ShaderNodeBsdfGlossy", Color=(0.9, 0.7, 0.4, 1), Roughness=0.4)
        node.distribution = "GGX"
        _ball("ball", (0.5, 2, 1), metal)
        shines = parts.world((0, 0, 0)).node_tree.nodes["Background"]
        if name == "painted":
            shines.inputs["Color"].default_value = (0.5, 0.5, 0.5, 1)
            paint, shines = parts.shaded("paint", "ShaderNodeEmission")
            parts.quad("wall", (0, 4, 1), paint).rotation_euler = (1.2, 0, 0.3)
        tree = shines.id_data
        sky = tree.nodes.new("ShaderNodeTexSky")
        for key, value in settings.items():
            setattr(sky, key, value)
        tree.links.new(sky.outputs[0], shines.inputs["Color"])
        shines.inputs["Strength"].default_value = 0.1 if settings["sky_type"] == SINGLE else 0.5
        bpy.context.scene.world.cycles_visibility.camera = name != "unseen"
        _cycles(folder / f"{name}_CYCLES.exr", 0, 256)
        _pivot(folder / f"{name}_PIVOT.exr", 0, "JOINT", 128)
    return list(CASES)
