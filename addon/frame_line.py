"""The line that a frame ends with on a terminal: what rendered it, how far it came, and what it took."""

from __future__ import annotations

import time
from dataclasses import dataclass, field

import bpy

from .memory import peak_bytes
from .properties import INTEGRATORS


@dataclass
class FrameCount:
    """What one frame takes, from its start on: each view layer and view adds to it."""

    began_s: float = field(default_factory=time.monotonic)
    began_cpu_s: float = field(default_factory=time.process_time)
    samples_done: list[int] = field(default_factory=list)
    samples: int = 0  # the most that a layer asks for
    virtual_lights: list[tuple[int, int, float]] = field(default_factory=list)  # of each picture that has any
    warnings: set[str] = field(default_factory=set)


def frame_line(scene: bpy.types.Scene, count: FrameCount) -> str:
    """ "Pivot | Frame 3 | Monte Carlo | 64 samples | 12.3 s | 23.1 s CPU | 812 MB peak | 2 warnings"."""
    integrator = next(name for key, name, _ in INTEGRATORS if key == scene.pivot.integrator)
    done = min(count.samples_done, default=0)
    of = "" if done == count.samples else f" of {count.samples}"
    peak_mb = peak_bytes() / 1e6
    parts = [
        f"Frame {scene.frame_current}",
        integrator,
        f"{done}{of} {_plural(count.samples, 'sample')}",
        f"{time.monotonic() - count.began_s:.1f} s",
        f"{time.process_time() - count.began_cpu_s:.1f} s CPU",
        f"{peak_mb:.0f} MB peak",
        *_virtual_lights(count),
        f"{len(count.warnings)} {_plural(len(count.warnings), 'warning')}",
    ]
    return " | ".join(["Pivot", *parts])


def other_engine_line(scene: bpy.types.Scene, command_line: list[str]) -> str | None:
    """What to say where another engine renders although the command line speaks of Pivot."""
    if scene.render.engine == "PIVOT" or not {"pivot", "PIVOT"} & set(command_line):
        return None
    return (
        f"Warning: scene '{scene.name}' is rendered by {scene.render.engine}, not by Pivot. "
        "Fix: put -E PIVOT after the .blend and -S, and before -f or -a"
    )


def _virtual_lights(count: FrameCount) -> list[str]:
    """What they were and how long they took to make, where there are any."""
    if not count.virtual_lights:
        return []
    lights = sum(lights for lights, _, _ in count.virtual_lights)
    build_s = sum(seconds for _, _, seconds in count.virtual_lights)
    return [f"{lights} virtual lights in {build_s:.2f} s"]


def _plural(count: int, noun: str) -> str:
    return noun if count == 1 else f"{noun}s"
