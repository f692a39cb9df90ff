"""Monte Carlo efficiency of Pivot, Cycles and Mitsuba where light bounces: four bounces, one pixel filter in all.

./run python tests/benchmark/indirect.py [--blender PYTHON ...] [--mitsuba PYTHON] [--scenes NAME ...]

480 x 270; nothing clamped, no filter glossy, no adaptive sampling, no denoiser; monte_carlo_pictures.py says what is
measured, and how. Cycles is the best of each Blender with the light tree on and off, path guiding on and off: all are
tried with one seed, the best two are measured with all seeds. The ratio without the worst hundredth of the pixels tells
how much of an error is a few fireflies. The means of the two references are to agree within 1 %, or the line is
flagged. References are kept in build/indirect and used again. Writes indirect.csv there, and for each scene a PNG of
both renderers' pictures and references.

The filter is Blender's own beside Cycles and a box beside Mitsuba, which shows the scenes of indirect_plain.py: its
`path` in the variant llvm_ad_rgb, with the multijitter sampler.
"""

from __future__ import annotations

import argparse
import functools
import hashlib
import sys
from pathlib import Path

import indirect_plain as plain
import indirect_scenes as scenes
import lobe_scenes as lobes
import monte_carlo_table as table
from indirect_table import print_ratios, write_sheet
from monte_carlo_filters import FILTERS
from monte_carlo_find import find_blenders, find_mitsuba, has_pivot
from monte_carlo_measure import measure
from monte_carlo_pictures import Gallery, Renderer

OUTPUT = Path(__file__).resolve().parents[2] / "build" / "indirect"
WORKER = "indirect_blender.py"
BOUNCES = 4
PIVOT = {"max_bounces": BOUNCES} | FILTERS["BLACKMAN_HARRIS"]["pivot"]
CYCLES = {f"{kind}_bounces": BOUNCES for kind in ("max", "diffuse", "glossy", "transmission")}
# Mitsuba hides lamps and the world from the camera together.
PLAIN_PIVOT = {"max_bounces": BOUNCES} | FILTERS["BOX"]["pivot"] | {"transparent_film": True}
PLAIN_MITSUBA = {"max_bounces": BOUNCES}


def find_renderers(blenders: list[str], guiding: tuple[bool, ...]) -> list[Renderer]:
    found = [Renderer("pivot", "pivot", blenders[0], WORKER, PIVOT)] if has_pivot(blenders[0]) else []
    for python, version in find_blenders(blenders).items():
        for guided in guiding:
            for tree in (True, False):
                label = f"cycles {version} {'tree' if tree else 'no tree'}{' guided' if guided else ''}"
                settings = CYCLES | {"use_light_tree": tree, "use_guiding": guided}
                found.append(Renderer(label, "cycles", python, WORKER, settings))
    return found


def find_plain_renderers(blender: str, mitsuba: str) -> list[Renderer]:
    """Pivot and Mitsuba, where both are there."""
    version = find_mitsuba(mitsuba)
    if version is None or not has_pivot(blender):
        return []
    return [
        Renderer("pivot", "pivot", blender, WORKER, PLAIN_PIVOT),
        Renderer(f"mitsuba {version}", "mitsuba", mitsuba, "indirect_mitsuba.py", PLAIN_MITSUBA),
    ]


@functools.cache
def scene_key(scene: str) -> str:
    """One for all, and one for all that are plain: they share their builders."""
    described = Path(scenes.__file__).read_bytes() + scenes.DEFAULT_SCENE.read_bytes()
    if scene in lobes.SCENES:
        described += Path(lobes.__file__).read_bytes()
    if scene in plain.SCENES:
        described += Path(plain.__file__).read_bytes() + repr((PLAIN_PIVOT, PLAIN_MITSUBA)).encode()
    else:
        described += repr((PIVOT, CYCLES)).encode()
    return hashlib.sha256(described).hexdigest()[:8]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--blender", nargs="+", default=[sys.executable], help="Pythons with bpy; the first has Pivot")
    parser.add_argument("--mitsuba", default=sys.executable, help="a Python with mitsuba and bpy")
    parser.add_argument("--scenes", nargs="+", default=list(scenes.SCENES), choices=[*scenes.SCENES, *lobes.SCENES])
    parser.add_argument("--samples", type=int, default=16)
    parser.add_argument("--seeds", type=int, default=3)
    parser.add_argument("--reference-samples", type=int, default=256)
    parser.add_argument("--quick", action="store_true", help="one seed, a quarter of the reference, no path guiding")
    parser.add_argument("--only", nargs="+", help="measure these renderers; of others, the last pictures")
    arguments = parser.parse_args()
    guiding: tuple[bool, ...] = (False, True)
    if arguments.quick:
        arguments.seeds, arguments.reference_samples, guiding = 1, arguments.reference_samples // 4, (False,)
    gallery = Gallery(OUTPUT, scene_key, dict.fromkeys(("pivot", "cycles", "mitsuba"), arguments.reference_samples))
    rows_of = {}  # each peer's
    for peer, suffix, renderers in (
        ("cycles", "", find_renderers(arguments.blender, guiding)),
        ("mitsuba", "-plain", find_plain_renderers(arguments.blender[0], arguments.mitsuba)),
    ):
        rows = []
        for name in arguments.scenes:
            if suffix and name + suffix not in plain.SCENES:
                continue
            found = measure(gallery, renderers, name + suffix, arguments)
            if found:
                rows += found
                write_sheet(gallery, renderers, found, peer, OUTPUT, (scenes.WIDTH, scenes.HEIGHT))
        rows_of[peer] = renderers, rows
    all_rows = [row for _, rows in rows_of.values() for row in rows]
    if not all_rows:
        return
    table.write_csv(OUTPUT / "indirect.csv", all_rows)
    for peer, (renderers, rows) in rows_of.items():
        print_ratios(gallery, dict.fromkeys((row["scene"] for row in rows), renderers), rows, peer)


if __name__ == "__main__":
    main()
