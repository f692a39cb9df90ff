"""Filter Glossy means what it means in Cycles: what a filtered metal throws on a floor is as bright, and as wide."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from blender_host import Host
from exr import read_rgb

TOLERANCE = 0.03  # of the mean


def thrown(folder: Path, engine: str) -> np.ndarray:
    """Light that bounced, of each quarter of the picture, (2, 2, 3)."""
    direct, bounced = (read_rgb(folder / f"{engine}_{bounces}.exr") for bounces in (0, 1))
    return (bounced - direct).reshape(2, 16, 2, 16, 3).mean(axis=(1, 3))


def test_what_a_filtered_metal_throws_is_cycles(host: Host, tmp_path: Path) -> None:
    host.run("filter_cases", tmp_path)
    ours, cycles = thrown(tmp_path, "PIVOT"), thrown(tmp_path, "CYCLES")
    np.testing.assert_allclose(ours, cycles, atol=TOLERANCE * cycles.mean(axis=(0, 1)).min())
