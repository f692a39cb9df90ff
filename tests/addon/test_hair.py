"""Pivot and Cycles, in one Blender, agree on hair."""

from __future__ import annotations

from pathlib import Path

import flip_evaluator
import numpy as np
import pytest
from blender_host import Host
from exr import read_rgb

TOLERANCE = 0.01  # of the mean
FLIP = 0.05


@pytest.fixture(scope="module")
def pictures(host: Host, tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, list[str]]:
    """The folder, and which there are."""
    folder = tmp_path_factory.mktemp("hair")
    return folder, host.run("hair_cases", folder)


def test_pictures_are_cycles(pictures: tuple[Path, list[str]]) -> None:
    folder, names = pictures
    wrong = {}
    for name in names:
        ours, cycles = (read_rgb(folder / f"{name}_{engine}.exr") for engine in ("PIVOT", "CYCLES"))
        ratio = ours.mean(axis=(0, 1)) / cycles.mean(axis=(0, 1))
        shown = [np.clip(picture, 0, 1).astype(np.float32) ** np.float32(1 / 2.2) for picture in (cycles, ours)]
        flip = flip_evaluator.evaluate(*shown, "LDR")[1]
        if np.any(np.abs(ratio - 1) > TOLERANCE) or flip > FLIP:
            wrong[name] = (*ratio.round(4).tolist(), flip)
    assert not wrong
