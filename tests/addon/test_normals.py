"""Normals of meshes that are flat here and smooth there are Cycles', at every pixel."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from blender_host import Host
from exr import read_rgb


def test_flat_and_smooth_faces_are_cycles(host: Host, tmp_path: Path) -> None:
    """But for a pixel in a hundred of each, where rounding decides between triangles."""
    names = host.run("normal_cases", tmp_path)
    ours, cycles = (read_rgb(tmp_path / f"{engine}.exr") for engine in ("PIVOT", "CYCLES"))
    assert (cycles > 0.1).any(axis=-1).mean() > 0.5
    off = np.abs(ours - cycles).max(axis=-1) > 2e-3
    shares = dict(zip(names, off.reshape(len(off), len(names), -1).mean(axis=(0, 2)), strict=True))
    assert max(shares.values()) < 0.01, shares
