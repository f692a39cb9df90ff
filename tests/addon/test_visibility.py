"""Pivot and Cycles, in one Blender, agree on what lights light and on what rays meet."""

from __future__ import annotations

from pathlib import Path

import pytest
from beside_cycles import assert_alike
from blender_host import Host

CASES = ("unshadowed", "spread", "excluded", "few_bounces", "hidden", "holdout", "indirect_only")


@pytest.fixture(scope="module")
def folder(host: Host, tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("visibility")
    assert host.run("visibility_cases", folder) == list(CASES)
    return folder


@pytest.mark.parametrize(
    ("integrator", "name"),
    [("MONTE_CARLO", name) for name in CASES] + [("direct_ANALYTIC", name) for name in CASES if name != "hidden"],
)
def test_pictures_are_cycles(folder: Path, integrator: str, name: str) -> None:
    assert_alike(folder, name, integrator)
