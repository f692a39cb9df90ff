"""Monte Carlo efficiency of Pivot, Cycles and Mitsuba on one set of scenes: direct light, no denoiser, nothing clamped.

./run python tests/benchmark/monte_carlo.py [--blender PYTHON ...] [--mitsuba PYTHON] [--scenes NAME ...] [--filter BOX]

monte_carlo_pictures.py says what is measured, and how; of Cycles all variants are tried with one seed, the best two
with adaptive sampling and without are measured with all. Beside the scenes of monte_carlo_scenes.py stands the default
scene, and 10, 100 and 1000 lights of one total power. The pixel filter is Blender's default in Pivot and Cycles;
Mitsuba has none like it and is compared with --filter BOX. References are kept in build/monte_carlo, each filter's in a
folder of its own, and used again; --seeds 0 makes those alone. Writes monte_carlo.csv and monte_carlo.png there; says
which renderers it skips. monte_carlo_rays.py beside it compares with bare Embree.
"""

from __future__ import annotations

import argparse
import hashlib
import sys
from pathlib import Path
from typing import Any

import indirect_scenes
import monte_carlo_scenes as scenes
import monte_carlo_table as table
import numpy as np
from monte_carlo_filters import DIRECT_LIGHT, FILTERS
from monte_carlo_find import find_blenders, find_mitsuba, has_pivot
from monte_carlo_measure import means, measure
from monte_carlo_pictures import Gallery, Renderer
from numpy.typing import NDArray

OUTPUT = Path(__file__).resolve().parents[2] / "build" / "monte_carlo"
WORKER = "monte_carlo_blender.py"
DEFAULT = "default"  # of indirect_scenes.py: not among those that are data
NAMES = [DEFAULT, *scenes.SCENES]
PIECE_PX = (240, 180)  # of the middle of each image
PIVOT_CEILING = 32  # times the samples of plain sampling; Cycles, whose threshold is met late, has 4
PIVOT_ADAPTIVE = {"adaptive": True, "error_budget_percent": 1.0}
CYCLES_ADAPTIVE = {"use_adaptive_sampling": True, "adaptive_threshold": 0.01, "adaptive_min_samples": 0}


def renders(renderer: Renderer, scene: str) -> bool:
    """Under many lamps the best alone: joint sampling and light trees."""
    if scene in scenes.LAMPS and renderer.label != "pivot":
        return bool(renderer.settings.get("use_light_tree")) and not renderer.adaptive
    peers = ("cycles",) if scene == DEFAULT else scenes.SCENES[scene].peers
    return renderer.name == "pivot" or renderer.name in peers


def find_renderers(blenders: list[str], mitsuba: str, pixel_filter: str) -> list[Renderer]:
    settings_of = FILTERS[pixel_filter]
    found = []
    if has_pivot(blenders[0]):
        for label, settings in {
            "pivot": {},
            "pivot adaptive": PIVOT_ADAPTIVE,
            "pivot MIS": {"light_sampling": "MIS"},
            "pivot SPTD": {"light_sampling": "SPTD"},
        }.items():
            settings = DIRECT_LIGHT | settings_of["pivot"] | settings
            found.append(Renderer(label, "pivot", blenders[0], WORKER, settings, PIVOT_CEILING))
    for python, version in find_blenders(blenders).items():
        for adaptive, sampling in (("", {}), (" adaptive", CYCLES_ADAPTIVE)):
            for tree in (True, False):
                label = f"cycles {version}{'' if tree else ' no'} tree{adaptive}"
                settings = DIRECT_LIGHT | settings_of["cycles"] | {"use_light_tree": tree} | sampling
                found.append(Renderer(label, "cycles", python, WORKER, settings))
    if "mitsuba" not in settings_of:
        print("skipped: Mitsuba, which shares no pixel filter with Blender but the box: --filter BOX")
        return found
    version = find_mitsuba(mitsuba)
    if version is not None:
        label = f"mitsuba {version}"
        found.append(Renderer(label, "mitsuba", mitsuba, "monte_carlo_mitsuba.py", settings_of["mitsuba"]))
    return found


def scene_key(scene: str) -> str:
    described = indirect_scenes.DEFAULT_SCENE.read_bytes() if scene == DEFAULT else repr(scenes.SCENES[scene]).encode()
    return hashlib.sha256(described).hexdigest()[:8]


def write_picture(gallery: Gallery, rows: list[dict[str, Any]]) -> None:
    """One seed of every picture measured."""
    images: dict[str, dict[str, NDArray[np.float64]]] = {}
    for row in rows:
        scene, label = row["scene"], row["renderer"]
        images.setdefault(label, {})[scene] = gallery.load((scene, label, row["samples"], 0))[0]
    names = list(dict.fromkeys(row["scene"] for row in rows))
    table.write_picture(gallery.folder / "monte_carlo.png", names, images, PIECE_PX)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--blender", nargs="+", default=[sys.executable], help="Pythons with bpy; the first has Pivot")
    parser.add_argument("--mitsuba", default=sys.executable, help="a Python with mitsuba")
    parser.add_argument("--scenes", nargs="+", default=NAMES, choices=NAMES)
    parser.add_argument("--filter", default="BLACKMAN_HARRIS", choices=list(FILTERS), help="of pixels")
    parser.add_argument("--samples", type=int, default=32)
    parser.add_argument("--seeds", type=int, default=3)
    parser.add_argument("--only", nargs="+", help="measure these renderers; of others, the last pictures")
    arguments = parser.parse_args()
    renderers = find_renderers(arguments.blender, arguments.mitsuba, arguments.filter)
    gallery = Gallery(OUTPUT / arguments.filter.lower(), scene_key, {"pivot": 512, "cycles": 256, "mitsuba": 512})
    rows = []
    for scene in arguments.scenes:
        rows += measure(gallery, [r for r in renderers if renders(r, scene)], scene, arguments)
    if not rows:
        return
    table.write_csv(gallery.folder / "monte_carlo.csv", rows)
    table.print_table(rows)
    under_lamps = [row for row in rows if row["scene"] in scenes.LAMPS]
    others = [row for row in rows if row not in under_lamps]
    if others:
        table.print_ratios(others)
        write_picture(gallery, others)
    if under_lamps:
        table.print_growth(under_lamps)
    print("\nPivot's mean over Cycles', of the references")
    for scene, found in table.by_scene(rows).items():
        if "pivot" in found and table.best(found, "cycles"):
            print(f"{scene:20} {means(gallery, renderers, scene, 'cycles')}")


if __name__ == "__main__":
    main()
