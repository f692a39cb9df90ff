"""Pivot and Cycles, in one Blender, agree on hair."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from beside_cycles import FLIP, TOLERANCE, flip, read_both
from blender_host import Host


@pytest.fixture(scope="module")
def pictures(host: Host, tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, list[str]]:
    """The folder, and which there are."""
    folder = tmp_path_factory.mktemp("hair")
    return folder, host.run("hair_cases", folder)


def test_pictures_are_cycles(pictures: tuple[Path, list[str]]) -> None:
    folder, names = pictures
    wrong = {}
    for name in names:
        ours, cycles = read_both(folder, name, "PIVOT")
        ratio = ours.mean(axis=(0, 1)) / cycles.mean(axis=(0, 1))
        if np.any(np.abs(ratio - 1) > TOLERANCE) or flip(ours, cycles) > FLIP:
            wrong[name] = (*ratio.round(4).tolist(), flip(ours, cycles))
    assert not wrong


def test_strands_are_read_at_once(host: Host, tmp_path: Path) -> None:
    """A call for each point takes a third of the time of a picture of much hair."""
    apart = host.run("strand_cases", tmp_path)
    assert all(found for found, _ in apart.values())
    assert max(far for _, far in apart.values()) < 1e-5
