"""A ring of balls around cameras of every kind, rendered by Cycles and by Pivot."""

from __future__ import annotations

import math
import sys
from pathlib import Path
from typing import Any

import bpy
import parts
from cycles_cases import _ball, _cycles, _pivot

SAMPLES = 64
BLUR: dict[str, Any] = {"aperture_fstop": 0.1, "focus_distance": 2.5}
ANAMORPHIC: dict[str, Any] = BLUR | {"aperture_blades": 5, "aperture_rotation": 0.3, "aperture_ratio": 2}
# Of each: the camera's settings, its panorama's, and its depth of field's.
CASES: dict[str, tuple[dict[str, Any], dict[str, Any], dict[str, Any]]] = {
    "blurred": ({"lens": 20}, {}, BLUR),
    "anamorphic": ({"lens": 20}, {}, ANAMORPHIC),
    "orthographic": ({"type": "ORTHO", "ortho_scale": 7, "shift_x": 0.1, "clip_start": 1}, {}, {}),
    "orthographic_blurred": ({"type": "ORTHO", "ortho_scale": 7}, {}, ANAMORPHIC | {"aperture_fstop": 1.5}),
    "equirectangular": ({"shift_x": 0.1}, {"panorama_type": "EQUIRECTANGULAR", "latitude_min": -1.2}, ANAMORPHIC),
    "fisheye": ({}, {"panorama_type": "FISHEYE_EQUIDISTANT", "fisheye_fov": 2.8}, {}),
    "equisolid": ({}, {"panorama_type": "FISHEYE_EQUISOLID", "fisheye_fov": 2.8}, BLUR),
    "mirror_ball": ({}, {"panorama_type": "MIRRORBALL"}, ANAMORPHIC),
}


def main(folder: Path) -> Any:
    for name, (settings, panorama, dof) in CASES.items():
        _scene()
        data = bpy.context.scene.camera.data
        if panorama:
            data.type = "PANO"
        data.dof.use_dof = bool(dof)
        panorama_of = sys.modules["pivot.export.optics"].panorama_settings
        for owner, values in ((data, settings), (panorama_of(data) if panorama else data, panorama), (data.dof, dof)):
            for key, value in values.items():
                setattr(owner, key, value)
        _cycles(folder / f"{name}_CYCLES.exr", 0, 2 * SAMPLES)
        for bpy.context.scene.pivot.integrator in ("MONTE_CARLO", "ANALYTIC"):
            _pivot(folder / f"{name}_{bpy.context.scene.pivot.integrator}.exr", 0, "JOINT", SAMPLES)
    return list(CASES)


def _scene() -> None:
    parts.clear()
    parts.size(48, 32)
    parts.camera((0, 0, 0.3), (math.pi / 2, 0, 0))
    ground, _ = parts.shaded("ground", "ShaderNodeBsdfDiffuse", Color=(0.6, 0.6, 0.6, 1))
    parts.quad("ground", (0, 0, -1), ground).scale = (8, 8, 1)
    for i in range(10):
        turn = 2 * math.pi * i / 10
        color = [0.2 + 0.6 * ((i + shift) % 3 == 0) for shift in range(3)]
        clay, _ = parts.shaded(f"clay {i}", "ShaderNodeBsdfDiffuse", Color=(*color, 1))
        _ball(f"ball {i}", (3 * math.sin(turn), 3 * math.cos(turn), 0.25 * (i % 3)), clay)
        bpy.context.object.scale = (0.5, 0.5, 0.5)
    lamp, _ = parts.shaded("lamp", "ShaderNodeEmission", Strength=3)
    for i in range(4):
        parts.quad(f"lamp {i}", (i - 1.5, 5 - 0.5 * i, 1.5 - 0.3 * i), lamp).scale = (0.1, 0.1, 0.1)
        bpy.context.scene.collection.objects[f"lamp {i}"].rotation_euler = (math.pi / 2, 0, 0)
    parts.world((0.4, 0.5, 0.6))
    parts.light("sun", "SUN", energy=2, angle=0.1).rotation_euler = (0.6, 0.3, 0)
