"""Pivot's panels, and Blender's own that make sense for it, opted in by name."""

from __future__ import annotations

from typing import Any

import bpy

from . import denoise
from .chart import operators as chart_operators
from .engine import PivotRenderEngine
from .export.optics import panorama_names, panorama_settings
from .passes import PASSES
from .sampling_presets import PIVOT_PT_sampling_presets

_ENGINE = PivotRenderEngine.bl_idname

# Names of Blender's panels; a name that ends in * stands for all that begin like it.
_BUILT_IN = (
    "RENDER_PT_color_management*",
    "RENDER_PT_simplify*",
    "RENDER_PT_format",
    "RENDER_PT_frame_range",
    "RENDER_PT_time_stretching",
    "RENDER_PT_output*",
    "RENDER_PT_encoding*",
    "RENDER_PT_post_processing",
    "RENDER_PT_stamp*",
    "RENDER_PT_stereoscopy",
    "VIEWLAYER_PT_context_layer",
    "VIEWLAYER_PT_layer",
    "VIEWLAYER_PT_override",
    "OBJECT_PT_custom_props",
    "OBJECT_PT_shading",
    "OBJECT_PT_visibility",
    "DATA_PT_context_*",
    "DATA_PT_custom_props_*",
    "DATA_PT_camera_animation",
    "DATA_PT_light_animation",
    "DATA_PT_mesh_animation",
    "DATA_PT_preview",
    "DATA_PT_lens",
    "DATA_PT_camera",
    "DATA_PT_camera_dof*",
    "DATA_PT_camera_display*",
    "DATA_PT_camera_safe_areas*",
    "DATA_PT_camera_background_image",
    "DATA_PT_camera_stereoscopy",
    "DATA_PT_customdata",
    "DATA_PT_mesh_attributes",
    "DATA_PT_normals",
    "DATA_PT_remesh",
    "DATA_PT_shape_keys",
    "DATA_PT_texture_space",
    "DATA_PT_uv_texture",
    "DATA_PT_vertex_colors",
    "DATA_PT_vertex_groups",
    "DATA_PT_volume_*",
    "EEVEE_MATERIAL_PT_context_material",
    "EEVEE_MATERIAL_PT_surface",
    "EEVEE_MATERIAL_PT_volume",
    "MATERIAL_PT_preview",
    "MATERIAL_PT_custom_props",
    "EEVEE_WORLD_PT_surface",
    "EEVEE_WORLD_PT_volume",
    "WORLD_PT_context_world",
    "WORLD_PT_custom_props",
    "PARTICLE_PT_*",
    "PHYSICS_PT_*",
)


# Lines that the Properties editor's default width has room for.
_WITHOUT_DENOISER = (
    "Needs Open Image Denoise:",
    "pip's pyoidn, a Blender from",
    "blender.org, or the system's library",
)


class PivotPanel:
    bl_space_type = "PROPERTIES"
    bl_region_type = "WINDOW"
    bl_context = "render"
    COMPAT_ENGINES = frozenset({_ENGINE})

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return context.engine in cls.COMPAT_ENGINES


def columns(panel: Any) -> Any:
    """The layout of a panel, in Blender's two-column style."""
    panel.layout.use_property_split = True
    panel.layout.use_property_decorate = False
    return panel.layout


def draw_denoising(layout: bpy.types.UILayout, pivot: Any) -> None:
    column = layout.column()
    column.enabled = denoise.is_there()
    column.prop(pivot, "denoise")
    column.prop(pivot, "denoise_viewport", text="Viewport")
    if not column.enabled:
        lines = layout.column(align=True)
        for number, line in enumerate(_WITHOUT_DENOISER):
            lines.label(text=line, icon="INFO" if number == 0 else "BLANK1")


class PIVOT_RENDER_PT_sampling(PivotPanel, bpy.types.Panel):
    bl_label = "Sampling"

    def draw_header_preset(self, _: bpy.types.Context) -> None:
        PIVOT_PT_sampling_presets.draw_panel_header(self.layout)

    def draw(self, context: bpy.types.Context) -> None:
        layout = columns(self)
        pivot = context.scene.pivot
        layout.prop(pivot, "integrator")
        layout.prop(pivot, "samples")
        layout.prop(pivot, "preview_samples", text="Viewport")
        layout.prop(pivot, "adaptive")
        if pivot.integrator == "MONTE_CARLO":
            budget = layout.column()
            budget.active = pivot.adaptive
            budget.prop(pivot, "error_budget")
            layout.prop(pivot, "light_sampling")
            layout.prop(pivot, "max_bounces")
            bounced = layout.column()
            bounced.active = pivot.max_bounces > 0
            bounced.prop(pivot, "clamp_indirect")
            bounced.prop(pivot, "filter_glossy")
            seed = layout.row(align=True)
            seed.prop(pivot, "seed")
            seed.prop(pivot, "animate_seed", text="", icon="TIME")
        else:
            layout.prop(pivot, "analytic_method")
            layout.prop(pivot, "error_budget")
            layout.prop(pivot, "occlusion")
            layout.prop(pivot, "indirect")
            lights = layout.column()
            lights.active = pivot.indirect == "VSGL"
            lights.prop(pivot, "virtual_lights")
            layout.prop(pivot, "max_bounces")
        if pivot.integrator == "MONTE_CARLO":
            draw_denoising(layout, pivot)
        layout.prop(pivot, "time_limit")


