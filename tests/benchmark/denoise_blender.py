"""Inside Blender as a module: the scenes of indirect_scenes.py by Cycles or Pivot, denoised as an artist has it.

denoise_blender.py < JOBS: does the jobs (see monte_carlo_worker.py).
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import bpy

# isort: split
import addon_utils
import indirect_scenes as scenes
import monte_carlo_renderers as renderers
import monte_carlo_worker as worker
import numpy as np
from blender_render import render_picture
from numpy.typing import NDArray


def at_size(build: Callable[[], None], percent: int) -> Callable[[], None]:
    """percent: of the scene's width and height."""

    def build_and_scale() -> None:
        build()
        bpy.context.scene.render.resolution_percentage = percent

    return build_and_scale


class Cycles(renderers.Cycles):
    """settings: scene.cycles' properties, and percent."""

    def __init__(self, build: Callable[[], None], settings: dict[str, Any]) -> None:
        super().__init__(at_size(build, settings.pop("percent")), settings)


class Pivot:
    """settings: scene.pivot's properties, and percent."""

    def __init__(self, build: Callable[[], None], settings: dict[str, Any]) -> None:
        at_size(build, settings.pop("percent"))()
        addon_utils.enable("pivot")
        bpy.context.scene.render.engine = "PIVOT"
        for name, value in settings.items():
            setattr(bpy.context.scene.pivot, name, value)

    def render(self, samples: int, seed: int) -> NDArray[np.float32]:
        pivot: Any = bpy.context.scene.pivot
        pivot.samples, pivot.seed = samples, seed
        return render_picture()


if __name__ == "__main__":
    worker.main({"cycles": Cycles, "pivot": Pivot}, scenes.SCENES)
