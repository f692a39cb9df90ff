"""Pivot and Cycles, in one Blender, agree on rough diffuse reflection, sheen and velvet."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from beside_cycles import FLIP, TOLERANCE, flip, read_both
from blender_host import Host


@pytest.fixture(scope="module")
def pictures(host: Host, tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, list[str]]:
    """The folder, and which there are."""
    folder = tmp_path_factory.mktemp("cloth")
    names = host.run("cloth_cases", folder)
    assert len(names) >= 8
    return folder, names


def compare(folder: Path, name: str, integrator: str) -> dict[str, Any]:
    ours, cycles = read_both(folder, name, integrator)
    return {"mean": ours.mean(axis=(0, 1)) / cycles.mean(axis=(0, 1)), "flip": flip(ours, cycles)}


@pytest.mark.parametrize("integrator", ["MONTE_CARLO", "direct_ANALYTIC"])
def test_pictures_are_cycles(pictures: tuple[Path, list[str]], integrator: str) -> None:
    folder, names = pictures
    found = {name: compare(folder, name, integrator) for name in names}
    off = {name: each for name, each in found.items() if np.abs(each["mean"] - 1).max() > TOLERANCE}
    assert not off
    assert {name: each["flip"] for name, each in found.items() if each["flip"] > FLIP} == {}
