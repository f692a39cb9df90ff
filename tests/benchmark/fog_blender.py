"""Inside Blender as a module: the scenes of fog_scenes.py and shafts_scene.py by Cycles or Pivot.

fog_blender.py < JOBS: does the jobs (see monte_carlo_worker.py).
"""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from typing import Any

import bpy

# isort: split
import fog_scenes as scenes
import fog_smoke
import monte_carlo_renderers as renderers
import monte_carlo_worker as worker
import shafts_scene


class Cycles(renderers.Cycles):
    """settings: scene.cycles' properties, and volume_sampling of every material and the world."""

    def __init__(self, build: Callable[[], None], settings: dict[str, Any]) -> None:
        volume_sampling = settings["volume_sampling"]
        super().__init__(build, {name: value for name, value in settings.items() if name != "volume_sampling"})
        for shader in (*bpy.data.materials, *bpy.data.worlds):
            shader.cycles.volume_sampling = volume_sampling  # type: ignore[union-attr]


if __name__ == "__main__":
    fog_smoke.find_openvdb()
    builders = {name: partial(scenes.build, name) for name in scenes.SCENES}
    builders |= {name: partial(shafts_scene.build, percentage) for name, percentage in shafts_scene.SIZES.items()}
    worker.main({"cycles": Cycles, "pivot": renderers.Pivot}, builders)
