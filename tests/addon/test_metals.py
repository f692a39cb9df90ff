"""Pivot and Cycles, in one Blender, agree on anisotropic highlights, coats and metals."""

from __future__ import annotations

from pathlib import Path

import flip_evaluator
import numpy as np
import pytest
from blender_host import Host
from exr import read_rgb

CASES = {"brushed": (3, 4), "coats": (4, 0), "metals": (4, 3)}  # from which Blender on
TOLERANCE = 0.01  # of the mean
FLIP = 0.05


@pytest.fixture(scope="module")
def folder(host: Host, tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("metals")
    assert host.run("metal_cases", folder) == [name for name, version in CASES.items() if host.version >= version]
    return folder


@pytest.mark.parametrize("name", CASES)
@pytest.mark.parametrize("integrator", ["MONTE_CARLO", "direct_ANALYTIC"])
def test_pictures_are_cycles(host: Host, folder: Path, name: str, integrator: str) -> None:
    if host.version < CASES[name]:
        assert not (folder / f"{name}_CYCLES.exr").exists()
        return
    ours = read_rgb(folder / f"{name}_{integrator}.exr")
    cycles = read_rgb(folder / f"{name}{'_direct' if 'direct' in integrator else ''}_CYCLES.exr")
    assert ours.mean(axis=(0, 1)) == pytest.approx(cycles.mean(axis=(0, 1)), rel=TOLERANCE)
    shown = [np.clip(picture, 0, 1).astype(np.float32) ** np.float32(1 / 2.2) for picture in (cycles, ours)]
    assert flip_evaluator.evaluate(*shown, "LDR")[1] <= FLIP
