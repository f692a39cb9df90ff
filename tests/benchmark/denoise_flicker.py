"""How denoised pictures flicker while the camera moves: the default scene, 24 frames, Pivot and Cycles 4.5.

./run python tests/benchmark/denoise_flicker.py [--samples N] [--percent P] [--frames F]

The camera goes sideways, 1 cm a frame. Pivot by each setting of Denoise, with noise of its own in each frame and with
one for all; Cycles with Open Image Denoise as in denoise.py and twice the samples, likewise. Flicker is the mean of how
much a pixel changes from frame to frame beyond what the reference does, over the mean radiance. The reference
has 16 times the samples of that renderer, and is denoised.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable
from typing import Any

import bpy

# isort: split
import denoise_blender as renderers
import indirect_scenes as scenes
import numpy as np
from denoise import DENOISED_CYCLES
from indirect import BOUNCES, CYCLES
from mathutils import Vector
from numpy.typing import NDArray

Floats = NDArray[np.float32]
STEP_M = 0.01
MORE_OF_REFERENCE = 16


def moving_scene() -> None:
    scenes.SCENES["default"]()
    scene = bpy.context.scene
    camera: Any = scene.camera
    sideways = camera.matrix_world.to_3x3() @ Vector((1.0, 0.0, 0.0))
    start = camera.location.copy()
    for frame in (1, 101):
        camera.location = start + (frame - 1) * STEP_M * sideways
        camera.keyframe_insert("location", frame=frame)
    for curve in camera.animation_data.action.fcurves:
        for key in curve.keyframe_points:
            key.interpolation = "LINEAR"


def film(renderer: Any, samples: int, frames: int) -> Floats:
    """(frames, height, width, 3)."""
    pictures = []
    for frame in range(1, frames + 1):
        bpy.context.scene.frame_set(frame)
        pictures.append(renderer.render(samples, 0))
    return np.stack(pictures)


def flicker(shown: Floats, reference: Floats) -> float:
    beyond = np.diff(shown, axis=0) - np.diff(reference, axis=0)
    return float(np.abs(beyond).mean() / reference.mean())


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--samples", type=int, default=16, help="Pivot's; Cycles takes twice as many")
    parser.add_argument("--percent", type=int, default=50, help="of 480 x 270")
    parser.add_argument("--frames", type=int, default=24)
    arguments = parser.parse_args()
    seeds = (True, False)
    pivot = {"max_bounces": BOUNCES, "denoise": "INDIRECT", "percent": arguments.percent}
    cycles = CYCLES | DENOISED_CYCLES | {"use_light_tree": True, "percent": arguments.percent}
    by_mode = [{"denoise": mode, "animate_seed": seed} for mode in ("NONE", "INDIRECT", "ALL") for seed in seeds]
    denoised = [{"use_animated_seed": seed} for seed in seeds]
    engines: list[tuple[str, Callable[..., Any], dict[str, Any], list[dict[str, Any]], int]] = [
        ("pivot", renderers.Pivot, pivot, by_mode, arguments.samples),
        ("cycles", renderers.Cycles, cycles, denoised, 2 * arguments.samples),
    ]
    for label, renderer_of, settings, variants, samples in engines:
        renderer = renderer_of(moving_scene, settings)
        renderer.render(1, 0)  # kernels are loaded
        reference = film(renderer, MORE_OF_REFERENCE * samples, arguments.frames)
        for variant in variants:
            for name, value in variant.items():
                setattr(getattr(bpy.context.scene, label), name, value)
            shown = film(renderer, samples, arguments.frames)
            said = ", ".join(f"{name} {value}" for name, value in variant.items())
            print(
                f"{label:7} {samples:4} samples  {said:40} flicker {100 * flicker(shown, reference):6.2f} %", flush=True
            )


if __name__ == "__main__":
    main()
