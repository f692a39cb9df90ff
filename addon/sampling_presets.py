"""Presets of the Sampling panel, in its header: those that come with Pivot, and an artist's own among Blender's."""

from __future__ import annotations

import ast
from pathlib import Path

import bpy
from bl_operators.presets import AddPresetBase
from bl_ui.utils import PresetPanel
from bpy.props import EnumProperty

from . import denoise
from .engine import PivotRenderEngine

SHIPPED = {name: Path(__file__).parent / "presets" / f"{name}.py" for name in ("preview", "still", "animation")}
_TOOLTIPS = {name: (ast.get_docstring(ast.parse(file.read_text())) or "").rstrip(".") for name, file in SHIPPED.items()}


class PIVOT_PT_sampling_presets(PresetPanel, bpy.types.Panel):
    bl_label = "Sampling Presets"
    preset_subdir = "pivot/sampling"
    preset_operator = "script.execute_preset"
    preset_add_operator = "render.pivot_sampling_preset_add"
    COMPAT_ENGINES = frozenset({PivotRenderEngine.bl_idname})

    def draw(self, _: bpy.types.Context) -> None:
        layout = self.layout
        layout.emboss = "PULLDOWN_MENU"
        layout.operator_context = "EXEC_DEFAULT"
        column = layout.column(align=True)
        for name in SHIPPED:
            column.operator(PIVOT_OT_sampling_preset.bl_idname, text=name.title(), translate=False).preset = name
        own = bpy.utils.preset_paths(self.preset_subdir)
        self.path_menu(
            own or [str(folder) for folder in {file.parent for file in SHIPPED.values()}],  # it wants one that is there
            self.preset_operator,
            filter_ext=lambda extension: bool(own) and extension == ".py",
            add_operator=self.preset_add_operator,
        )

    @staticmethod
    def post_cb(context: bpy.types.Context, filepath: str = "") -> None:
        """After a preset, which Blender 3.4 gives no path of: ask for no denoiser where there is none."""
        if not denoise.is_there():
            context.scene.pivot.denoise = context.scene.pivot.denoise_viewport = "NONE"


class PIVOT_OT_sampling_preset(bpy.types.Operator):
    """One that comes with Pivot, whose tooltip says what it is for"""

    bl_idname = "render.pivot_sampling_preset"
    bl_label = "Use Sampling Preset"
    bl_options = frozenset({"INTERNAL"})

    preset: EnumProperty(items=[(name, name.title(), "") for name in SHIPPED])

    @classmethod
    def description(cls, _: bpy.types.Context, properties: PIVOT_OT_sampling_preset) -> str:
        return _TOOLTIPS[properties.preset]

    def execute(self, _: bpy.types.Context) -> set[str]:
        menu = PIVOT_PT_sampling_presets.__name__
        result: set[str] = bpy.ops.script.execute_preset(filepath=str(SHIPPED[self.preset]), menu_idname=menu)
        return result


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


_CLASSES = (PIVOT_PT_sampling_presets, PIVOT_OT_sampling_preset, PIVOT_OT_sampling_preset_add)


def register() -> None:
    for entry in _CLASSES:
        bpy.utils.register_class(entry)


def unregister() -> None:
    for entry in reversed(_CLASSES):
        bpy.utils.unregister_class(entry)
