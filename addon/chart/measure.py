"""Every picture of a ladder, rendered once: a run that was stopped goes on where it was."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable
from dataclasses import asdict
from pathlib import Path
from typing import Any

import bpy
import numpy as np

from .. import core
from .errors import Reference, Row
from .ladder import REFERENCE_PARTS, REFERENCE_SETTINGS, Ladder, Rung
from .renderers import Floats, Render, set_size, with_cycles, with_pivot

Say = Callable[[str], None]
_WITH = {"PIVOT": with_pivot, "CYCLES": with_cycles}
_REFERENCE_SEED = 1000


def scene_key(blend: Path, width_px: int) -> str:
    """Names the scene, its size in the chart, and the builds that render it."""
    renderer = core.load()
    native = sorted(Path(renderer.__file__).parent.glob(f"_core_{renderer.arch}.*"))
    digest = hashlib.sha256(f"{width_px} {bpy.app.version_string} {bpy.app.build_hash!r}".encode())
    for file in (blend, *native):
        digest.update(file.read_bytes())
    return digest.hexdigest()[:16]


class Pictures:
    """The pictures of one scene, one file each."""

    def __init__(self, folder: Path) -> None:
        self._folder = folder
        folder.mkdir(parents=True, exist_ok=True)

    def file(self, rung: Rung, seed: int) -> Path:
        what = json.dumps([rung.renderer, rung.samples, rung.settings, seed], sort_keys=True)
        return self._folder / f"{rung.renderer}-{hashlib.sha256(what.encode()).hexdigest()[:16]}.npz"

    def load(self, rung: Rung, seed: int) -> tuple[Floats, float]:
        with np.load(self.file(rung, seed)) as data:
            return data["image"], float(data["cpu_s"])

    def make(self, rung: Rung, seed: int, render: Render) -> None:
        image, cpu_s = render(rung.settings, rung.samples, seed)
        file = self.file(rung, seed)
        half_written = file.with_suffix(".part.npz")
        np.savez(half_written, image=image, cpu_s=cpu_s)
        half_written.replace(file)


def reference_rung(renderer: str, ladder: Ladder) -> Rung:
    """One part of a renderer's reference. Each renderer is held against its own."""
    settings: dict[str, Any] = REFERENCE_SETTINGS if renderer == "PIVOT" else {}
    if ladder.max_bounces > 0:
        settings = settings | {"max_bounces": ladder.max_bounces}
    return Rung(renderer, "reference", "", ladder.reference_samples // REFERENCE_PARTS, settings)


def wanted(renderer: str, ladder: Ladder) -> list[tuple[Rung, int]]:
    """The ladder's pictures and the parts of the reference, with their seeds."""
    part = reference_rung(renderer, ladder)
    return [(rung, 0) for rung in ladder.of(renderer)] + [(part, _REFERENCE_SEED + k) for k in range(REFERENCE_PARTS)]


def measure(blend: Path, ladder: Ladder, folder: Path, say: Say) -> list[Row]:
    """Render what is missing of the ladder for the scene that is open, and return its rows.

    blend: the scene's file. folder: keeps the pictures. say: takes lines "[done/all] what", in samples.
    """
    scene = bpy.context.scene
    set_size(scene, ladder.width_px)
    pictures = Pictures(folder / scene_key(blend, ladder.width_px))
    missing = {
        renderer: [pair for pair in wanted(renderer, ladder) if not pictures.file(*pair).exists()]
        for renderer in _WITH
        if ladder.of(renderer)
    }
    total = sum(rung.samples for pairs in missing.values() for rung, _ in pairs)
    done = 0

    def make(pairs: list[tuple[Rung, int]], render: Render) -> None:
        nonlocal done
        for rung, seed in pairs:
            say(f"[{done}/{total}] {rung.method} {rung.label}")
            pictures.make(rung, seed, render)
            done += rung.samples
            say(f"[{done}/{total}] {rung.method} {rung.label}")

    for renderer, pairs in missing.items():
        if pairs:
            _WITH[renderer](scene, lambda render, pairs=pairs: make(pairs, render))
    return [row for renderer in missing for row in rows_of(renderer, ladder, pictures)]


def reference_of(renderer: str, ladder: Ladder, pictures: Pictures) -> Reference:
    part = reference_rung(renderer, ladder)
    return Reference.of_parts([pictures.load(part, _REFERENCE_SEED + k)[0] for k in range(REFERENCE_PARTS)])


def rows_of(renderer: str, ladder: Ladder, pictures: Pictures) -> list[Row]:
    reference = reference_of(renderer, ladder, pictures)
    rows = []
    for rung in ladder.of(renderer):
        image, cpu_s = pictures.load(rung, 0)
        rows.append(Row(rung, cpu_s, reference.rel_mse(image), str(pictures.file(rung, 0))))
    return rows


def rows_to_json(rows: list[Row]) -> str:
    return json.dumps([asdict(row) for row in rows])


def rows_from_json(text: str) -> list[Row]:
    return [Row(**(row | {"rung": Rung(**row["rung"])})) for row in json.loads(text)]
