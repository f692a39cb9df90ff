"""Shadow catchers do in Pivot's pictures, passes and alpha what they do in Cycles'."""

from __future__ import annotations

from pathlib import Path

import pytest
from beside_cycles import FLIP, TOLERANCE, flip
from blender_host import Host
from exr import passes_by_name

CASES = ("over_world", "over_nothing", "beside", "foggy_world", "foggy", "fisheye")


@pytest.fixture(scope="module")
def folder(host: Host, tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("catchers")
    assert host.run("catcher_cases", folder) == list(CASES)
    return folder


@pytest.mark.parametrize(
    ("name", "pass_name", "integrator"),
    [
        *((name, "Combined", "MONTE_CARLO") for name in CASES),
        *(("beside", "Shadow Catcher", integrator) for integrator in ("MONTE_CARLO", "ANALYTIC")),
    ],
)
def test_passes_are_cycles(folder: Path, name: str, pass_name: str, integrator: str) -> None:
    ours, cycles = (passes_by_name(folder / f"{name}_{engine}.exr")[pass_name] for engine in (integrator, "CYCLES"))
    assert ours.shape == cycles.shape
    assert ours.mean(axis=(0, 1)) == pytest.approx(cycles.mean(axis=(0, 1)), rel=TOLERANCE)
    if ours.shape[-1] == 4:  # premultiplied: over grey, so that alpha counts
        ours, cycles = (p[..., :3] + 0.5 * (1 - p[..., 3:]) for p in (ours, cycles))
    assert flip(ours, cycles) <= FLIP
