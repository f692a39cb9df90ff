"""What a renderer's own process does for a benchmark: the jobs of a file, each a picture and its CPU seconds.

WORKER < JOBS: JSON, a list of {"scene", "renderer", "settings", "samples", "seed", "file"}, those of one scene and
settings together. Writes file.npz with image (height, width, 3), bottom row first, and cpu_s.
"""

from __future__ import annotations

import itertools
import json
import sys
import time
from collections.abc import Callable, Mapping
from typing import Any, Protocol, TypeVar

import numpy as np
from numpy.typing import NDArray

Scene = TypeVar("Scene")


class Renderer(Protocol):
    def render(self, samples: int, seed: int) -> NDArray[np.float32]: ...


def main(
    renderers: Mapping[str, Callable[[Scene, dict[str, Any]], Renderer]],
    scenes: Mapping[str, Scene],
) -> None:
    """Both by the names that jobs use."""
    jobs = json.load(sys.stdin)
    for (scene, name, settings), group in itertools.groupby(
        jobs, lambda job: (job["scene"], job["renderer"], job["settings"])
    ):
        renderer = renderers[name](scenes[scene], settings)
        renderer.render(1, 0)  # kernels are loaded and compiled, the scene's BVH is built
        for job in group:
            start_s = time.process_time()
            image = renderer.render(job["samples"], job["seed"])
            cpu_s = time.process_time() - start_s
            np.savez(job["file"], image=image.astype(np.float32), cpu_s=cpu_s)
