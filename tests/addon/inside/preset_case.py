"""Presets of the Sampling panel: what each sets, that all set the same, and one of the artist's own."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import bpy
import parts
from pivot import denoise, sampling_presets

MENU = "PIVOT_PT_sampling_presets"


def main(_: Path) -> dict[str, Any]:
    parts.clear()
    pivot = bpy.context.scene.pivot
    defaults = _settings(pivot)
    shipped, assigned = {}, {}
    for file in sorted(sampling_presets.SHIPPED.glob("*.py")):
        assigned[file.stem] = re.findall(r"^pivot\.(\w+) =", file.read_text(), re.MULTILINE)
        assert bpy.ops.script.execute_preset(filepath=str(file), menu_idname=MENU) == {"FINISHED"}
        shipped[file.stem] = _settings(pivot)
    found, denoise._library = denoise._library, lambda: None
    bpy.ops.script.execute_preset(filepath=str(sampling_presets.SHIPPED / "still.py"), menu_idname=MENU)
    without_denoiser = _settings(pivot)
    denoise._library = found
    pivot.integrator, pivot.samples, pivot.denoise = "ANALYTIC", 7, "ALL" if denoise.is_there() else "NONE"
    mine = _settings(pivot)
    bpy.ops.render.pivot_sampling_preset_add(name="Mine")
    file = bpy.utils.preset_find("Mine", sampling_presets.PIVOT_PT_sampling_presets.preset_subdir)
    pivot.integrator, pivot.samples, pivot.max_bounces, pivot.denoise = "MONTE_CARLO", 9, 1, "NONE"
    bpy.ops.script.execute_preset(filepath=file, menu_idname=MENU)
    again = _settings(pivot)
    bpy.ops.render.pivot_sampling_preset_add(name="Mine", remove_name=True)
    return {
        "defaults": defaults,
        "shipped": shipped,
        "assigned": assigned,
        "has denoiser": denoise.is_there(),
        "without denoiser": without_denoiser,
        "mine": [mine, again],
        "is gone": not Path(file).exists(),
    }


def _settings(pivot: Any) -> dict[str, Any]:
    values = sampling_presets.PIVOT_OT_sampling_preset_add.preset_values
    return {name: getattr(pivot, name) for name in (value.removeprefix("pivot.") for value in values)}
