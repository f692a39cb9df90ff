"""Pictures of Blender's current scene and the CPU seconds they cost: direct light if the settings' max_bounces say
nothing else, box filter, no denoiser but where the settings ask for Pivot's.

A renderer is a context manager, ready when entered; render(settings, samples, seed) returns the picture (height, width,
3), bottom row first, and the seconds of the render alone, all threads together.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import bpy
import numpy as np
from numpy.typing import NDArray

from .. import core
from ..denoise import Denoiser
from ..export.camera import export_camera, render_frame
from ..export.scene import export_scene
from ..report import Reporter

Floats = NDArray[np.float32]
Render = Callable[[dict[str, Any], int, int], tuple[Floats, float]]


def set_size(scene: bpy.types.Scene, width_px: int) -> None:
    """The whole frame, width_px wide."""
    render = scene.render
    height_px = max(1, round(width_px * render.resolution_y / render.resolution_x))
    render.resolution_x, render.resolution_y, render.resolution_percentage = width_px, height_px, 100
    render.use_border = False
    render.use_multiview = False


def with_pivot(scene: bpy.types.Scene, work: Callable[[Render], None]) -> None:
    """Call work(render) with the scene as Pivot exports it for a final render, which only an engine is given."""
    faults: list[BaseException] = []

    class Engine(bpy.types.RenderEngine):
        bl_idname = "PIVOT_CHART"
        bl_label = "Pivot Chart"

        def __init__(self, *arguments: Any, **keywords: Any) -> None:
            super().__init__(*arguments, **keywords)

        def render(self, depsgraph: bpy.types.Depsgraph) -> None:
            try:
                work(_pivot(self, depsgraph))
            except BaseException as fault:
                faults.append(fault)

    bpy.utils.register_class(Engine)
    try:
        scene.render.engine = Engine.bl_idname
        layer = next(layer for layer in scene.view_layers if layer.use)
        bpy.ops.render.render(scene=scene.name, layer=layer.name)
    finally:
        bpy.utils.unregister_class(Engine)
    if faults:
        raise faults[0]


def _pivot(engine: bpy.types.RenderEngine, depsgraph: bpy.types.Depsgraph) -> Render:
    scene = depsgraph.scene
    context = export_scene(core.load(), depsgraph, Reporter(lambda _, text: print(text), set()), lambda: None)
    export_camera(context, engine, render_frame(scene.render, engine.resolution_x, engine.resolution_y))

    def render(settings: dict[str, Any], samples: int, seed: int) -> tuple[Floats, float]:
        changed = {"max_bounces": 0} | settings
        mode = changed.pop("denoise", "NONE")
        if "error_budget" in changed:
            changed["error_budget_percent"] = changed.pop("error_budget")
        chosen = context.core.RenderSettings(
            samples=samples,
            seed=seed,
            threads=scene.render.threads,
            pixel_filter="BOX",
            filter_width_px=1.0,
            denoising_passes=mode != "NONE",
            **changed,
        )
        session = context.core.Session(context.scene, chosen)
        start_s = time.process_time()
        session.start()
        while not session.wait(1.0):
            pass
        picture = session.read("Combined") if mode == "NONE" else Denoiser().denoised(mode, session.read).combined
        return picture[..., :3], time.process_time() - start_s

    render({}, 1, 0)  # builds the scene's BVH
    return render


def with_cycles(scene: bpy.types.Scene, work: Callable[[Render], None]) -> None:
    """Call work(render) with Cycles on the CPU. Its seconds are of samples alone: by the difference of two counts."""
    scene.render.engine = "CYCLES"
    image_settings = scene.render.image_settings
    if bpy.app.version >= (5, 0):
        image_settings.media_type = "IMAGE"
    image_settings.file_format, image_settings.color_mode, image_settings.color_depth = "OPEN_EXR", "RGB", "32"
    scene.render.use_compositing = scene.render.use_sequencer = False
    cycles: Any = scene.cycles
    cycles.device = "CPU"
    cycles.use_adaptive_sampling = cycles.use_denoising = False
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0
    cycles.pixel_filter_type = "BOX"
    for layer in scene.view_layers:
        layer.samples = 0  # else it overrides the scene's
    path = Path(bpy.app.tempdir) / "chart.exr"
    scene.render.filepath = str(path)

    def picture(samples: int, seed: int, bounces: int = 0) -> tuple[Floats, float]:
        cycles.samples, cycles.seed, cycles.max_bounces = samples, seed, bounces
        start_s = time.process_time()
        bpy.ops.render.render(write_still=True, scene=scene.name)
        cpu_s = time.process_time() - start_s
        image = bpy.data.images.load(str(path))
        image.colorspace_settings.is_data = True
        pixels = np.empty(image.size[0] * image.size[1] * 4, np.float32)
        image.pixels.foreach_get(pixels)
        height, width = image.size[1], image.size[0]
        bpy.data.images.remove(image)
        return pixels.reshape(height, width, 4)[..., :3], cpu_s

    picture(1, 0)  # loads what is loaded once
    few, many = 1, 65
    sample_s: dict[int, float] = {}  # by the number of bounces

    def render(settings: dict[str, Any], samples: int, seed: int) -> tuple[Floats, float]:
        bounces = settings.get("max_bounces", 0)
        if bounces not in sample_s:
            sample_s[bounces] = (picture(many, 0, bounces)[1] - picture(few, 0, bounces)[1]) / (many - few)
        return picture(samples, seed, bounces)[0], samples * sample_s[bounces]

    work(render)
