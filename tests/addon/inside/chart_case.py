"""A small chart from the operator, end to end: the background Blender, the picture, the suggestion."""

from __future__ import annotations

import importlib
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import bpy
import parts


def main(folder: Path) -> Any:
    _scene()
    pivot, chart = bpy.context.scene.pivot, bpy.context.window_manager.pivot_chart
    finished = bpy.ops.pivot.chart(ladder="SMALL")
    image = bpy.data.images["Speed vs Accuracy"]
    rows = importlib.import_module("pivot.chart.measure").rows_from_json(chart.rows)
    pivot.error_budget = 100.0
    suggestion = chart.suggestion(bpy.context.scene)
    applied = bpy.ops.pivot.chart_apply()
    after = {name: getattr(pivot, name) for name in ("samples", *suggestion.rung.settings)}
    pivot.error_budget = 0.01
    return {
        "has_denoiser": importlib.import_module("pivot.denoise").is_there(),
        "finished": list(finished),
        "is_running": chart.is_running,
        "size": list(image.size),
        "colors": len({tuple(pixel) for pixel in _pixels(image)}),
        "rows": [
            {"renderer": row.rung.renderer, "method": row.rung.method, "cpu_s": row.cpu_s, "rel_mse": row.rel_mse,
             "samples": row.rung.samples, "percent": row.error_percent}
            for row in rows
        ],
        "suggestion": {"samples": suggestion.rung.samples, **suggestion.rung.settings},
        "suggestion_cpu_s": suggestion.cpu_s,
        "applied": list(applied),
        "after": after,
        "suggestion_out_of_reach": chart.suggestion(bpy.context.scene) is not None,
        "bounced": _bounced(),
        "failure": _failure(),
        "cancelled": _cancelled(),
        "keyed": _keyed(folder),
    }  # fmt: skip


def _scene() -> None:
    """A glossy square under a sphere light that shines from beside the camera."""
    parts.clear()
    parts.size(64, 64)
    parts.camera()
    parts.quad("Floor", material=parts.shaded("satin", "ShaderNodeBsdfPrincipled", Roughness=0.4)[0])
    parts.light("Lamp", "POINT", (1, 0, 3), energy=200.0, shadow_soft_size=0.5)


def _pixels(image: bpy.types.Image) -> Any:
    flat = [0.0] * (image.size[0] * image.size[1] * 4)
    image.pixels.foreach_get(flat)
    return zip(*(flat[channel::4] for channel in range(3)), strict=True)


def _bounced() -> Any:
    """The error of each point where light bounced once."""
    bpy.ops.pivot.chart(ladder="SMALL_BOUNCE")
    chart = bpy.context.window_manager.pivot_chart
    rows = importlib.import_module("pivot.chart.measure").rows_from_json(chart.rows)
    return [
        {"method": row.rung.method, "rel_mse": row.rel_mse, "bounces": row.rung.settings["max_bounces"]} for row in rows
    ]


def _failure() -> str:
    """What the operator reports of a scene that cannot be rendered."""
    _scene()
    bpy.context.scene.camera = None
    try:
        bpy.ops.pivot.chart(ladder="SMALL")
    except RuntimeError as error:
        return str(error)
    return ""


def _cancelled() -> bool:
    """Whether a job that is cancelled has ended."""
    _scene()
    job = importlib.import_module("pivot.chart.job").ChartJob("PANEL")
    running = not job.done()
    job.cancel()
    return running and job.done()


def _keyed(folder: Path) -> list[str]:
    """The files, of a scene and of a build of both levels, that make other pictures when they change."""
    files = [folder / name for name in ("scene.blend", "_core_v2.so", "_core_v3.so", "_cpu.so", "_formulas_v3.so")]
    for file in files:
        file.write_text("as built")
    core = importlib.import_module("pivot.core")
    load, core.load = core.load, lambda: SimpleNamespace(__file__=str(folder / "__init__.py"), arch="v3")

    def key() -> str:
        return importlib.import_module("pivot.chart.measure").scene_key(files[0], 64)

    first, keyed = key(), []
    for file in files:
        file.write_text("changed")
        keyed += [file.name] if key() != first else []
        file.write_text("as built")
    core.load = load
    return keyed
