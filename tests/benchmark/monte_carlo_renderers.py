"""Cycles and Pivot inside Blender as a module, of a scene that a function builds there: no denoiser, no clamping."""

from __future__ import annotations

import importlib
from collections.abc import Callable
from typing import Any

import bpy

# isort: split
import addon_utils
import numpy as np
from blender_render import render_picture
from numpy.typing import NDArray


class Cycles:
    """settings: scene.cycles' properties."""

    def __init__(self, build: Callable[[], None], settings: dict[str, Any]) -> None:
        build()
        addon_utils.enable("cycles")
        scene = bpy.context.scene
        scene.render.engine = "CYCLES"
        scene.view_layers[0].use_pass_combined = True
        cycles: Any = scene.cycles
        cycles.device = "CPU"
        unclamped = {"sample_clamp_direct": 0.0, "sample_clamp_indirect": 0.0, "blur_glossy": 0.0}
        plain = {"use_adaptive_sampling": False, "use_denoising": False}
        for name, value in (unclamped | plain | settings).items():
            setattr(cycles, name, value)

    def render(self, samples: int, seed: int) -> NDArray[np.float32]:
        bpy.context.scene.cycles.samples = samples
        bpy.context.scene.cycles.seed = seed
        return render_picture()


class Pivot:
    """settings: of pivot_core.RenderSettings."""

    def __init__(self, build: Callable[[], None], settings: dict[str, Any]) -> None:
        build()
        addon_utils.enable("pivot")
        self._core = importlib.import_module("pivot.core").load()
        reporter = importlib.import_module("pivot.report").Reporter(print, set())
        depsgraph = bpy.context.evaluated_depsgraph_get()
        export_scene = importlib.import_module("pivot.export.scene").export_scene
        self.scene = export_scene(self._core, depsgraph, reporter, lambda: None).scene
        camera: Any = bpy.context.scene.camera
        render = bpy.context.scene.render
        size = render.resolution_x, render.resolution_y
        matrix = np.array(camera.matrix_world)
        optics = importlib.import_module("pivot.export.optics").optics_of(camera, matrix, 0.0, *size)
        self.scene.set_camera(matrix, width=size[0], height=size[1], **optics.arguments(self._core))
        self._settings = settings

    def render(self, samples: int, seed: int) -> NDArray[np.float32]:
        settings = self._core.RenderSettings(samples=samples, seed=seed, **self._settings)
        session = self._core.Session(self.scene, settings)
        session.start()
        while not session.wait(60.0):
            pass
        return session.read("Combined")[..., :3]
