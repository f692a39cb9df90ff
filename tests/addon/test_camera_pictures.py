"""Pivot and Cycles, in one Blender, agree on what cameras see."""

from __future__ import annotations

from pathlib import Path

import pytest
from beside_cycles import assert_alike
from blender_host import Host

CASES = (
    "blurred",
    "anamorphic",
    "orthographic",
    "orthographic_blurred",
    "equirectangular",
    "fisheye",
    "equisolid",
    "mirror_ball",
)


@pytest.fixture(scope="module")
def folder(host: Host, tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("cameras")
    assert host.run("camera_pictures", folder) == list(CASES)
    return folder


@pytest.mark.parametrize("name", CASES)
@pytest.mark.parametrize("integrator", ["MONTE_CARLO", "ANALYTIC"])
def test_pictures_are_cycles(folder: Path, name: str, integrator: str) -> None:
    assert_alike(folder, name, integrator)
