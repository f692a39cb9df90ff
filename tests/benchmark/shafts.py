"""Light shafts by Pivot and by Cycles in the same CPU time: writes shafts.png here, Pivot above.

./run python tests/benchmark/shafts.py [--blender PYTHON ...] [--samples N]

Two bounces; no denoiser and nothing clamped. Cycles is the best of what fog.py tries, by a small picture of the scene.
"""

from __future__ import annotations

import argparse
import hashlib
import sys
from pathlib import Path

import fog
import fog_scenes
import monte_carlo_table as table
import shafts_scene as scene
from monte_carlo_find import find_blenders
from monte_carlo_pictures import Gallery, Renderer

HERE = Path(__file__).resolve().parent
BUILDERS = (HERE / "shafts_scene.py", *fog.BUILDERS)
TRIED_SAMPLES, REFERENCE_SAMPLES = 8, 256
SETTINGS = fog_scenes.FogScene(lambda: None, scene.BOUNCES, several_lights=True)


def scene_key(name: str) -> str:
    return hashlib.sha256(b"".join(file.read_bytes() for file in BUILDERS)).hexdigest()[:8]


def most_efficient(gallery: Gallery, renderers: list[Renderer]) -> tuple[Renderer, float]:
    """And its CPU seconds a sample of the whole picture."""
    found = []
    for renderer in renderers:
        gallery.make(renderer, "small shafts", TRIED_SAMPLES, range(1), again=True)
        found.append((gallery.measure(renderer, "small shafts", TRIED_SAMPLES, range(1)), renderer))
        table.print_row(found[-1][0])
    row, best = max(found, key=lambda pair: pair[0]["efficiency"])
    return best, row["CPU s"] / TRIED_SAMPLES * (100 / scene.SIZES["small shafts"]) ** 2


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--blender", nargs="+", default=[sys.executable], help="Pythons with bpy; the first has Pivot")
    parser.add_argument("--samples", type=int, default=64, help="of Pivot")
    arguments = parser.parse_args()
    gallery = Gallery(fog.OUTPUT, scene_key, {"cycles": REFERENCE_SAMPLES})
    theirs, sample_s = most_efficient(gallery, fog.cycles_renderers(find_blenders(arguments.blender), SETTINGS))
    ours = fog.pivot_renderers(arguments.blender[0], SETTINGS)[0]
    picture = ("shafts", ours.label, arguments.samples, 0)
    gallery.render(ours, [picture])
    image, cpu_s = gallery.load(picture)
    other = ("shafts", theirs.label, max(1, round(cpu_s / sample_s)), 0)
    gallery.render(theirs, [other])
    other_image, other_cpu_s = gallery.load(other)
    for label, samples, seconds in ((*picture[1:3], cpu_s), (*other[1:3], other_cpu_s)):
        print(f"{label}: {samples} samples, {seconds:.0f} s of CPU")
    labels = {"Pivot": image, theirs.label.replace("cycles", "Cycles"): other_image}
    table.write_picture(HERE / "shafts.png", list(labels), {"": labels}, (scene.WIDTH, scene.HEIGHT))


if __name__ == "__main__":
    main()
