"""Pivot and Cycles, in one Blender, agree on how bright fog is."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest
from blender_host import Host
from exr import read_rgb

TOLERANCE = 0.01  # of a picture's mean radiance


@dataclass(frozen=True)
class Rendered:
    folder: Path
    scenes: list[str]


@pytest.fixture(scope="module")
def rendered(host: Host, tmp_path_factory: pytest.TempPathFactory) -> Rendered:
    folder = tmp_path_factory.mktemp("fog")
    return Rendered(folder, host.run("fog_pictures", folder))


def test_mean_radiance_is_cycles(rendered: Rendered) -> None:
    wrong = {}
    for scene in rendered.scenes:
        ours, cycles = (read_rgb(rendered.folder / f"{scene}_{engine}.exr") for engine in ("PIVOT", "CYCLES"))
        ratio = ours.mean(axis=(0, 1)) / cycles.mean(axis=(0, 1))
        if np.any(np.abs(ratio - 1) > TOLERANCE):
            wrong[scene] = ratio
    assert not wrong


def test_every_kind_of_fog_is_compared(rendered: Rendered, host: Host) -> None:
    assert {"scatter", "scatter_3", "absorption", "principled_2", "world_fog", "noise_1", "room"} <= set(
        rendered.scenes
    )
    assert ("two_lobes_1" in rendered.scenes) == (host.version >= (4, 3))
    if not host.kind.startswith("bpy"):
        assert "smoke" in rendered.scenes
