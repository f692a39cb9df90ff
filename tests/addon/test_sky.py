"""Pivot and Cycles, in one Blender, agree on the Sky Texture and what it lights."""

from __future__ import annotations

from pathlib import Path

import flip_evaluator
import numpy as np
import pytest
from blender_host import Host
from exr import read_rgb

CASES = ("noon", "dusk", "haze", "unseen", "daylight")
TOLERANCE = 0.01  # of the mean
FLIP = 0.05


@pytest.fixture(scope="module")
def folder(host: Host, tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("skies")
    assert host.run("sky_cases", folder) == list(CASES)
    return folder


@pytest.mark.parametrize("name", CASES)
def test_pictures_are_cycles(folder: Path, name: str) -> None:
    ours, cycles = (read_rgb(folder / f"{name}_{engine}.exr") for engine in ("PIVOT", "CYCLES"))
    is_calm = np.maximum(ours, cycles).max(-1) < 2  # a sun that is narrower than a pixel is noise
    assert is_calm.mean() > 0.95
    parts = (slice(0, 32),) if name == "unseen" else (slice(0, 16), slice(0, 32))  # the sky, and with what it lights
    for rows in parts:
        means = [picture[rows][is_calm[rows]].mean(0) for picture in (ours, cycles)]
        np.testing.assert_allclose(*means, rtol=TOLERANCE)
    shown = [np.clip(picture, 0, 1).astype(np.float32) ** np.float32(1 / 2.2) for picture in (cycles, ours)]
    assert flip_evaluator.evaluate(*shown, "LDR")[1] <= FLIP
