"""How near Pivot's render comes to the rate at which bare Embree traces the same rays, with direct light and bounces.

./run python tests/benchmark/monte_carlo_rays.py [SCENE ...]

ray_log.cpp, compiled here, keeps every ray that a render of 16 samples and half the width and height asks Embree for.
Bare Embree then traces these in the same order, single and in full packets, and with no shading between. Both in one
thread; prints CPU ns a camera sample, the rate of Pivot's render over the faster of the two, and Embree's own share of
the render: its time for the packets as the render made them, with the lanes that were empty. Wants AVX2.
"""

from __future__ import annotations

import ctypes
import os
import subprocess
import sys
import time
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

import bpy

# isort: split
import indirect
import indirect_scenes
import monte_carlo_blender
import monte_carlo_renderers as renderers
import monte_carlo_scenes
from monte_carlo_filters import DIRECT_LIGHT, FILTERS

LIBRARY = Path(__file__).resolve().parents[2] / "build" / "monte_carlo" / "ray_log.so"
SAMPLES = 16
REPEATS = 3


def scenes() -> dict[str, tuple[Callable[[], None], dict[str, Any]]]:
    """What builds each, and Pivot's settings."""
    direct = {
        name: (partial(monte_carlo_blender.build, scene), DIRECT_LIGHT | FILTERS["BLACKMAN_HARRIS"]["pivot"])
        for name, scene in monte_carlo_scenes.SCENES.items()
    }
    return direct | {name: (build, indirect.PIVOT) for name, build in indirect_scenes.SCENES.items()}


def preload() -> None:
    """Compiles the log and starts this script anew with it, unless it is there."""
    if str(LIBRARY) in os.environ.get("LD_PRELOAD", ""):
        return
    LIBRARY.parent.mkdir(parents=True, exist_ok=True)
    source = Path(__file__).with_name("ray_log.cpp")
    flags = ["-std=c++20", "-O2", "-march=x86-64-v3", "-shared", "-fPIC"]
    subprocess.run(["g++", *flags, str(source), "-o", str(LIBRARY), "-ldl"], check=True)
    os.execve(sys.executable, [sys.executable, *sys.argv], os.environ | {"LD_PRELOAD": str(LIBRARY)})


def load_log() -> ctypes.CDLL:
    log = ctypes.CDLL(str(LIBRARY))
    log.ray_log_count.argtypes, log.ray_log_count.restype = [ctypes.c_bool], ctypes.c_uint64
    for function in (log.ray_log_as_traced_s, log.ray_log_full_packets_s, log.ray_log_single_s):
        function.restype = ctypes.c_double
    return log


def measure(log: ctypes.CDLL, name: str, build: Callable[[], None], settings: dict[str, Any]) -> None:
    def build_half() -> None:
        build()
        render = bpy.context.scene.render
        render.resolution_x //= 2
        render.resolution_y //= 2

    pivot = renderers.Pivot(build_half, settings | {"threads": 1})
    pivot.render(1, 0)  # its BVH is built
    times_s = []
    for _ in range(REPEATS):
        start_s = time.process_time()
        image = pivot.render(SAMPLES, 0)
        times_s.append(time.process_time() - start_s)
    log.ray_log_start()
    pivot.render(SAMPLES, 0)
    log.ray_log_stop()
    samples = SAMPLES * image.shape[0] * image.shape[1]
    closest, shadow = log.ray_log_count(False), log.ray_log_count(True)
    if not closest:
        raise RuntimeError("no ray was seen: Pivot's build for this CPU traces no packets of eight")
    pivot_s, single_s, full_s = min(times_s), log.ray_log_single_s(), log.ray_log_full_packets_s()
    nanoseconds = (f"{1e9 * s / samples:8.0f}" for s in (single_s, full_s, pivot_s))
    counts = (f"{count / samples:8.2f}" for count in (closest, shadow))
    rates = (f"{1e-6 * (closest + shadow) / s:8.2f}" for s in (min(single_s, full_s), pivot_s))
    shares = (f"{100 * s / pivot_s:7.0f}%" for s in (min(single_s, full_s), log.ray_log_as_traced_s()))
    print(f"{name:20}", *counts, *nanoseconds, *rates, *shares, flush=True)


def main() -> None:
    preload()
    log = load_log()
    print(f"{'':20} {'rays a sample':>17} {'CPU ns a sample':>26} {'Mrays/s':>17} {'of bare':>8} {'Embree':>8}")
    columns = ("closest", "shadow", "single", "packets", "Pivot", "bare", "Pivot", "rate", "share")
    print(f"{'scene':20}", *(f"{column:>8}" for column in columns))
    found = scenes()
    for name in sys.argv[1:] or found:
        measure(log, name, *found[name])


if __name__ == "__main__":
    main()
