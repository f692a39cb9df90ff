"""Textures that are computed look as in Cycles, pixel for pixel."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from blender_host import Host
from exr import read_rgb

LEAST_AGREEMENT = 0.97  # of a tile's pixels: on the edges of a pattern the last bit decides


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("textures")


@pytest.fixture(scope="module")
def cases(host: Host, folder: Path) -> Any:
    return host.run("texture_cases", folder)


def _picture(path: Path) -> np.ndarray:
    """(rows, columns, 3), the lowest row first."""
    return read_rgb(path)[::-1]


def test_textures_are_cycles(cases: Any, folder: Path) -> None:
    cycles, pivot = (_picture(folder / f"textures_{engine}.exr") for engine in ("CYCLES", "PIVOT"))
    wrong = {}
    size = cases["tile_px"]
    for index, name in enumerate(cases["names"]):
        row, column = divmod(index, cases["columns"])
        tile = np.s_[row * size : (row + 1) * size, column * size : (column + 1) * size]
        agreement = np.isclose(pivot[tile], cycles[tile], rtol=2e-3, atol=2e-4).all(-1).mean()
        if agreement < LEAST_AGREEMENT:
            wrong[name] = (agreement, pivot[tile].mean(), cycles[tile].mean())
    assert not wrong


def test_tiles_vary(cases: Any, folder: Path) -> None:
    cycles = _picture(folder / "textures_CYCLES.exr")
    size = cases["tile_px"]
    rows = -(-len(cases["names"]) // cases["columns"])
    tiles = cycles.reshape(rows, size, cases["columns"], size, 3).swapaxes(1, 2).reshape(-1, size, size, 3)
    plain = [name for name, tile in zip(cases["names"], tiles, strict=False) if np.ptp(tile) < 1e-3]
    assert plain == ["output that is not there"]  # the input's own colour counts


def test_a_texture_of_the_world_is_cycles(cases: Any, folder: Path) -> None:
    cycles, pivot = (_picture(folder / f"world_{engine}.exr") for engine in ("CYCLES", "PIVOT"))
    assert np.ptp(cycles) > 0.1
    np.testing.assert_allclose(pivot, cycles, rtol=2e-3, atol=2e-3)


def test_a_first_register_is_no_number(cases: Any) -> None:
    assert cases["varies"]
