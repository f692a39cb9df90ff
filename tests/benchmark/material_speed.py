"""What textures cost: CPU seconds a sample of Pivot and Cycles, the balls of monte_carlo.py in three kinds of material.

./run python tests/benchmark/material_speed.py [--blender PYTHON ...]

Constants; an image on base colour, roughness and normal of every surface; base colour and roughness by a tree of 30
procedural textures (material_speed_blender.py). 640 x 360, box filter, direct light and again four bounces, Cycles with
its light tree. CPU seconds of the render alone, by the difference of two sample counts, of each the least of --runs.
C : P is their ratio, the lead kept that ratio over the constants', means P : C that of the pictures' means. Writes what
both made to direct.png and bounces.png in build/material_speed.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
from typing import Any

import indirect
import monte_carlo_scenes as scenes
import monte_carlo_table as table
import numpy as np
from monte_carlo_pictures import FOLDER, find_blenders, has_pivot
from numpy.typing import NDArray
from pivot.chart.pixels import write_png

OUTPUT = FOLDER.parents[1] / "build" / "material_speed"
MATERIALS = ("constants", "images", "procedural")
LIGHT: dict[str, dict[str, dict[str, Any]]] = {
    "direct": scenes.DIRECT_LIGHT,
    "bounces": {
        "pivot": scenes.DIRECT_LIGHT["pivot"] | {"max_bounces": indirect.BOUNCES},
        "cycles": scenes.DIRECT_LIGHT["cycles"] | indirect.CYCLES,
    },
}
SIDE_PX = 2048

Floats = NDArray[np.float64]
Made = tuple[Floats, float]  # a picture, and CPU seconds a sample


def write_textures() -> None:
    """One of each use, without seams."""
    u = np.arange(SIDE_PX) * (2 * np.pi / SIDE_PX)
    x, y = np.meshgrid(u, u)
    height = sum(np.sin(n * x + 2 * np.sin(n * y)) * np.cos(n * y + n) / n for n in (4, 9, 23, 61))
    slope_y, slope_x = np.gradient(height, 2 * np.pi / SIDE_PX)
    normal = np.stack([-slope_x, -slope_y, np.full_like(x, 12.0)], -1)
    normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
    bright = np.clip(0.5 + 0.7 * height, 0, 1)[..., None]
    textures = {
        "color": bright * (0.95, 0.8, 0.55) + (1 - bright) * (0.3, 0.45, 0.7),
        "roughness": np.repeat(0.6 + 0.4 * bright, 3, -1),
        "normal": 0.5 + 0.5 * normal,
    }
    for name, texels in textures.items():
        write_png(OUTPUT / f"{name}.png", np.round(255 * texels).astype(np.uint8))


def make(python: str, name: str, light: str, samples: int, runs: int) -> dict[str, Made]:
    """By material; all in one process of that Python."""
    counts = (samples // 4, samples)
    files = {
        (material, count, run): OUTPUT / f"{name}-{material}-{count}-{run}.npz"
        for material in MATERIALS
        for run in range(runs)
        for count in counts
    }
    jobs = [
        {"scene": material, "renderer": name, "settings": LIGHT[light][name]}
        | {"samples": count, "seed": run, "file": str(file)}
        for (material, count, run), file in files.items()
    ]
    worker = [python, str(FOLDER / "material_speed_blender.py"), str(OUTPUT)]
    environment = os.environ | {"PYTHONPATH": str(FOLDER)}
    subprocess.run(worker, check=True, input=json.dumps(jobs), text=True, stdout=subprocess.DEVNULL, env=environment)
    made = {}
    for material in MATERIALS:
        least_s = [min(float(np.load(files[material, count, run])["cpu_s"]) for run in range(runs)) for count in counts]
        picture = np.load(files[material, samples, 0])["image"].astype(np.float64)
        made[material] = picture, (least_s[1] - least_s[0]) / (samples - counts[0])
    for file in files.values():
        file.unlink()
    return made


def print_row(light: str, material: str, made: dict[str, dict[str, Made]], label: str) -> None:
    """Of Cycles in one Blender beside Pivot."""

    def ratio(material: str) -> float:
        return made[label][material][1] / made["pivot"][material][1]

    (ours, our_s), (theirs, their_s) = made["pivot"][material], made[label][material]
    figures = f"{our_s:8.3f} {their_s:8.3f} {ratio(material):9.2f} {ratio(material) / ratio('constants'):10.2f}"
    print(f"{light:8} {material:11} {label:12} {figures} {ours.mean() / theirs.mean():12.4f}", flush=True)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--blender", nargs="+", default=[sys.executable], help="Pythons with bpy; the first has Pivot")
    parser.add_argument("--samples", type=int, default=16)
    parser.add_argument("--runs", type=int, default=3)
    arguments = parser.parse_args()
    blenders = find_blenders(arguments.blender)
    if not has_pivot(arguments.blender[0]) or not blenders:
        return
    OUTPUT.mkdir(parents=True, exist_ok=True)
    write_textures()
    titles = f"{'Pivot':>8} {'Cycles':>8} {'C : P':>9} {'lead kept':>10} {'means P : C':>12}"
    print(f"CPU s a sample\n{'light':8} {'material':11} {'Cycles of':12} {titles}")
    for light in LIGHT:
        made = {"pivot": make(arguments.blender[0], "pivot", light, arguments.samples, arguments.runs)}
        for python, version in blenders.items():
            label = f"cycles {version}"
            made[label] = make(python, "cycles", light, arguments.samples, arguments.runs)
            for material in MATERIALS:
                print_row(light, material, made, label)
        images = {label: {material: picture for material, (picture, _) in of.items()} for label, of in made.items()}
        table.write_picture(OUTPUT / f"{light}.png", list(MATERIALS), images, (scenes.WIDTH, scenes.HEIGHT))


if __name__ == "__main__":
    main()
