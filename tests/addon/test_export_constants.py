"""Nodes of constants reach the core as what Cycles computes of them."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import OpenEXR
import pytest
from blender_host import Host


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("constants")


@pytest.fixture(scope="module")
def cases(host: Host, folder: Path) -> Any:
    return host.run("constant_cases", folder)


def test_emission_is_cycles(cases: Any, folder: Path) -> None:
    with OpenEXR.File(str(folder / "constants.exr"), separate_channels=True) as file:
        channels = file.channels()
        picture = np.stack([channels[channel].pixels for channel in "RGB"], axis=-1)[::-1]  # the lowest row first
    wrong = {}
    size = cases["tile_px"]
    for index, name in enumerate(cases["names"]):
        if not name:
            continue
        row, column = divmod(index, cases["columns"])
        cycles = picture[row * size + size // 2, column * size + size // 2]
        exported = np.array(cases["emission"][name])
        if not np.allclose(exported, cycles, rtol=2e-3, atol=2e-4):
            wrong[name] = (exported.tolist(), cycles.tolist())
    assert not wrong


def test_nothing_is_said_of_what_is_computed(cases: Any) -> None:
    assert cases["reports"] == []


def test_every_node_was_tried(cases: Any, host: Host) -> None:
    assert len(cases["names"]) > 300
    gone = 8 if host.version >= (5, 0) else 0  # Combine and Separate of RGB and HSV by nodes of their own
    assert cases["names"].count("") == gone
