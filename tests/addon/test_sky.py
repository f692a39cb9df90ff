"""Pivot and Cycles, in one Blender, agree on the Sky Texture and what it lights."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from beside_cycles import FLIP, TOLERANCE, flip, read_both
from blender_host import Host

CASES = ("noon", "dusk", "haze", "unseen", "painted", "daylight")


@pytest.fixture(scope="module")
def folder(host: Host, tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("skies")
    assert host.run("sky_cases", folder) == list(CASES)
    return folder


@pytest.mark.parametrize("name", CASES)
def test_pictures_are_cycles(folder: Path, name: str) -> None:
    ours, cycles = read_both(folder, name, "PIVOT")
    is_calm = np.maximum(ours, cycles).max(-1) < 2  # a sun that is narrower than a pixel is noise
    assert is_calm.mean() > 0.95
    parts = (slice(0, 32),) if name == "unseen" else (slice(0, 16), slice(0, 32))  # the sky, and with what it lights
    for rows in parts:
        means = [picture[rows][is_calm[rows]].mean(0) for picture in (ours, cycles)]
        np.testing.assert_allclose(*means, rtol=TOLERANCE)
    assert flip(ours, cycles) <= FLIP
