"""Pivot and Cycles, in one Blender, agree on what light goes beneath by any of Cycles' methods but Burley's."""

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
    folder = tmp_path_factory.mktemp("subsurface")
    return folder, host.run("subsurface_cases", folder)


def compare(folder: Path, name: str) -> dict[str, Any]:
    ours, cycles = read_both(folder, name, "MONTE_CARLO")
    return {"mean": ours.mean(axis=(0, 1)) / cycles.mean(axis=(0, 1)), "flip": flip(ours, cycles)}


def test_pictures_are_cycles(pictures: tuple[Path, list[str]]) -> None:
    folder, names = pictures
    found = {name: compare(folder, name) for name in names if name != "burley"}
    off = {name: each for name, each in found.items() if np.abs(each["mean"] - 1).max() > TOLERANCE}
    assert not off
    assert {name: each["flip"] for name, each in found.items() if each["flip"] > FLIP} == {}


def test_what_cycles_only_projects_is_walked(pictures: tuple[Path, list[str]]) -> None:
    """Burley's method takes a surface for a plane: a slab lets more light through than any medium does."""
    found = compare(pictures[0], "burley")
    assert np.abs(found["mean"] - 1).max() < 0.06
    assert found["flip"] < 0.1
