"""What nodes tell of places, objects and rays is what Cycles says, at every pixel."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from blender_host import Host
from exr import read_rgb


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("places")


@pytest.fixture(scope="module")
def cases(host: Host, folder: Path) -> Any:
    return host.run("place_cases", folder)


def picture(path: Path) -> np.ndarray:
    """(height, width, 3), the lowest row first."""
    return read_rgb(path)[::-1]


def _is_bent_otherwise(name: str, host: Host) -> bool:
    """Before Blender 3.6, normals far from the surface's: of two equations for the bent normal Pivot has the newer."""
    return host.version < (3, 6) and ("bump" in name or name == "constant")


def test_tiles_are_cycles(cases: Any, folder: Path, host: Host) -> None:
    """But for a pixel in fifty of each, where rounding decides between triangles."""
    ours, cycles = (picture(folder / f"{engine}.exr") for engine in ("PIVOT", "CYCLES"))
    off = np.abs(ours - cycles).max(axis=-1) > 4e-3 + 2e-3 * np.abs(cycles).max(axis=-1)
    size, wrong = cases["tile_px"], {}
    for index, name in enumerate(cases["names"]):
        row, column = divmod(index, cases["columns"])
        share = float(off[row * size : (row + 1) * size, column * size : (column + 1) * size].mean())
        if share > 0.02 and not _is_bent_otherwise(name, host):
            wrong[name] = share
    assert not wrong


def test_instances_are_cycles(cases: Any, folder: Path) -> None:
    ours, cycles = (picture(folder / f"instances_{engine}.exr") for engine in ("PIVOT", "CYCLES"))
    off = np.abs(ours - cycles).max(axis=-1) > 4e-3 + 2e-3 * np.abs(cycles).max(axis=-1)
    assert (cycles > 0).any(axis=-1).mean() > 0.02
    assert off.mean() < 0.002


def test_turned_normals_are_lit_as_in_cycles(cases: Any, folder: Path, host: Host) -> None:
    ours, cycles = (picture(folder / f"lit_{engine}.exr") for engine in ("PIVOT", "CYCLES"))
    balls = len(cases["lit"])
    ratios = [a.mean() / b.mean() for a, b in zip(np.split(ours, balls, 1), np.split(cycles, balls, 1), strict=True)]
    wrong = {
        name: ratio
        for name, ratio in zip(cases["lit"], ratios, strict=True)
        if abs(ratio - 1) > 0.02 and not _is_bent_otherwise(name, host)
    }
    assert not wrong


def test_occlusion_is_that_of_cycles(host: Host, tmp_path: Path) -> None:
    """Of rays in both: pixels are noisy, means are not."""
    wrong = {}
    for name in host.run("occlusion_cases", tmp_path):
        ours, cycles = (picture(tmp_path / f"{name}_{engine}.exr") for engine in ("PIVOT", "CYCLES"))
        off = np.abs(ours - cycles).mean() / cycles.mean(), ours.mean() / cycles.mean() - 1
        if off[0] > 0.03 or abs(off[1]) > 0.005:
            wrong[name] = off
    assert not wrong


def test_nothing_is_said_of_what_is_shown(cases: Any) -> None:
    assert cases["reports"] == []
