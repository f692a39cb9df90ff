"""The addon as an addon: its settings on the way to the core, its panels, and that it comes and goes cleanly."""

from __future__ import annotations

from dataclasses import asdict
from pathlib import Path
from typing import Any

import addon_utils
import bpy
import parts
from recording import record


def main(folder: Path) -> Any:
    return {
        "defaults": _defaults(),
        "settings": _settings(),
        "seeds": _seeds(),
        "layers": _layer_samples(),
        "toggled": _toggled(),
    }


def _defaults() -> Any:
    parts.clear()
    parts.camera()
    return asdict(record().settings)


def _settings() -> Any:
    parts.clear()
    parts.camera()
    pivot, render = bpy.context.scene.pivot, bpy.context.scene.render
    pivot.integrator, pivot.light_sampling = "ANALYTIC", "SPTD"
    pivot.samples, pivot.adaptive, pivot.seed, pivot.max_bounces = 7, True, 3, 0
    pivot.clamp_indirect, pivot.filter_glossy = 2.5, 1.5
    bpy.context.scene.cycles.transparent_max_bounces = 3
    pivot.error_budget, pivot.time_limit = 0.5, 12
    pivot.analytic_method, pivot.occlusion = "LTC", "BENT_CONE"
    pivot.indirect, pivot.virtual_lights = "VSGL", 256
    render.threads_mode, render.threads = "FIXED", 3
    render.filter_size, render.film_transparent = 2.0, True
    return asdict(record().settings)


def _seeds() -> dict[str, list[int]]:
    """Of frames 1 and 2: with Animate Seed, of the seed next to it, and without."""
    parts.clear()
    parts.camera()
    scene = bpy.context.scene

    def of_frames(seed: int, animated: bool) -> list[int]:
        scene.pivot.seed, scene.pivot.animate_seed = seed, animated
        seeds = []
        for frame in (1, 2):
            scene.frame_set(frame)
            seeds.append(record().settings.seed)
        scene.frame_set(1)
        return seeds

    return {"animated": of_frames(3, True), "next": of_frames(4, True), "still": of_frames(3, False)}


def _layer_samples() -> Any:
    """Samples of the settings handed over last, of a layer with its own."""
    parts.clear()
    parts.camera()
    bpy.context.view_layer.samples = 5
    return record().settings.samples


def _toggled() -> Any:
    """What is left of the addon when it is disabled, and whether it works when enabled again."""
    addon_utils.disable("pivot")
    left = {
        "settings": hasattr(bpy.types.Scene, "pivot"),
        "pass_switches": hasattr(bpy.types.ViewLayer, "pivot"),
        "microfacets": hasattr(bpy.types.Material, "pivot") or hasattr(bpy.types, "PIVOT_OT_ndf_draw"),
        "engine": hasattr(bpy.types, "PivotRenderEngine"),
        "panels": [p.__name__ for p in _panels() if p.__name__.startswith("PIVOT_")],
        "opted_in": [p.__name__ for p in _panels() if "PIVOT" in getattr(p, "COMPAT_ENGINES", ())],
        "handlers": [
            name
            for name in ("render_init", "render_pre", "render_post", "load_post")
            for handler in getattr(bpy.app.handlers, name)
            if handler.__module__.startswith("pivot")
        ],
    }
    addon_utils.enable("pivot")
    parts.clear()
    parts.camera()
    opted_in = [p.__name__ for p in _panels() if "PIVOT" in getattr(p, "COMPAT_ENGINES", ())]
    return {"left": left, "opted_in": opted_in, "again": asdict(record().settings)}


def _panels() -> list[Any]:
    return [panel for panel in bpy.types.Panel.__subclasses__() if panel.is_registered]
