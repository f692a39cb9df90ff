"""Presets of the Sampling panel: what each sets, that all set the same, and one of the artist's own."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any
from unittest.mock import MagicMock

import bpy
import parts
from pivot import denoise, sampling_presets

MENU = "PIVOT_PT_sampling_presets"


def main(_: Path) -> dict[str, Any]:
    parts.clear()
    pivot = bpy.context.scene.pivot
    defaults = _settings(pivot)
    shipped, assigned = {}, {}
    for name, file in sampling_presets.SHIPPED.items():
        assigned[name] = re.findall(r"^pivot\.(\w+) =", file.read_text(), re.MULTILINE)
        assert bpy.ops.render.pivot_sampling_preset(preset=name) == {"FINISHED"}
        shipped[name] = _settings(pivot)
    found, denoise._library = denoise._library, lambda: None
    bpy.ops.render.pivot_sampling_preset(preset="still")
    without_denoiser = _settings(pivot)
    denoise._library = found
    pivot.integrator, pivot.samples, pivot.denoise = "ANALYTIC", 7, "ALL" if denoise.is_there() else "NONE"
    mine = _settings(pivot)
    bpy.ops.render.pivot_sampling_preset_add(name="Mine")
    file = bpy.utils.preset_find("Mine", sampling_presets.PIVOT_PT_sampling_presets.preset_subdir)
    pivot.integrator, pivot.samples, pivot.max_bounces, pivot.denoise = "MONTE_CARLO", 9, 1, "NONE"
    bpy.ops.script.execute_preset(filepath=file, menu_idname=MENU)
    again, listed = _settings(pivot), _listed()
    bpy.ops.render.pivot_sampling_preset_add(name="Mine", remove_name=True)
    return {
        "defaults": defaults,
        "shipped": shipped,
        "assigned": assigned,
        "has denoiser": denoise.is_there(),
        "without denoiser": without_denoiser,
        "mine": [mine, again],
        "is gone": not Path(file).exists(),
        "listed": [_listed(), listed],
    }


def _settings(pivot: Any) -> dict[str, Any]:
    values = sampling_presets.PIVOT_OT_sampling_preset_add.preset_values
    return {name: getattr(pivot, name) for name in (value.removeprefix("pivot.") for value in values)}


def _listed() -> list[str]:
    """What the panel's menu shows to choose from."""
    panel: Any = sampling_presets.PIVOT_PT_sampling_presets
    shown = MagicMock()
    shown.preset_subdir, shown.preset_operator, shown.bl_idname = panel.preset_subdir, panel.preset_operator, MENU
    shown.preset_add_operator = panel.preset_add_operator
    shown.path_menu = lambda *paths, **options: panel.path_menu(shown, *paths, **options)
    panel.draw(shown, bpy.context)
    return [kwargs["text"] for _, _, kwargs in shown.layout.mock_calls if kwargs.get("text")]
