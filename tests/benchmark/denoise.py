"""Denoised pictures of Pivot and of Cycles where light bounces: FLIP against CPU seconds, the denoiser's included.

./run python tests/benchmark/denoise.py [--blender PYTHON] [--scenes NAME ...] [--percent P] [--only RENDERER ...]

The scenes of indirect.py, 480 x 270, four bounces, Blender's own pixel filter, nothing clamped, no adaptive sampling.
Cycles has Open Image Denoise at high quality with albedo and normal, prefiltered accurately. Each picture is compared
with the renderer's own reference, without noise removed, whose own noise is told as a FLIP: half of what its halves
differ by. Writes pictures below build/denoise, uses references there again, and draws crops of all in denoise.png.
"""

from __future__ import annotations

import argparse
import functools
import hashlib
import sys
from collections.abc import Sequence
from pathlib import Path

import flip_evaluator
import indirect_scenes as scenes
import monte_carlo_table as table
import numpy as np
from indirect import BOUNCES, CYCLES
from monte_carlo_pictures import Floats, Gallery, Picture, Renderer

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
PIECE_PX, ZOOM = (60, 46), 2  # of each picture in the sheet
COLUMNS = {
    "pivot NONE": "Pivot",
    "pivot INDIRECT": "Indirect",
    "pivot ALL": "All",
    "cycles denoised": "Cycles + OIDN",
}


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


def rel_mse(image: Floats, reference: Floats) -> float:
    return float(((image - reference) ** 2 / (reference**2 + 0.01)).mean())


def pictures_of(renderer: Renderer, scene: str, ladder: Sequence[int], seeds: range) -> dict[int, list[Picture]]:
    """By Pivot's samples."""
    more = 1 if renderer.name == "pivot" else 2
    return {samples: [(scene, renderer.label, more * samples, seed) for seed in seeds] for samples in ladder}


def curve(
    gallery: Gallery, renderer: Renderer, scene: str, ladder: Sequence[int], seeds: range
) -> list[tuple[int, float, float]]:
    """Samples, CPU seconds and FLIP of each rung of the ladder."""
    mean, _ = gallery.reference(renderer, scene)
    rungs = []
    for of_seeds in pictures_of(renderer, scene, ladder, seeds).values():
        loaded, samples = [gallery.load(picture) for picture in of_seeds], of_seeds[0][2]
        cpu_s = float(np.median([cpu for _, cpu in loaded]))
        flips, errors = ([error(image, mean) for image, _ in loaded] for error in (flip, rel_mse))
        rungs.append((samples, cpu_s, float(np.mean(flips))))
        print(
            f"{scene:14} {renderer.label:16} {samples:4} samples {cpu_s:7.2f} CPU s  FLIP {rungs[-1][2]:.4f}  "
            f"relMSE {np.mean(errors):.2e}",
            flush=True,
        )
    return rungs


def reference_flip(gallery: Gallery, renderer: Renderer, scene: str) -> float:
    """Of the noise of its reference."""
    parts = [gallery.load(picture)[0] for picture in gallery.reference_pictures(renderer, scene)]
    half = len(parts) // 2
    return flip(np.mean(parts[:half], 0), np.mean(parts[half:], 0)) / 2


def write_sheet(gallery: Gallery, renderers: dict[str, Renderer], chosen: Sequence[str], samples: int) -> Path:
    """Crops of each scene's pictures with so many samples, and of Pivot's reference."""

    def zoomed(image: Floats) -> Floats:
        width, height = PIECE_PX
        x, y = (image.shape[1] - width) // 2, (image.shape[0] - height) // 2
        return image[y : y + height, x : x + width].repeat(ZOOM, axis=0).repeat(ZOOM, axis=1)

    images: dict[str, dict[str, Floats]] = {heading: {} for heading in (*COLUMNS.values(), "reference")}
    for scene in chosen:
        for label, heading in COLUMNS.items():
            picture = pictures_of(renderers[label], scene, [samples], range(1))[samples][0]
            images[heading][scene] = zoomed(gallery.load(picture)[0])
        images["reference"][scene] = zoomed(gallery.reference(renderers["pivot NONE"], scene)[0])
    file = OUTPUT / "denoise.png"
    table.write_picture(file, list(chosen), images, (PIECE_PX[0] * ZOOM, PIECE_PX[1] * ZOOM))
    return file


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
    parser.add_argument("--ladder", nargs="+", type=int, default=LADDER, help="Pivot's samples; Cycles takes twice")
    parser.add_argument("--reference-samples", nargs=2, type=int, default=(256, 256), help="Pivot's and Cycles'")
    parser.add_argument("--only", nargs="*", help="measure these renderers; of others, the last pictures, if any")
    arguments = parser.parse_args()
    references = dict(zip(("pivot", "cycles"), arguments.reference_samples, strict=True))
    gallery = Gallery(OUTPUT / f"{arguments.percent}%", scene_key, references)
    renderers, seeds = find_renderers(arguments.blender, arguments.percent), range(arguments.seeds)
    for scene in arguments.scenes:
        curves = {}
        for renderer in renderers:
            rungs = pictures_of(renderer, scene, arguments.ladder, seeds)
            pictures = [picture for of_seeds in rungs.values() for picture in of_seeds]
            if arguments.only is None or renderer.label in arguments.only:
                gallery.render(renderer, pictures)
            elif not all(gallery.file(picture).exists() for picture in pictures):
                continue
            # By one that does not denoise.
            gallery.make_reference(renderers[0] if renderer.name == "pivot" else renderers[-2], scene)
            curves[renderer.label] = curve(gallery, renderer, scene, arguments.ladder, seeds)
        for renderer in renderers[:1] + renderers[-1:]:
            print(f"{scene:14} {renderer.name} reference's noise: FLIP {reference_flip(gallery, renderer, scene):.4f}")
        cycles = curves["cycles denoised"]
        _, middle_s, of_cycles = cycles[len(cycles) // 2]
        for label in ("pivot INDIRECT", "pivot ALL"):
            seconds = at_flip(curves[label], GOOD_FLIP), at_flip(cycles, GOOD_FLIP)
            ours = at_seconds(curves[label], middle_s)
            print(
                f"{scene:14} {label}: {seconds[0]:.1f} CPU s to FLIP {GOOD_FLIP}, Cycles {seconds[1]:.1f}; FLIP after "
                f"{middle_s:.1f} s {ours:.4f}, Cycles {of_cycles:.4f}: {ours / of_cycles:.2f}",
                flush=True,
            )
    by_label = {renderer.label: renderer for renderer in renderers}
    middle = arguments.ladder[len(arguments.ladder) // 2]
    print(f"Wrote {write_sheet(gallery, by_label, arguments.scenes, middle)}")


if __name__ == "__main__":
    main()
