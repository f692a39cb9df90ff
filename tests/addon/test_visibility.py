"""Pivot and Cycles, in one Blender, agree on what lights light and on what rays meet."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from beside_cycles import assert_alike
from blender_host import Host
from exr import read_passes

CASES = ("unshadowed", "spread", "excluded", "few_bounces", "hidden", "holdout", "indirect_only")


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
    assert_alike(folder, name, integrator)


@pytest.mark.parametrize("integrator", ["MONTE_CARLO", "direct_ANALYTIC"])
def test_holdouts_leave_the_alpha_that_cycles_leaves(folder: Path, integrator: str) -> None:
    """One of them is a veil that lets 70 % through to an opaque ground."""
    files = (folder / f"holdout_{engine}.exr" for engine in (integrator, "CYCLES"))
    ours, cycles = (read_passes(file)[""][..., 3] for file in files)
    assert abs(ours - cycles).mean() < 0.002
    assert np.count_nonzero(abs(cycles - 0.7) < 0.02) > 50
    assert abs(ours - cycles).max() < 0.08
