"""Pivot and Cycles, in one Blender, agree on what a world lights, on opaque shadows and on paths bounded by kind."""

from __future__ import annotations

from pathlib import Path

import flip_evaluator
import numpy as np
import pytest
from blender_host import Host
from exr import read_rgb

CASES = (
    "no_diffuse",
    "no_glossy",
    "no_transmission",
    "uneven_no_diffuse",
    "few_world_bounces",
    "opaque_to_shadows",
    "diffuse_limit",
    "glossy_limit",
    "transmission_limit",
)
TOLERANCE = 0.01  # of the mean
FLIP = 0.05


@pytest.fixture(scope="module")
def folder(host: Host, tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("limits")
    assert host.run("limit_cases", folder) == list(CASES)
    return folder


@pytest.mark.parametrize("name", CASES)
def test_pictures_are_cycles(host: Host, folder: Path, name: str) -> None:
    if host.version < (4, 0) and name == "opaque_to_shadows":
        pytest.skip("there some of Cycles' shadow rays pass what hides light")
    ours, cycles = (read_rgb(folder / f"{name}_{engine}.exr") for engine in ("MONTE_CARLO", "CYCLES"))
    assert ours.mean(axis=(0, 1)) == pytest.approx(cycles.mean(axis=(0, 1)), rel=TOLERANCE)
    shown = [np.clip(picture, 0, 1).astype(np.float32) ** np.float32(1 / 2.2) for picture in (cycles, ours)]
    assert flip_evaluator.evaluate(*shown, "LDR")[1] <= FLIP