class PIVOT_RENDER_PT_bounce_limits(PivotPanel, bpy.types.Panel):
    bl_label = "Bounce Limits"
    bl_parent_id = "PIVOT_RENDER_PT_sampling"
    bl_options = frozenset({"DEFAULT_CLOSED"})

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return super().poll(context) and context.scene.pivot.integrator == "MONTE_CARLO"

    def draw(self, context: bpy.types.Context) -> None:
        column = columns(self).column(align=True)
        column.active = context.scene.pivot.max_bounces > 0
        for kind in ("diffuse", "glossy", "transmission", "volume"):
            column.prop(context.scene.pivot, f"{kind}_bounces")


class PIVOT_RENDER_PT_chart(PivotPanel, bpy.types.Panel):
    bl_label = "Speed and Accuracy"

    def draw(self, context: bpy.types.Context) -> None:
        chart_operators.draw(self.layout, context)


class PIVOT_RENDER_PT_film(PivotPanel, bpy.types.Panel):
    bl_label = "Film"
    bl_options = frozenset({"DEFAULT_CLOSED"})

    def draw(self, context: bpy.types.Context) -> None:
        layout = columns(self)
        if hasattr(context.scene, "cycles"):
            layout.prop(context.scene.cycles, "film_exposure")
        layout.prop(context.scene.render, "filter_size")
        layout.prop(context.scene.render, "film_transparent", text="Transparent")


class PIVOT_RENDER_PT_performance(PivotPanel, bpy.types.Panel):
    bl_label = "Performance"
    bl_options = frozenset({"DEFAULT_CLOSED"})

    def draw(self, context: bpy.types.Context) -> None:
        layout = columns(self)
        render = context.scene.render
        layout.prop(render, "threads_mode")
        threads = layout.column()
        threads.enabled = render.threads_mode == "FIXED"
        threads.prop(render, "threads")


def _is_rendered(context: bpy.types.Context) -> bool:
    return context.engine == _ENGINE and context.space_data.shading.type == "RENDERED"


class PIVOT_VIEW3D_PT_shading(bpy.types.Panel):
    bl_label = "Render Pass"
    bl_space_type = "VIEW_3D"
    bl_region_type = "HEADER"
    bl_parent_id = "VIEW3D_PT_shading"

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return _is_rendered(context)

    def draw(self, context: bpy.types.Context) -> None:
        self.layout.prop(context.space_data.shading.pivot, "render_pass", text="")


def _draw_pause(header: Any, context: bpy.types.Context) -> None:
    """In the header of a 3D view that Pivot renders, as Cycles has it."""
    if _is_rendered(context):
        pivot = context.scene.pivot
        header.layout.prop(pivot, "preview_pause", text="", icon="PLAY" if pivot.preview_pause else "PAUSE")


class PIVOT_VIEWLAYER_PT_passes(PivotPanel, bpy.types.Panel):
    bl_label = "Passes"
    bl_context = "view_layer"

    def draw(self, context: bpy.types.Context) -> None:
        column = columns(self).column(heading="Include")
        labels = {entry.switch: entry.name_5_0 for entry in PASSES} | {"denoising_store_passes": "Denoising Data"}
        for entry in {entry.switch: entry for entry in PASSES}.values():
            switches = entry.switches(context.view_layer)
            if entry.settings != "pivot" and switches is not None:
                column.prop(switches, entry.switch, text=labels[entry.switch])


class PIVOT_VIEWLAYER_PT_own_passes(PivotPanel, bpy.types.Panel):
    bl_label = "Pivot"
    bl_context = "view_layer"

    def draw(self, context: bpy.types.Context) -> None:
        column = columns(self).column(heading="Include")
        for entry in PASSES:
            if entry.settings == "pivot":
                column.prop(context.view_layer.pivot, entry.switch)


class PIVOT_OBJECT_PT_ray_visibility(PivotPanel, bpy.types.Panel):
    bl_label = "Ray Visibility"
    bl_context = "object"
    bl_parent_id = "OBJECT_PT_visibility"

    def draw(self, context: bpy.types.Context) -> None:
        column = columns(self).column()
        for kind in ("camera", "diffuse", "glossy", "transmission", "volume_scatter", "shadow"):
            column.prop(context.object, f"visible_{kind}", text=kind.replace("_", " ").title())
        column.prop(context.object, "is_holdout")


