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
from monte_carlo_filters import DIRECT_LIGHT, FILTERS
from monte_carlo_find import find_blenders, has_pivot
from monte_carlo_pictures import FOLDER
from numpy.typing import NDArray
from pivot.chart.pixels import write_png

OUTPUT = FOLDER.parents[1] / "build" / "material_speed"
MATERIALS = ("constants", "images", "procedural")
LIGHT: dict[str, dict[str, dict[str, Any]]] = {
    "direct": {name: FILTERS["BOX"][name] | DIRECT_LIGHT for name in ("pivot", "cycles")},
    "bounces": {
        "pivot": FILTERS["BOX"]["pivot"] | {"max_bounces": indirect.BOUNCES},
        "cycles": FILTERS["BOX"]["cycles"] | indirect.CYCLES,
    },
}
SIDE_PX = 2048

Floats = NDArray[np.float64]
Made = dict[tuple[str, int], tuple[Floats, float]]  # by material and samples: a picture and its CPU seconds


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


def render(python: str, name: str, light: str, counts: tuple[int, int], seed: int) -> Made:
    """In a process of that Python."""
    keys = [(material, count) for material in MATERIALS for count in counts]
    files = [OUTPUT / f"{name}-{material}-{count}.npz" for material, count in keys]
    jobs = [
        {"scene": material, "renderer": name, "settings": LIGHT[light][name]}
        | {"samples": count, "seed": seed, "file": str(file)}
        for (material, count), file in zip(keys, files, strict=True)
    ]
    worker = [python, str(FOLDER / "material_speed_blender.py"), str(OUTPUT)]
    environment = os.environ | {"PYTHONPATH": str(FOLDER)}
    subprocess.run(worker, check=True, input=json.dumps(jobs), text=True, stdout=subprocess.DEVNULL, env=environment)
    made = {}
    for key, file in zip(keys, files, strict=True):
        with np.load(file) as data:
            made[key] = data["image"].astype(np.float64), float(data["cpu_s"])
        file.unlink()
    return made


def cost_s(runs: list[Made], material: str, counts: tuple[int, int]) -> float:
    """A sample's."""
    few_s, many_s = (min(made[material, count][1] for made in runs) for count in counts)
    return (many_s - few_s) / (counts[1] - counts[0])


def print_rows(light: str, runs: dict[str, list[Made]], counts: tuple[int, int]) -> None:
    """Each Blender's Cycles beside Pivot."""
    for label in list(runs)[1:]:
        constants = None
        for material in MATERIALS:
            ours_s, theirs_s = (cost_s(runs[of], material, counts) for of in ("pivot", label))
            ours, theirs = (runs[of][0][material, counts[1]][0].mean() for of in ("pivot", label))
            ratio = theirs_s / ours_s
            constants = constants or ratio
            figures = f"{ours_s:8.3f} {theirs_s:8.3f} {ratio:8.2f} {ratio / constants:10.2f} {ours / theirs:12.4f}"
            print(f"{light:8} {material:11} {label:12} {figures}", flush=True)


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
    renderers = {"pivot": (arguments.blender[0], "pivot")}
    renderers |= {f"cycles {version}": (python, "cycles") for python, version in blenders.items()}
    counts = arguments.samples // 4, arguments.samples
    titles = f"{'Pivot':>8} {'Cycles':>8} {'C : P':>8} {'lead kept':>10} {'means P : C':>12}"
    print(f"CPU s a sample\n{'light':8} {'material':11} {'Cycles':12} {titles}", flush=True)
    for light in LIGHT:
        runs: dict[str, list[Made]] = {label: [] for label in renderers}
        for seed in range(arguments.runs):  # in turns, so that a busy machine is so for all
            for label, (python, name) in renderers.items():
                runs[label].append(render(python, name, light, counts, seed))
        print_rows(light, runs, counts)
        images = {label: {m: made[0][m, counts[1]][0] for m in MATERIALS} for label, made in runs.items()}
        table.write_picture(OUTPUT / f"{light}.png", list(MATERIALS), images, (scenes.WIDTH, scenes.HEIGHT))


if __name__ == "__main__":
    main()
