"""Pivot and Cycles, in one Blender, agree on what lights light and on what rays meet."""

from __future__ import annotations

from pathlib import Path

import flip_evaluator
import numpy as np
import pytest
from blender_host import Host
from exr import read_rgb

CASES = ("unshadowed", "spread", "excluded", "few_bounces", "hidden", "holdout", "indirect_only")
TOLERANCE = 0.01  # of the mean
FLIP = 0.05


@pytest.fixture(scope="module")
def folder(host: Host, tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("visibility")
    assert host.run("visibility_cases", folder) == list(CASES)
    return folder


@pytest.mark.parametrize(
    ("integrator", "name"),
    [("MONTE_CARLO", name) for name in CASES] + [("direct_ANALYTIC", name) for name in CASES if name != "hidden"],
)
def test_pictures_are_cycles(folder: Path, integrator: str, name: str) -> None:
    ours = read_rgb(folder / f"{name}_{integrator}.exr")
    cycles = read_rgb(folder / f"{name}{'_direct' if 'direct' in integrator else ''}_CYCLES.exr")
    assert ours.mean(axis=(0, 1)) == pytest.approx(cycles.mean(axis=(0, 1)), rel=TOLERANCE)
    shown = [np.clip(picture, 0, 1).astype(np.float32) ** np.float32(1 / 2.2) for picture in (cycles, ours)]
    assert flip_evaluator.evaluate(*shown, "LDR")[1] <= FLIP
