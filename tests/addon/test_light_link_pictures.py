"""Pivot and Cycles, in one Blender, agree on what linked lights light, and on whose shadows they cast."""

from __future__ import annotations

from pathlib import Path

import pytest
from beside_cycles import assert_alike
from blender_host import Host

CASES = ("receivers", "blockers", "shining", "many")


@pytest.fixture(scope="module")
def folder(host: Host, tmp_path_factory: pytest.TempPathFactory) -> Path:
    if host.version < (4, 0):
        pytest.skip("lights are linked from Blender 4.0 on")
    folder = tmp_path_factory.mktemp("links")
    assert host.run("link_cases", folder) == list(CASES)
    return folder


@pytest.mark.parametrize("integrator", ["MONTE_CARLO", "direct_ANALYTIC"])
@pytest.mark.parametrize("name", CASES)
def test_pictures_are_cycles(folder: Path, name: str, integrator: str) -> None:
    assert_alike(folder, name, integrator)
