"""What an artist sets, saved with the .blend: `pivot` of scenes, view layers, materials and 3D views' shading."""

from __future__ import annotations

from typing import Any

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty, PointerProperty

from .viewport_passes import VIEWPORT_PASSES

MOST_BOUNCES = 1024

INTEGRATORS = (
    ("MONTE_CARLO", "Monte Carlo", "Unbiased path tracing: for final pictures and ground truth"),
    ("ANALYTIC", "Analytic", "Closed forms without random numbers: no noise and no flicker"),
)

LIGHT_SAMPLING = (
    ("JOINT", "Joint", "Samples the product of material and light exactly; the least noise"),
    ("SPTD", "SPTD", "Samples the light through the pivoted cap of the material's lobe, with its MIS"),
    ("MIS", "MIS", "Light and material samples, combined by multiple importance sampling"),
    ("LIGHT", "Light", "Samples the light's cone only"),
    ("BSDF", "BSDF", "Samples the material only"),
)

ANALYTIC_METHODS = (
    ("AUTO", "Automatic", "The cheapest method whose predicted error meets the error budget"),
    ("EXACT", "Exact", "The closed form of GGX under lights of finite size"),
    ("SPTD", "SPTD", "One spherical pivot transformed distribution per lobe, from a table"),
    ("LTC", "LTC", "One linearly transformed cosine per lobe, from a table"),
)

OCCLUSIONS = (
    ("RAY_TRACED", "Ray Traced", "Rays to a fixed set of points on each light"),
    ("BENT_CONE", "Bent Cones", "The cone of what each vertex sees; soft and fast, but coarse"),
    ("NONE", "None", "Lights cast no shadows"),
)

DENOISING = (
    ("NONE", "None", "Noise stays"),
    (
        "INDIRECT",
        "Indirect",
        "Light that bounced, and direct light where it is noisy; shadows and highlights stay sharp",
    ),
    ("ALL", "All", "Direct light also where its noise is low"),
)

INDIRECT = (
    ("NONE", "None", "Direct light only"),
    (
        "VSGL",
        "Virtual Lights",
        "What surfaces send on of light that comes to them, as Gaussians: no noise, a little blur",
    ),
)

PHASES = (
    ("HENYEY_GREENSTEIN", "Henyey-Greenstein", "As in Cycles"),
    ("PIVOT", "Pivot", "The phase function that sphere lights are sampled exactly with, of the same mean direction"),
)


def _settings_changed(_: PivotSettings, context: bpy.types.Context) -> None:
    """Blender draws 3D views anew for its own properties only, and would leave a script's change unseen."""
    for window in context.window_manager.windows:
        for area in window.screen.areas:
            if area.type == "VIEW_3D":
                area.tag_redraw()


def _bounce_limit(kind: str, what: str) -> Any:
    """A bound beside Max Bounces; as high as that can be, it says nothing."""
    return IntProperty(
        name=f"{kind} Bounces",
        description=f"The most {what} on a light path; light that comes straight counts none. Max Bounces counts, too",
        default=MOST_BOUNCES,
        min=0,
        max=MOST_BOUNCES,
        update=_settings_changed,
    )


