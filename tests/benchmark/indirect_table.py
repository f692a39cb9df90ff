"""What the benchmarks of light that bounces, and of fog, print and draw of their rows."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import monte_carlo_table as table
import numpy as np
from monte_carlo_measure import means
from monte_carlo_pictures import Gallery, Renderer


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
        trimmed = ours["efficiency without the worst"] / theirs["efficiency without the worst"]
        each = [f"{ours[name]:8.2e} {theirs[name]:8.2e}" for name in ("relMSE", "relMSE of the reference")]
        per_sample = f"{ours['CPU s'] / ours['samples']:7.3f} {theirs['CPU s'] / theirs['samples']:7.3f}"
        print(
            f"{scene:{wide}}{ratios[-1]:7.2f} {trimmed:8.2f}  {theirs['renderer']:{label}}{per_sample} {each[0]}"
            f" {each[1]} {means(gallery, renderers_of[scene], scene, peer)}"
        )
    print(f"{'geometric mean':{wide}}{np.exp(np.mean(np.log(ratios))):7.2f}\n{'least':{wide}}{min(ratios):7.2f}")


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
