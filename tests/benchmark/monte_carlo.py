"""Monte Carlo efficiency of Pivot, Cycles and Mitsuba on one set of scenes: direct light, no denoiser, box filter.

./run python tests/benchmark/monte_carlo.py [--blender PYTHON ...] [--mitsuba PYTHON] [--scenes NAME ...]

monte_carlo_pictures.py says what is measured, and how. Then the same for 10, 100 and 1000 lights of one total power.
References are kept in build/monte_carlo and used again; --seeds 0 makes those alone. Writes monte_carlo.csv and
monte_carlo.png there; says which renderers it skips. monte_carlo_rays.py beside it compares with bare Embree.
"""

from __future__ import annotations

import argparse
import hashlib
import sys
from pathlib import Path
from typing import Any

import monte_carlo_scenes as scenes
import monte_carlo_table as table
import numpy as np
from monte_carlo_pictures import Gallery, Renderer, find_blenders, find_mitsuba, has_pivot
from numpy.typing import NDArray

OUTPUT = Path(__file__).resolve().parents[2] / "build" / "monte_carlo"
PIECE_PX = (240, 180)  # of the middle of each image


def renders(renderer: Renderer, scene: str) -> bool:
    """Under many lamps the best alone: joint sampling and light trees."""
    if scene in scenes.LAMPS and not (renderer.label == "pivot" or renderer.settings.get("use_light_tree")):
        return False
    return renderer.name == "pivot" or renderer.name in scenes.SCENES[scene].peers


def find_renderers(blenders: list[str], mitsuba: str) -> list[Renderer]:
    found = []
    if has_pivot(blenders[0]):
        for label, settings in {
            "pivot": {},
            "pivot adaptive": {"adaptive": True, "error_budget_percent": 2.0},
            "pivot MIS": {"light_sampling": "MIS"},
            "pivot SPTD": {"light_sampling": "SPTD"},
        }.items():
            settings = scenes.DIRECT_LIGHT["pivot"] | settings
            found.append(Renderer(label, "pivot", blenders[0], "monte_carlo_blender.py", settings))
    for python, version in find_blenders(blenders).items():
        for tree in (True, False):
            label = f"cycles {version} {'tree' if tree else 'no tree'}"
            settings = scenes.DIRECT_LIGHT["cycles"] | {"use_light_tree": tree}
            found.append(Renderer(label, "cycles", python, "monte_carlo_blender.py", settings))
    version = find_mitsuba(mitsuba)
    if version is not None:
        label = f"mitsuba {version}"
        found.append(Renderer(label, "mitsuba", mitsuba, "monte_carlo_mitsuba.py", {}))
    return found


def scene_key(scene: str) -> str:
    return hashlib.sha256(repr(scenes.SCENES[scene]).encode()).hexdigest()[:8]


GALLERY = Gallery(OUTPUT, scene_key, {"pivot": 512, "cycles": 256, "mitsuba": 512})


def write_picture(renderers: list[Renderer], rows: list[dict[str, Any]], samples: int) -> None:
    """One seed of every picture measured."""
    images: dict[str, dict[str, NDArray[np.float64]]] = {}
    counts = {renderer.label: renderer.counts(samples)[1] for renderer in renderers}
    for row in rows:
        scene, label = row["scene"], row["renderer"]
        images.setdefault(label, {})[scene] = GALLERY.load((scene, label, counts[label], 0))[0]
    names = list(dict.fromkeys(row["scene"] for row in rows))
    table.write_picture(OUTPUT / "monte_carlo.png", names, images, PIECE_PX)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--blender", nargs="+", default=[sys.executable], help="Pythons with bpy; the first has Pivot")
    parser.add_argument("--mitsuba", default=sys.executable, help="a Python with mitsuba")
    parser.add_argument("--scenes", nargs="+", default=list(scenes.SCENES), choices=list(scenes.SCENES))
    parser.add_argument("--samples", type=int, default=32)
    parser.add_argument("--seeds", type=int, default=3)
    parser.add_argument("--only", nargs="+", help="measure these renderers; of others, the last pictures")
    arguments = parser.parse_args()
    renderers = find_renderers(arguments.blender, arguments.mitsuba)
    rows = []
    for scene in arguments.scenes:
        for renderer in renderers:
            if not renders(renderer, scene):
                continue
            again = not arguments.only or renderer.label in arguments.only
            seeds = range(arguments.seeds)
            if not GALLERY.make(renderer, scene, arguments.samples, seeds, again) or not seeds:
                continue
            rows.append(GALLERY.measure(renderer, scene, arguments.samples, seeds))
            table.print_row(rows[-1])
    if not rows:
        return
    table.write_csv(OUTPUT / "monte_carlo.csv", rows)
    table.print_table(rows)
    under_lamps = [row for row in rows if row["scene"] in scenes.LAMPS]
    others = [row for row in rows if row not in under_lamps]
    if others:
        table.print_ratios(others)
        write_picture(renderers, others, arguments.samples)
    if under_lamps:
        table.print_growth(under_lamps)


if __name__ == "__main__":
    main()
