"""Pivot and Cycles, in one Blender, agree on what a world lights, on opaque shadows and on paths bounded by kind."""

from __future__ import annotations

from pathlib import Path

import pytest
from beside_cycles import assert_alike
from blender_host import Host

CASES = (
    "no_diffuse",
    "no_glossy",
    "no_transmission",
    "uneven_no_diffuse",
    "few_world_bounces",
    "opaque_to_shadows",
    "diffuse_limit",
    "glossy_limit",
    "transmission_limit",
)


@pytest.fixture(scope="module")
def folder(host: Host, tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("limits")
    assert host.run("limit_cases", folder) == list(CASES)
    return folder


@pytest.mark.parametrize("name", CASES)
def test_pictures_are_cycles(host: Host, folder: Path, name: str) -> None:
    if host.version < (4, 0) and name == "opaque_to_shadows":
        pytest.skip("there some of Cycles' shadow rays pass what hides light")
    assert_alike(folder, name, "MONTE_CARLO")
