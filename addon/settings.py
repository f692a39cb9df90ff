"""scene.pivot and Blender's own render settings, as the core's."""

from __future__ import annotations

from typing import Any

import bpy

from .export.attributes import UV_OF_PASS
from .passes import has_surface_passes
from .properties import MOST_BOUNCES
from .report import naming


def sample_count(depsgraph: bpy.types.Depsgraph) -> int:
    """Samples per pixel: the view layer's own where it has them, else the scene's."""
    return depsgraph.view_layer.samples or depsgraph.scene.pivot.samples


def setting_values(scene: bpy.types.Scene, samples: int, max_bounces: int) -> dict[str, Any]:
    """The arguments of pivot_core.RenderSettings, the samples and bounces as given."""
    pivot = scene.pivot
    return {
        "integrator": pivot.integrator,
        "samples": samples,
        "adaptive": pivot.adaptive,
        "seed": _seed_of(scene),
        "max_bounces": max_bounces,
        "clamp_indirect": pivot.clamp_indirect,
        "filter_glossy": pivot.filter_glossy,
        "light_sampling": pivot.light_sampling,
        "error_budget_percent": pivot.error_budget,
        "analytic_method": pivot.analytic_method,
        "occlusion": pivot.occlusion,
        "indirect": pivot.indirect,
        "virtual_lights": pivot.virtual_lights,
        "time_limit_s": pivot.time_limit,
        "threads": scene.render.threads,
        "filter_width_px": 2 * scene.render.filter_size,  # as wide as Cycles' filter of that size: film.cpp doubles it
        "transparent_film": scene.render.film_transparent,
        "max_passages": _max_transparent_bounces(scene),
        "max_path_passages": _max_path_passages(scene),
    } | _bounce_limits(pivot)


def _seed_of(scene: bpy.types.Scene) -> int:
    """The artist's in frame 1. By a sum, frame 2 of one seed would be frame 1 of the next."""
    between_frames = 0x9E3779B1 if scene.pivot.animate_seed else 0
    return int(scene.pivot.seed + between_frames * (scene.frame_current - 1)) & 0xFFFFFFFF


def _bounce_limits(pivot: Any) -> dict[str, Any]:
    limits = [getattr(pivot, f"{kind}_bounces") for kind in ("diffuse", "glossy", "transmission", "volume")]
    return {} if min(limits) == MOST_BOUNCES else {"bounce_limits": limits}


_FALLOFFS = {"LINEAR": 1.0, "QUADRATIC": 2.0, "INVERSE_QUADRATIC": 0.5}


def surface_pass_values(core_scene: Any, scene: bpy.types.Scene, view_layer: bpy.types.ViewLayer) -> dict[str, Any]:
    """Those arguments that are for passes of surfaces; none where nobody asks for these."""
    if not has_surface_passes(view_layer):
        return {}
    mist = scene.world.mist_settings if scene.world else None
    return {
        "surface_passes": True,
        "occlusion_distance_m": _occlusion_distance_m(scene) if view_layer.use_pass_ambient_occlusion else 0.0,
        "uv_attribute": core_scene.attribute_id(UV_OF_PASS) if view_layer.use_pass_uv else -1,
        "mist": (mist.start, mist.depth, _FALLOFFS[mist.falloff]) if mist else (0.0, 100.0, 1.0),
    }


def _occlusion_distance_m(scene: bpy.types.Scene) -> float:
    return scene.world.light_settings.distance if scene.world else 10.0


def _max_transparent_bounces(scene: bpy.types.Scene) -> int:
    """Cycles' own setting, or what it would be where there is no Cycles."""
    return scene.cycles.transparent_max_bounces if hasattr(scene, "cycles") else 8


def _max_path_passages(scene: bpy.types.Scene) -> int:
    """Cycles' paths passed one more before Blender 5.0."""
    return _max_transparent_bounces(scene) + (bpy.app.version < (5, 0))


def render_settings(native: Any, scene: bpy.types.Scene, values: dict[str, Any]) -> Any:
    """pivot_core.RenderSettings of the scene's setting_values. Raises RenderError where the core refuses them."""
    with naming(f"scene '{scene.name}', render settings", "set it in scene.pivot"):
        return native.RenderSettings(**values)
