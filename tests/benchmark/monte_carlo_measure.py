"""A scene's rows, each renderer's and Cycles' best, and whether the references of two renderers agree."""

from __future__ import annotations

import argparse
import math

import monte_carlo_table as table
from monte_carlo_pictures import Gallery, Renderer

MEASURED = 2  # of Cycles' variants
MEAN_TOLERANCE = 0.01


def measure(gallery: Gallery, renderers: list[Renderer], scene: str, arguments: argparse.Namespace) -> list[table.Row]:
    """A row of each renderer with all seeds, of Cycles the best, plain and adaptive. One without pictures is left out;
    with no seeds the references alone are made, and there are no rows."""

    def rows(wanted: list[Renderer], seeds: range) -> list[tuple[Renderer, table.Row]]:
        found = []
        for renderer in wanted:
            again = not arguments.only or renderer.label in arguments.only
            if gallery.make(renderer, scene, arguments.samples, seeds, again) and seeds.stop:
                every = range(seeds.stop)  # those before were made before
                found.append((renderer, gallery.measure(renderer, scene, arguments.samples, every)))
                table.print_row(found[-1][1])
        return found

    found = rows([renderer for renderer in renderers if renderer.name != "cycles"], range(arguments.seeds))
    for adaptive in (False, True):
        variants = [r for r in renderers if r.name == "cycles" and r.adaptive == adaptive]
        tried = rows(variants, range(min(1, arguments.seeds)))
        best = sorted(tried, key=lambda pair: -pair[1]["efficiency"])[:MEASURED]
        if arguments.seeds > 1:
            best = rows([renderer for renderer, _ in best], range(1, arguments.seeds))
        found += best
    return [row for _, row in found]


def means(gallery: Gallery, renderers: list[Renderer], scene: str, peer: str) -> str:
    """Pivot's mean over the peer's, of the references, and its standard error."""
    owners = [next(renderer for renderer in renderers if renderer.name == name) for name in ("pivot", peer)]
    (ours, our_variance), (theirs, their_variance) = (gallery.reference(owner, scene) for owner in owners)
    ratio = ours.mean() / theirs.mean()
    relative = [v.mean() / v.size / i.mean() ** 2 for i, v in ((ours, our_variance), (theirs, their_variance))]
    flag = "" if abs(ratio - 1) <= MEAN_TOLERANCE else "  THE MEANS DIFFER"
    return f"{ratio:7.4f} +- {math.sqrt(sum(relative)):.4f}{flag}"
