"""Nodes of constants reach the core as what Cycles computes of them, and shade as Cycles where their inputs vary."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from blender_host import Host
from exr import read_rgb
from numpy.typing import NDArray


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("constants")


@pytest.fixture(scope="module")
def cases(host: Host, folder: Path) -> Any:
    return host.run("constant_cases", folder)


@pytest.fixture(scope="module")
def varying(host: Host, folder: Path) -> Any:
    return host.run("varying_cases", folder)


def tiles(cases: Any, path: Path) -> dict[str, NDArray[np.float32]]:
    """(rows, columns, 3), the lowest row first, of each tile's node by its name."""
    picture = read_rgb(path)[::-1]
    size = cases["tile_px"]
    named = {}
    for index, name in enumerate(cases["names"]):
        row, column = divmod(index, cases["columns"])
        named[name] = picture[row * size : (row + 1) * size, column * size : (column + 1) * size]
    named.pop("", None)
    return named


def test_emission_is_cycles(cases: Any, folder: Path) -> None:
    wrong = {}
    for name, tile in tiles(cases, folder / "constants.exr").items():
        cycles = tile[tile.shape[0] // 2, tile.shape[1] // 2]
        exported = np.array(cases["emission"][name])
        if not np.allclose(exported, cycles, rtol=1e-4, atol=1e-5):
            wrong[name] = (exported.tolist(), cycles.tolist())
    assert not wrong


def test_nothing_is_said_of_what_is_computed(cases: Any) -> None:
    assert cases["reports"] == []


def test_every_node_was_tried(cases: Any, host: Host) -> None:
    assert len(cases["names"]) > 400
    gone = 8 if host.version >= (5, 0) else 0  # Combine and Separate of RGB and HSV by nodes of their own
    assert cases["names"].count("") == gone


def test_what_varies_is_cycles(varying: Any, folder: Path, host: Host) -> None:
    """Since Blender 5.2 a blackbody that varies passes a matrix in Cycles that is not quite one: 1.6e-4 in red."""
    cycles, pivot = (tiles(varying, folder / f"{engine}.exr") for engine in ("cycles", "pivot"))
    wrong = {}
    for name, tile in cycles.items():
        rtol = 3e-4 if name.startswith("blackbody") and host.version >= (5, 2) else 1e-4
        same = np.isclose(pivot[name], tile, rtol=rtol, atol=1e-5).all(axis=-1)
        if not same.all():
            row, column = np.argwhere(~same)[0]
            wrong[name] = (row, column, pivot[name][row, column].tolist(), tile[row, column].tolist())
    assert not wrong


def test_every_kind_varied(varying: Any, folder: Path) -> None:
    flat = {
        name
        for name, tile in tiles(varying, folder / "cycles.exr").items()
        if np.ptp(tile.reshape(-1, 3), 0).max() == 0
    }
    assert flat == {"normal 0"}  # a direction that is set, whatever its input
    assert len(varying["names"]) - varying["names"].count("") > 180
