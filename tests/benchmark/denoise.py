"""Denoised pictures of Pivot and of Cycles where light bounces: FLIP against CPU seconds, the denoiser's included.

./run python tests/benchmark/denoise.py [--blender PYTHON] [--scenes NAME ...]

The scenes of indirect.py, 480 x 270, four bounces, Blender's own pixel filter, nothing clamped, no adaptive sampling.
Cycles has Open Image Denoise at high quality with albedo and normal, prefiltered accurately. Each picture is compared
with the renderer's own reference, without noise removed. Writes pictures below build/denoise and uses references there
again.
"""

from __future__ import annotations

import argparse
import functools
import hashlib
import sys
from pathlib import Path

import flip_evaluator
import indirect_scenes as scenes
import numpy as np
from indirect import BOUNCES, CYCLES
from monte_carlo_pictures import Floats, Gallery, Renderer

OUTPUT = Path(__file__).resolve().parents[2] / "build" / "denoise"
WORKER = "denoise_blender.py"
DENOISED_CYCLES = {
    "use_denoising": True,
    "denoiser": "OPENIMAGEDENOISE",
    "denoising_input_passes": "RGB_ALBEDO_NORMAL",
    "denoising_prefilter": "ACCURATE",
    "denoising_quality": "HIGH",
}
LADDER = (4, 8, 16, 32, 64)  # Pivot's samples; Cycles takes twice as many
GOOD_FLIP = 0.03


def find_renderers(python: str, percent: int) -> list[Renderer]:
    """Pivot by each setting of Denoise, then Cycles with and without. percent: of the scenes' width and height."""
    pivot = {"max_bounces": BOUNCES, "filter_glossy": 0.0, "clamp_indirect": 0.0, "percent": percent}
    found = [
        Renderer(f"pivot {mode}", "pivot", python, WORKER, pivot | {"denoise": mode})
        for mode in ("NONE", "INDIRECT", "ALL")
    ]
    cycles = CYCLES | {"use_light_tree": True, "percent": percent}
    for label, settings in (("cycles", {}), ("cycles denoised", DENOISED_CYCLES)):
        found.append(Renderer(label, "cycles", python, WORKER, cycles | settings))
    return found


@functools.cache
def scene_key(scene: str) -> str:
    described = Path(scenes.__file__).read_bytes() + scenes.DEFAULT_SCENE.read_bytes() + repr(CYCLES).encode()
    return hashlib.sha256(described).hexdigest()[:8]


def flip(image: Floats, reference: Floats) -> float:
    """Mean FLIP as sRGB shows the two."""

    def shown(linear: Floats) -> np.ndarray:
        light = np.clip(linear, 0, 1)
        curve = np.where(light <= 0.0031308, 12.92 * light, 1.055 * np.maximum(light, 1e-9) ** (1 / 2.4) - 0.055)
        return np.ascontiguousarray(curve[::-1], np.float32)

    return float(flip_evaluator.evaluate(shown(reference), shown(image), "LDR")[1])


def curve(gallery: Gallery, renderer: Renderer, scene: str, seeds: range) -> list[tuple[int, float, float]]:
    """Samples, CPU seconds and FLIP of each rung of the ladder."""
    ladder = LADDER if renderer.name == "pivot" else [2 * samples for samples in LADDER]
    pictures = {samples: [(scene, renderer.label, samples, seed) for seed in seeds] for samples in ladder}
    gallery.render(renderer, [picture for of_samples in pictures.values() for picture in of_samples])
    mean, _ = gallery.reference(renderer, scene)
    rungs = []
    for samples, of_seeds in pictures.items():
        loaded = [gallery.load(picture) for picture in of_seeds]
        rungs.append(
            (
                samples,
                float(np.median([cpu for _, cpu in loaded])),
                float(np.mean([flip(image, mean) for image, _ in loaded])),
            )
        )
        print(f"{scene:16} {renderer.label:16} {samples:4} samples {rungs[-1][1]:7.2f} CPU s  FLIP {rungs[-1][2]:.4f}")
    return rungs


def at_flip(rungs: list[tuple[int, float, float]], wanted: float) -> float:
    """CPU seconds to that FLIP, between the rungs; infinite where none is as good."""
    flips, seconds = np.array([f for _, _, f in rungs]), np.array([s for _, s, _ in rungs])
    if flips.min() > wanted:
        return np.inf
    return float(np.exp(np.interp(-wanted, -np.maximum.accumulate(flips[::-1])[::-1], np.log(seconds))))


def at_seconds(rungs: list[tuple[int, float, float]], wanted_s: float) -> float:
    """FLIP after so many CPU seconds, between the rungs."""
    seconds = np.log([s for _, s, _ in rungs])
    return float(np.exp(np.interp(np.log(wanted_s), seconds, np.log([f for _, _, f in rungs]))))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--blender", default=sys.executable, help="a Python with bpy that has Pivot")
    parser.add_argument("--scenes", nargs="+", default=list(scenes.SCENES), choices=list(scenes.SCENES))
    parser.add_argument("--seeds", type=int, default=1)
    parser.add_argument("--percent", type=int, default=100, help="of the pictures' width and height")
    parser.add_argument("--reference-samples", type=int, default=256)
    arguments = parser.parse_args()
    gallery = Gallery(
        OUTPUT / f"{arguments.percent}%", scene_key, dict.fromkeys(("pivot", "cycles"), arguments.reference_samples)
    )
    for scene in arguments.scenes:
        renderers = find_renderers(arguments.blender, arguments.percent)
        for renderer in renderers:
            if renderer.label in {"pivot NONE", "cycles"}:  # references are not denoised
                gallery.make_reference(renderer, scene)
        curves = {r.label: curve(gallery, r, scene, range(arguments.seeds)) for r in renderers}
        cycles = curves["cycles denoised"]
        for label in ("pivot INDIRECT", "pivot ALL"):
            seconds = at_flip(curves[label], GOOD_FLIP), at_flip(cycles, GOOD_FLIP)
            middle_s = cycles[2][1]
            print(
                f"{scene:16} {label}: {seconds[0]:.1f} CPU s to FLIP {GOOD_FLIP}, Cycles {seconds[1]:.1f}; FLIP after "
                f"{middle_s:.1f} s {at_seconds(curves[label], middle_s):.4f}, Cycles {cycles[2][2]:.4f}",
                flush=True,
            )


if __name__ == "__main__":
    main()
