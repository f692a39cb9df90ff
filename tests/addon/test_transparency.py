"""Pivot and Cycles, in one Blender, agree on what light passes."""

from __future__ import annotations

from pathlib import Path

import pytest
from beside_cycles import assert_alike
from blender_host import Host

CASES = ("leaves", "panes", "veils")


@pytest.fixture(scope="module")
def folder(host: Host, tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("transparency")
    assert host.run("transparency_cases", folder) == list(CASES)
    return folder


@pytest.mark.parametrize("name", CASES)
@pytest.mark.parametrize("integrator", ["MONTE_CARLO", "direct_ANALYTIC"])
def test_pictures_are_cycles(folder: Path, name: str, integrator: str) -> None:
    assert_alike(folder, name, integrator)