class PivotSettings(bpy.types.PropertyGroup):
    integrator: EnumProperty(name="Integrator", items=INTEGRATORS, default="MONTE_CARLO", update=_settings_changed)
    samples: IntProperty(
        name="Samples",
        description="Samples per pixel",
        default=64,
        min=1,
        soft_max=4096,
        max=1 << 20,
        update=_settings_changed,
    )
    preview_samples: IntProperty(
        name="Viewport Samples",
        description="Samples per pixel in 3D views; 0 is as many as in the final picture",
        default=0,
        min=0,
        soft_max=4096,
        max=1 << 20,
        update=_settings_changed,
    )
    preview_pause: BoolProperty(
        name="Pause",
        description="Render no more in 3D views, and leave there what they show",
        default=False,
        options=set(),
        update=_settings_changed,
    )
    adaptive: BoolProperty(
        name="Adaptive",
        description="Put samples where they help most, at most so many in a pixel, until the picture meets the budget",
        default=False,
        update=_settings_changed,
    )
    seed: IntProperty(
        name="Seed",
        description="The same seed gives the same picture on the same machine",
        default=0,
        min=0,
        update=_settings_changed,
    )
    animate_seed: BoolProperty(
        name="Animate Seed",
        description="Other noise in each frame; else what is left of it stands still while the picture moves",
        default=True,
        update=_settings_changed,
    )
    max_bounces: IntProperty(
        name="Max Bounces",
        description="Bounces of indirect light; 0 is direct light only",
        default=4,
        min=0,
        max=MOST_BOUNCES,
        update=_settings_changed,
    )
    diffuse_bounces: _bounce_limit("Diffuse", "reflections by diffuse surfaces")
    glossy_bounces: _bounce_limit("Glossy", "reflections by glossy surfaces")
    transmission_bounces: _bounce_limit("Transmission", "ways through surfaces that bend or scatter light")
    volume_bounces: _bounce_limit("Volume", "times that fog scatters it")
    clamp_indirect: FloatProperty(
        name="Clamp Indirect",
        description=(
            "The most that light which bounced may add to a sample at once: fewer fireflies, and a little less light. "
            "0 is no bound"
        ),
        default=0.0,
        min=0.0,
        soft_max=100.0,
        update=_settings_changed,
    )
    filter_glossy: FloatProperty(
        name="Filter Glossy",
        description=(
            "Blurs what is glossy where light reaches it by way of something rougher: caustics get softer, with less "
            "noise. 0 keeps all sharp"
        ),
        default=0.0,
        min=0.0,
        soft_max=10.0,
        update=_settings_changed,
    )
    light_sampling: EnumProperty(
        name="Light Sampling",
        description="How rays towards the lights are chosen; every choice converges to one picture",
        items=LIGHT_SAMPLING,
        default="JOINT",
        update=_settings_changed,
    )
    error_budget: FloatProperty(
        name="Error Budget",
        description=(
            "The largest error that closed forms may have, or that adaptive sampling may leave in the picture as it "
            "is, or as the denoiser leaves it. Analytic shadows take more rays the smaller it is; how far off they may "
            "be is in the Error pass"
        ),
        default=2.0,
        min=0.01,
        max=100.0,
        subtype="PERCENTAGE",
        update=_settings_changed,
    )
    analytic_method: EnumProperty(
        name="Method",
        description="How glossy materials are integrated over lights",
        items=ANALYTIC_METHODS,
        default="AUTO",
        update=_settings_changed,
    )
    occlusion: EnumProperty(
        name="Occlusion",
        description="How shadows are found",
        items=OCCLUSIONS,
        default="RAY_TRACED",
        update=_settings_changed,
    )
    indirect: EnumProperty(
        name="Indirect Light",
        description="What is shown of light that comes by way of other surfaces, as often as Max Bounces says",
        items=INDIRECT,
        default="NONE",
        update=_settings_changed,
    )
    virtual_lights: IntProperty(
        name="Virtual Lights",
        description="About how many places send light on: the more, the less blurred it is near where it comes from",
        default=4096,
        min=1,
        soft_max=65536,
        max=1 << 20,
        update=_settings_changed,
    )
    denoise: EnumProperty(
        name="Denoise",
        description="What of the final picture Open Image Denoise cleans of noise",
        items=DENOISING,
        default="NONE",
        update=_settings_changed,
    )
    denoise_viewport: EnumProperty(
        name="Denoise Viewport",
        description="What Open Image Denoise cleans of noise in 3D views, while nothing moves",
        items=DENOISING,
        default="NONE",
        update=_settings_changed,
    )
    time_limit: FloatProperty(
        name="Time Limit",
        description="Seconds after which a frame stops with the samples it has; 0 is no limit",
        default=0.0,
        min=0.0,
        subtype="TIME_ABSOLUTE",
        unit="TIME_ABSOLUTE",
        update=_settings_changed,
    )


def _passes_changed(_: PivotPasses, context: bpy.types.Context) -> None:
    context.view_layer.update_render_passes()


class PivotPasses(bpy.types.PropertyGroup):
    """Switches of the passes that Blender has none for."""

    use_pass_method: BoolProperty(
        name="Method",
        description="The analytic integrator's methods, by colour, as each pixel took them",
        update=_passes_changed,
    )
    use_pass_indirect: BoolProperty(
        name="Indirect",
        description="Light that comes by way of other surfaces or fog; of the analytic integrator, by virtual lights",
        update=_passes_changed,
    )
    use_pass_error: BoolProperty(
        name="Error",
        description=(
            "The relative error that the analytic integrator predicts of each pixel: of closed forms, of shadows and, "
            "with several samples, of edges within the pixel"
        ),
        update=_passes_changed,
    )


def _material_changed(pivot: PivotMaterial, _: bpy.types.Context) -> None:
    """Blender tells the viewport of its own properties only."""
    pivot.id_data.update_tag()


class PivotMaterial(bpy.types.PropertyGroup):
    use_ndf_image: BoolProperty(
        name="Microfacets from Image",
        description="The image tells how the surface is rough; colors and how metallic it is stay those of the nodes",
        default=False,
        update=_material_changed,
    )
    ndf_image: PointerProperty(
        name="Microfacets",
        description=(
            "How many microfacets there are of each normal, in the red channel: the middle is the surface's own, "
            "right is along the tangent, and the edge of the disk is the horizon"
        ),
        update=_material_changed,
        type=bpy.types.Image,
    )
    phase: EnumProperty(
        name="Phase",
        description="How the fog within scatters light around the direction that Anisotropy tells",
        items=PHASES,
        default="HENYEY_GREENSTEIN",
        update=_material_changed,
    )


class PivotShading(bpy.types.PropertyGroup):
    """Of one 3D view."""

    render_pass: EnumProperty(
        name="Pass",
        description="What the 3D view shows",
        items=VIEWPORT_PASSES,
        default="COMBINED",
        update=_settings_changed,
    )


def register() -> None:
    bpy.utils.register_class(PivotSettings)
    bpy.utils.register_class(PivotPasses)
    bpy.utils.register_class(PivotMaterial)
    bpy.utils.register_class(PivotShading)
    bpy.types.Scene.pivot = PointerProperty(type=PivotSettings)
    bpy.types.ViewLayer.pivot = PointerProperty(type=PivotPasses)
    bpy.types.Material.pivot = PointerProperty(type=PivotMaterial)
    bpy.types.View3DShading.pivot = PointerProperty(type=PivotShading)


def unregister() -> None:
    del bpy.types.View3DShading.pivot
    del bpy.types.Material.pivot
    del bpy.types.ViewLayer.pivot
    del bpy.types.Scene.pivot
    bpy.utils.unregister_class(PivotShading)
    bpy.utils.unregister_class(PivotMaterial)
    bpy.utils.unregister_class(PivotPasses)
    bpy.utils.unregister_class(PivotSettings)
