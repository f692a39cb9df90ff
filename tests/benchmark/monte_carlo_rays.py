"""How near Pivot's render comes to the rate at which bare Embree traces the same rays; prints CPU ns a camera sample.

./run python tests/benchmark/monte_carlo_rays.py [SCENE ...]

Bare: the camera rays of one sample a pixel, in packets, and from each hit a ray towards a place on each light that is
above its horizon, with no shading but making them. Both in one thread.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from functools import partial

import monte_carlo_blender as blender
import monte_carlo_renderers as renderers
import monte_carlo_scenes as scenes
import numpy as np
from numpy.typing import NDArray

SAMPLES = (4, 20)
REPEATS = 3


def camera_rays(scene: scenes.Scene, view_plane: tuple[float, ...]) -> tuple[NDArray[np.float32], NDArray[np.float32]]:
    left, right, bottom, top = view_plane
    x = left + (np.arange(scenes.WIDTH) + 0.5) / scenes.WIDTH * (right - left)
    y = bottom + (np.arange(scenes.HEIGHT) + 0.5) / scenes.HEIGHT * (top - bottom)
    local = np.stack([*np.meshgrid(x, y), -np.ones((scenes.HEIGHT, scenes.WIDTH))], -1).reshape(-1, 3)
    direction = local @ scenes.look_at(scene.eye, scene.target)[:3, :3].T
    direction /= np.linalg.norm(direction, axis=1, keepdims=True)
    return np.broadcast_to(scene.eye, direction.shape).astype(np.float32), direction.astype(np.float32)


def least_cpu_s(work: Callable[[], object]) -> float:
    times = []
    for _ in range(REPEATS):
        start_s = time.process_time()
        work()
        times.append(time.process_time() - start_s)
    return min(times)


def measure(name: str) -> None:
    scene = scenes.SCENES[name]
    pivot = renderers.Pivot(partial(blender.build, scene), scenes.DIRECT_LIGHT["pivot"] | {"threads": 1})
    origin, direction = camera_rays(scene, pivot.view_plane)
    distance_m = pivot.scene.intersect(origin, direction)[0]
    hit = np.isfinite(distance_m)
    point = origin[hit] + direction[hit] * (0.9999 * distance_m[hit, None])
    bare_s = least_cpu_s(lambda: pivot.scene.intersect(origin, direction))
    random = np.random.default_rng(1)
    rays = len(origin)
    for light in scene.lights[:8]:  # a first vertex samples no more
        to_light = light.location + light.size_m[0] * random.uniform(-0.5, 0.5, point.shape) - point
        above = to_light[:, 2] > 0
        far_m = np.linalg.norm(to_light[above], axis=1)
        shadow = [a.astype(np.float32) for a in (point[above], to_light[above] / far_m[:, None], far_m)]
        bare_s += least_cpu_s(lambda shadow=shadow: pivot.scene.occluded(*shadow))
        rays += len(far_m)
    few_s, many_s = (least_cpu_s(lambda count=count: pivot.render(count, 0)) for count in SAMPLES)
    bare_ns, pivot_ns = (1e9 * s / len(origin) for s in (bare_s, (many_s - few_s) / (SAMPLES[1] - SAMPLES[0])))
    share = 100 * bare_ns / pivot_ns
    rate = 1e3 * rays / len(origin) / bare_ns
    print(f"{name:20} bare {bare_ns:6.0f} ({rate:.1f} Mrays/s)  pivot {pivot_ns:6.0f}  {share:.0f} %", flush=True)


if __name__ == "__main__":
    for scene_name in sys.argv[1:] or scenes.SCENES:
        measure(scene_name)
