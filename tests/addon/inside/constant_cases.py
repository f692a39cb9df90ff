"""Emission through each node that is computed from constants: as exported, and as Cycles shows it in tiles."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

from node_kinds import node_kinds, passed_on
from node_tiles import render, tiles
from recording import record

TILE_PX = 8


def main(folder: Path) -> Any:
    """Returns the tiles, and the exported emission by name."""
    made = tiles(_kinds(), TILE_PX)
    recording = record()
    emission = {name: list(recording.materials[name].emission) for name in made["names"] if name}
    render("CYCLES", folder / "constants.exr")
    return made | {"emission": emission, "reports": recording.reports}


def _kinds() -> Iterator[tuple[str, Any]]:
    for name, make in (*node_kinds(), *passed_on()):
        yield name, lambda tree, _, make=make: make(tree)
