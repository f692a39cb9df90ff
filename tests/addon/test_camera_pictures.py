"""Pivot and Cycles, in one Blender, agree on what cameras see."""

from __future__ import annotations

from pathlib import Path

import flip_evaluator
import numpy as np
import pytest
from blender_host import Host
from exr import read_rgb

TOLERANCE = 0.01  # of the mean
FLIP = 0.05
CASES = (
    "blurred",
    "anamorphic",
    "orthographic",
    "orthographic_blurred",
    "equirectangular",
    "fisheye",
    "equisolid",
    "mirror_ball",
)


@pytest.fixture(scope="module")
def folder(host: Host, tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("cameras")
    assert host.run("camera_pictures", folder) == list(CASES)
    return folder


@pytest.mark.parametrize("name", CASES)
@pytest.mark.parametrize("integrator", ["MONTE_CARLO", "ANALYTIC"])
def test_pictures_are_cycles(folder: Path, name: str, integrator: str) -> None:
    ours, cycles = (read_rgb(folder / f"{name}_{engine}.exr") for engine in (integrator, "CYCLES"))
    assert ours.mean(axis=(0, 1)) == pytest.approx(cycles.mean(axis=(0, 1)), rel=TOLERANCE)
    shown = [np.clip(picture, 0, 1).astype(np.float32) ** np.float32(1 / 2.2) for picture in (cycles, ours)]
    assert flip_evaluator.evaluate(*shown, "LDR")[1] <= FLIP
