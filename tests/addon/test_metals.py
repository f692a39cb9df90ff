"""Pivot and Cycles, in one Blender, agree on anisotropic highlights, other microfacets, coats and metals."""

from __future__ import annotations

from pathlib import Path

import pytest
from beside_cycles import assert_alike
from blender_host import Host

CASES = {"brushed": (3, 4), "facets": (3, 4), "coats": (4, 0), "metals": (4, 3)}  # from which Blender on


@pytest.fixture(scope="module")
def folder(host: Host, tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("metals")
    assert host.run("metal_cases", folder) == [name for name, version in CASES.items() if host.version >= version]
    return folder


@pytest.mark.parametrize("name", CASES)
@pytest.mark.parametrize("integrator", ["MONTE_CARLO", "direct_ANALYTIC"])
def test_pictures_are_cycles(host: Host, folder: Path, name: str, integrator: str) -> None:
    if host.version < CASES[name]:
        assert not (folder / f"{name}_CYCLES.exr").exists()
        return
    assert_alike(folder, name, integrator)
