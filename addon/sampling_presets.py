"""Presets of the Sampling panel, in its header: those that come with Pivot, and an artist's own among Blender's."""

from __future__ import annotations

from pathlib import Path

import bpy
from bl_operators.presets import AddPresetBase
from bl_ui.utils import PresetPanel

from . import denoise
from .engine import PivotRenderEngine

SHIPPED = Path(__file__).parent / "presets"


class PIVOT_PT_sampling_presets(PresetPanel, bpy.types.Panel):
    bl_label = "Sampling Presets"
    preset_subdir = "pivot/sampling"
    preset_operator = "script.execute_preset"
    preset_add_operator = "render.pivot_sampling_preset_add"
    COMPAT_ENGINES = frozenset({PivotRenderEngine.bl_idname})

    def draw(self, context: bpy.types.Context) -> None:
        """As Blender's own, which before 4.2 looks for none in the folder of an addon."""
        self.layout.emboss = "PULLDOWN_MENU"
        self.layout.operator_context = "EXEC_DEFAULT"
        self.path_menu(
            [str(SHIPPED), *bpy.utils.preset_paths(self.preset_subdir)],
            self.preset_operator,
            filter_ext=lambda extension: extension == ".py",
            add_operator=self.preset_add_operator,
        )

    @staticmethod
    def post_cb(context: bpy.types.Context, filepath: str = "") -> None:
        """After a preset, which Blender 3.4 gives no path of: ask for no denoiser where there is none."""
        if not denoise.is_there():
            context.scene.pivot.denoise = context.scene.pivot.denoise_viewport = "NONE"


class PIVOT_OT_sampling_preset_add(AddPresetBase, bpy.types.Operator):
    """Keep the settings of this panel under a name, or remove what was kept"""

    bl_idname = PIVOT_PT_sampling_presets.preset_add_operator
    bl_label = "Add Sampling Preset"
    preset_menu = "PIVOT_PT_sampling_presets"
    preset_subdir = PIVOT_PT_sampling_presets.preset_subdir
    preset_defines = ("pivot = bpy.context.scene.pivot",)
    preset_values = tuple(
        f"pivot.{name}"
        for name in (
            "integrator",
            "samples",
            "preview_samples",
            "adaptive",
            "error_budget",
            "light_sampling",
            "analytic_method",
            "occlusion",
            "indirect",
            "virtual_lights",
            "max_bounces",
            "diffuse_bounces",
            "glossy_bounces",
            "transmission_bounces",
            "volume_bounces",
            "clamp_indirect",
            "filter_glossy",
            "animate_seed",
            "denoise",
            "denoise_viewport",
            "time_limit",
        )
    )


_CLASSES = (PIVOT_PT_sampling_presets, PIVOT_OT_sampling_preset_add)


def register() -> None:
    for entry in _CLASSES:
        bpy.utils.register_class(entry)


def unregister() -> None:
    for entry in reversed(_CLASSES):
        bpy.utils.unregister_class(entry)
