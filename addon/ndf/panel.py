"""The Material properties' panel of a picture of microfacets."""

from __future__ import annotations

import bpy

from ..panels import PivotPanel

_PREVIEW_SCALE = 8.0


class PIVOT_MATERIAL_PT_ndf(PivotPanel, bpy.types.Panel):
    bl_label = "Microfacets from Image"
    bl_context = "material"
    bl_options = frozenset({"DEFAULT_CLOSED"})

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return bool(context.material) and super().poll(context)

    def draw_header(self, context: bpy.types.Context) -> None:
        self.layout.prop(context.material.pivot, "use_ndf_image", text="")

    def draw(self, context: bpy.types.Context) -> None:
        pivot = context.material.pivot
        layout = self.layout
        column = layout.column()
        column.active = pivot.use_ndf_image
        column.template_ID(pivot, "ndf_image", new="image.new", open="image.open")
        if pivot.ndf_image:
            column.template_icon(icon_value=layout.icon(pivot.ndf_image), scale=_PREVIEW_SCALE)
        column = layout.column(align=True)
        column.operator("pivot.ndf_draw")
        column.operator("pivot.ndf_weave")
        column.operator("pivot.ndf_from_map")


def register() -> None:
    bpy.utils.register_class(PIVOT_MATERIAL_PT_ndf)


def unregister() -> None:
    bpy.utils.unregister_class(PIVOT_MATERIAL_PT_ndf)
