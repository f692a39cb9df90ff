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
import math
import sys
from collections.abc import Mapping
from pathlib import Path

import indirect_plain as plain
import indirect_scenes as scenes
import monte_carlo_table as table
import numpy as np
from monte_carlo_pictures import Gallery, Renderer, find_blenders, find_mitsuba, has_pivot

OUTPUT = Path(__file__).resolve().parents[2] / "build" / "indirect"
WORKER = "indirect_blender.py"
BOUNCES = 4
PIVOT = {"max_bounces": BOUNCES, "filter_width_px": 3.0}  # Blender's Filter Size of 1.5: see addon/settings.py
CYCLES = {f"{kind}_bounces": BOUNCES for kind in ("max", "diffuse", "glossy")}
# Mitsuba hides lamps and the world from the camera together.
PLAIN_PIVOT = {"max_bounces": BOUNCES, "pixel_filter": "BOX", "filter_width_px": 1.0, "transparent_film": True}
PLAIN_MITSUBA = {"max_bounces": BOUNCES}
MEASURED = 2  # of Cycles' variants
MEAN_TOLERANCE = 0.01


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
    if scene in plain.SCENES:
        described += Path(plain.__file__).read_bytes() + repr((PLAIN_PIVOT, PLAIN_MITSUBA)).encode()
    else:
        described += repr((PIVOT, CYCLES)).encode()
    return hashlib.sha256(described).hexdigest()[:8]


def measure(gallery: Gallery, renderers: list[Renderer], scene: str, arguments: argparse.Namespace) -> list[table.Row]:
    """A row of each renderer, of Cycles the best, with all seeds. One without pictures is left out."""

    def rows(wanted: list[Renderer], seeds: range) -> list[tuple[Renderer, table.Row]]:
        found = []
        for renderer in wanted:
            again = not arguments.only or renderer.label in arguments.only
            if gallery.make(renderer, scene, arguments.samples, seeds, again):
                every = range(seeds.stop)  # those before were made before
                found.append((renderer, gallery.measure(renderer, scene, arguments.samples, every)))
                table.print_row(found[-1][1])
        return found

    others = rows([renderer for renderer in renderers if renderer.name != "cycles"], range(arguments.seeds))
    tried = rows([renderer for renderer in renderers if renderer.name == "cycles"], range(1))
    tried.sort(key=lambda pair: -pair[1]["efficiency"])
    best = tried[:MEASURED]
    if arguments.seeds > 1:
        best = rows([renderer for renderer, _ in best], range(1, arguments.seeds))
    return [row for _, row in others + best]


def print_ratios(
    gallery: Gallery, renderers_of: Mapping[str, list[Renderer]], rows: list[table.Row], peer: str
) -> None:
    """Each scene's line, then the geometric mean and the least of the efficiency's ratio over the best of a peer.

    renderers_of: by scene.
    """
    compared = {}
    for scene, found in table.by_scene(rows).items():
        best = table.best(found, peer)
        if "pivot" in found and best:
            compared[scene] = found["pivot"], best[peer]
    if not compared:
        return
    name = peer.capitalize()
    wide = 1 + max(map(len, ("geometric mean", *compared)))
    label = 1 + max(len(theirs["renderer"]) for _, theirs in compared.values())
    for line in (
        f"\n{'':{wide}}{'times':>7} {'without':>8}  {'':{label}}{'CPU s a sample':>15} {'relMSE':>17}"
        f" {'of references':>17} {'means':>7}",
        f"{'scene':{wide}}{name:>7} {'worst 1%':>8}  {f'best {name}':{label}}{f'Pivot {name:>7}':>15}"
        f" {f'Pivot  {name:>7}':>17} {f'Pivot  {name:>7}':>17} {f'P / {name[0]}':>7}",
    ):
        print(line)
    ratios = []
    for scene, (ours, theirs) in compared.items():
        ratios.append(ours["efficiency"] / theirs["efficiency"])
        cost = theirs["CPU s"] / ours["CPU s"]
        trimmed = cost * theirs["relMSE without the worst"] / ours["relMSE without the worst"]
        each = [f"{ours[name]:8.2e} {theirs[name]:8.2e}" for name in ("relMSE", "relMSE of the reference")]
        per_sample = f"{ours['CPU s'] / ours['samples']:7.3f} {theirs['CPU s'] / theirs['samples']:7.3f}"
        print(
            f"{scene:{wide}}{ratios[-1]:7.2f} {trimmed:8.2f}  {theirs['renderer']:{label}}{per_sample} {each[0]}"
            f" {each[1]} {means(gallery, renderers_of[scene], scene, peer)}"
        )
    print(f"{'geometric mean':{wide}}{np.exp(np.mean(np.log(ratios))):7.2f}\n{'least':{wide}}{min(ratios):7.2f}")


def means(gallery: Gallery, renderers: list[Renderer], scene: str, peer: str) -> str:
    """Pivot's mean over the peer's, of the references, and its standard error."""
    owners = [next(renderer for renderer in renderers if renderer.name == name) for name in ("pivot", peer)]
    (ours, our_variance), (theirs, their_variance) = (gallery.reference(owner, scene) for owner in owners)
    ratio = ours.mean() / theirs.mean()
    relative = [v.mean() / v.size / i.mean() ** 2 for i, v in ((ours, our_variance), (theirs, their_variance))]
    flag = "" if abs(ratio - 1) <= MEAN_TOLERANCE else "  THE MEANS DIFFER"
    return f"{ratio:7.4f} +- {math.sqrt(sum(relative)):.4f}{flag}"


def write_sheet(
    gallery: Gallery,
    renderers: list[Renderer],
    rows: list[table.Row],
    peer: str,
    folder: Path,
    size_px: tuple[int, int],
) -> None:
    """What both made of one scene with the samples measured, and their references: a PNG in the folder."""
    ((scene, found),) = table.by_scene(rows).items()
    shown = [found[name] for name in ("pivot",) if name in found] + list(table.best(found, peer).values())
    images = {}
    for row in shown:
        renderer = next(renderer for renderer in renderers if renderer.label == row["renderer"])
        picture = gallery.load((scene, renderer.label, row["samples"], 0))[0]
        images[renderer.label] = {
            f"{row['samples']} samples": picture,
            "reference": gallery.reference(renderer, scene)[0],
        }
    lines = list(dict.fromkeys(line for column in images.values() for line in column))
    table.write_picture(folder / f"{scene}.png", lines, images, size_px)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--blender", nargs="+", default=[sys.executable], help="Pythons with bpy; the first has Pivot")
    parser.add_argument("--mitsuba", default=sys.executable, help="a Python with mitsuba and bpy")
    parser.add_argument("--scenes", nargs="+", default=list(scenes.SCENES), choices=list(scenes.SCENES))
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