class PIVOT_MATERIAL_PT_fog(PivotPanel, bpy.types.Panel):
    bl_label = "Fog"
    bl_context = "material"
    bl_parent_id = "EEVEE_MATERIAL_PT_volume"

    def draw(self, context: bpy.types.Context) -> None:
        columns(self).prop(context.material.pivot, "phase")


class PIVOT_WORLD_PT_preview(PivotPanel, bpy.types.Panel):
    """Blender has one of its own for materials and lights only."""

    bl_label = "Preview"
    bl_context = "world"
    bl_options = frozenset({"DEFAULT_CLOSED"})
    bl_order = -1  # before Blender's own, as elsewhere

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return bool(context.world) and super().poll(context)

    def draw(self, context: bpy.types.Context) -> None:
        self.layout.template_preview(context.world)


class PIVOT_CAMERA_PT_panorama(PivotPanel, bpy.types.Panel):
    """Blender's own Lens panel shows these in Cycles alone."""

    bl_label = "Panorama"
    bl_context = "data"
    bl_parent_id = "DATA_PT_lens"

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return bool(context.camera) and context.camera.type == "PANO" and super().poll(context)

    def draw(self, context: bpy.types.Context) -> None:
        layout = columns(self)
        settings = panorama_settings(context.camera)
        layout.prop(settings, "panorama_type", text="Type")
        for name in panorama_names(settings.panorama_type):
            coefficient = name.removeprefix("fisheye_polynomial_")
            layout.prop(settings, name, **({} if coefficient == name else {"text": coefficient.upper()}))


class PIVOT_LIGHT_PT_light(PivotPanel, bpy.types.Panel):
    bl_label = "Light"
    bl_context = "data"

    @classmethod
    def poll(cls, context: bpy.types.Context) -> bool:
        return bool(context.light) and super().poll(context)

    def draw(self, context: bpy.types.Context) -> None:
        light: Any = context.light
        layout = self.layout
        layout.row().prop(light, "type", expand=True)
        layout = columns(self)
        column = layout.column()
        if hasattr(light, "use_temperature"):  # from Blender 4.5
            column.prop(light, "use_temperature")
            if light.use_temperature:
                column.prop(light, "temperature")
        column.prop(light, "color")
        column.prop(light, "energy")
        if hasattr(light, "exposure"):  # from Blender 4.4
            column.prop(light, "exposure")
            column.prop(light, "normalize")
        column = layout.column()
        if light.type == "SUN":
            column.prop(light, "angle")
        elif light.type == "AREA":
            column.prop(light, "shape")
            column.prop(light, "size", text="Size X" if light.shape in {"RECTANGLE", "ELLIPSE"} else "Size")
            if light.shape in {"RECTANGLE", "ELLIPSE"}:
                column.prop(light, "size_y", text="Y")
            column.prop(light, "spread")
        else:
            column.prop(light, "shadow_soft_size", text="Radius")
        if light.type == "SPOT":
            column.prop(light, "spot_size", text="Beam Angle")
            column.prop(light, "spot_blend", text="Blend", slider=True)
            column.prop(light, "show_cone")
        if hasattr(light, "cycles"):
            casts = light.cycles if hasattr(light.cycles, "cast_shadow") else light
            column.prop(casts, "cast_shadow" if casts is not light else "use_shadow", text="Cast Shadow")
            column.prop(light.cycles, "max_bounces")


_CLASSES = (
    PIVOT_RENDER_PT_sampling,
    PIVOT_RENDER_PT_bounce_limits,
    PIVOT_RENDER_PT_chart,
    PIVOT_RENDER_PT_film,
    PIVOT_RENDER_PT_performance,
    PIVOT_VIEW3D_PT_shading,
    PIVOT_VIEWLAYER_PT_passes,
    PIVOT_VIEWLAYER_PT_own_passes,
    PIVOT_OBJECT_PT_ray_visibility,
    PIVOT_MATERIAL_PT_fog,
    PIVOT_WORLD_PT_preview,
    PIVOT_CAMERA_PT_panorama,
    PIVOT_LIGHT_PT_light,
)


def _built_in_panels() -> list[Any]:
    """Blender's panels that _BUILT_IN names, of those this Blender has."""
    prefixes = tuple(name[:-1] for name in _BUILT_IN if name.endswith("*"))
    return [
        panel
        for panel in bpy.types.Panel.__subclasses__()
        if hasattr(panel, "COMPAT_ENGINES") and (panel.__name__ in _BUILT_IN or panel.__name__.startswith(prefixes))
    ]


def register() -> None:
    for panel in _CLASSES:
        bpy.utils.register_class(panel)
    for panel in _built_in_panels():
        panel.COMPAT_ENGINES.add(_ENGINE)
    bpy.types.VIEW3D_HT_header.append(_draw_pause)


def unregister() -> None:
    bpy.types.VIEW3D_HT_header.remove(_draw_pause)
    for panel in _built_in_panels():
        panel.COMPAT_ENGINES.discard(_ENGINE)
    for panel in reversed(_CLASSES):
        bpy.utils.unregister_class(panel)
