"""Panels of what lights are told apart by: light groups, AOVs beside them, and what the world lights."""

from __future__ import annotations

from typing import Any

import bpy

from .panels import PivotPanel, columns


class PIVOT_VIEWLAYER_PT_aovs(PivotPanel, bpy.types.Panel):
    bl_label = "Shader AOV"
    bl_context = "view_layer"
    bl_options = frozenset({"DEFAULT_CLOSED"})

    def draw(self, context: bpy.types.Context) -> None:
        layer = context.view_layer
        row = columns(self).row()
        row.column().template_list("VIEWLAYER_UL_aov", "aovs", layer, "aovs", layer, "active_aov_index", rows=3)
        _add_and_remove(row, "aov")
        if layer.active_aov and not layer.active_aov.is_valid:
            self.layout.label(text="Another pass has this name", icon="ERROR")


class PIVOT_VIEWLAYER_PT_lightgroups(PivotPanel, bpy.types.Panel):
    bl_label = "Light Groups"
    bl_context = "view_layer"
    bl_options = frozenset({"DEFAULT_CLOSED"})

    def draw(self, context: bpy.types.Context) -> None:
        layer = context.view_layer
        row = columns(self).row()
        row.column().template_list(
            "UI_UL_list", "lightgroups", layer, "lightgroups", layer, "active_lightgroup_index", rows=3
        )
        _add_and_remove(row, "lightgroup")
        row.menu("VIEWLAYER_MT_lightgroup_sync", icon="DOWNARROW_HLT", text="")


class PIVOT_OBJECT_PT_light(PivotPanel, bpy.types.Panel):
    bl_label = "Light"
    bl_context = "object"

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return bool(context.object) and super().poll(context)

    def draw(self, context: bpy.types.Context) -> None:
        _choose_group(columns(self), context.object, context.view_layer)
        if context.object.type in {"MESH", "VOLUME"}:
            self.layout.prop(context.object, "is_shadow_catcher")


class PIVOT_WORLD_PT_light(PivotPanel, bpy.types.Panel):
    bl_label = "Light"
    bl_context = "world"

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return bool(context.world) and super().poll(context)

    def draw(self, context: bpy.types.Context) -> None:
        world: Any = context.world
        layout = columns(self)
        _choose_group(layout, world, context.view_layer)
        if not hasattr(world, "cycles_visibility"):  # Cycles' addon has these
            return
        layout.prop(world.cycles, "max_bounces")
        column = layout.column(heading="Ray Visibility")
        for kind in ("camera", "diffuse", "glossy", "transmission", "scatter"):
            column.prop(world.cycles_visibility, kind)
        layout.prop(world.light_settings, "distance", text="AO Distance")


def _add_and_remove(row: Any, what: str) -> None:
    column = row.column(align=True)
    column.operator(f"scene.view_layer_add_{what}", icon="ADD", text="")
    column.operator(f"scene.view_layer_remove_{what}", icon="REMOVE", text="")


def _choose_group(layout: Any, shining: bpy.types.Object | bpy.types.World, view_layer: bpy.types.ViewLayer) -> None:
    layout.prop_search(shining, "lightgroup", view_layer, "lightgroups", text="Light Group")


_CLASSES = (
    PIVOT_VIEWLAYER_PT_aovs,
    PIVOT_VIEWLAYER_PT_lightgroups,
    PIVOT_OBJECT_PT_light,
    PIVOT_WORLD_PT_light,
)


def register() -> None:
    for panel in _CLASSES:
        bpy.utils.register_class(panel)


def unregister() -> None:
    for panel in reversed(_CLASSES):
        bpy.utils.unregister_class(panel)
