"""Pivot and Cycles, in one Blender, agree on what linked lights light, and on whose shadows they cast."""

from __future__ import annotations

from pathlib import Path

import flip_evaluator
import numpy as np
import pytest
from blender_host import Host
from exr import read_rgb

CASES = ("receivers", "blockers", "shining", "many")
TOLERANCE = 0.01  # of the mean
FLIP = 0.05


@pytest.fixture(scope="module")
def folder(host: Host, tmp_path_factory: pytest.TempPathFactory) -> Path:
    if host.version < (4, 0):
        pytest.skip("lights are linked from Blender 4.0 on")
    folder = tmp_path_factory.mktemp("links")
    assert host.run("link_cases", folder) == list(CASES)
    return folder


@pytest.mark.parametrize("name", CASES)
def test_pictures_are_cycles(folder: Path, name: str) -> None:
    ours, cycles = (read_rgb(folder / f"{name}_{engine}.exr") for engine in ("MONTE_CARLO", "CYCLES"))
    assert ours.mean(axis=(0, 1)) == pytest.approx(cycles.mean(axis=(0, 1)), rel=TOLERANCE)
    shown = [np.clip(picture, 0, 1).astype(np.float32) ** np.float32(1 / 2.2) for picture in (cycles, ours)]
    assert flip_evaluator.evaluate(*shown, "LDR")[1] <= FLIP
