"""Pictures of Pivot beside those that Cycles renders of the same scenes, see inside/cycles_cases.py."""

from __future__ import annotations

from pathlib import Path

import flip_evaluator
import numpy as np
import pytest
from exr import read_rgb
from numpy.typing import NDArray

TOLERANCE = 0.01  # of the mean
FLIP = 0.05

Picture = NDArray[np.float32]  # (height, width, 3)


def read_both(folder: Path, name: str, integrator: str) -> tuple[Picture, Picture]:
    """Pivot's and Cycles'. integrator: how NAME_INTEGRATOR.exr was rendered; of direct light alone, with 'direct_'."""
    light = "_direct" if integrator.startswith("direct_") else ""
    return read_rgb(folder / f"{name}_{integrator}.exr"), read_rgb(folder / f"{name}{light}_CYCLES.exr")


def flip(ours: Picture, cycles: Picture) -> float:
    shown = [np.clip(picture, 0, 1).astype(np.float32) ** np.float32(1 / 2.2) for picture in (cycles, ours)]
    return float(flip_evaluator.evaluate(*shown, "LDR")[1])


def assert_alike(folder: Path, name: str, integrator: str) -> None:
    ours, cycles = read_both(folder, name, integrator)
    assert ours.mean(axis=(0, 1)) == pytest.approx(cycles.mean(axis=(0, 1)), rel=TOLERANCE)
    assert flip(ours, cycles) <= FLIP
