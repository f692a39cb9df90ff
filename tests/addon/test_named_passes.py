"""The light of groups, and what shaders give to AOVs: Pivot's passes are Cycles', in one Blender."""

from __future__ import annotations

import numpy as np
import pytest
from beside_cycles import FLIP, flip
from blender_host import Host
from exr import passes_by_name

Passes = dict[str, np.ndarray]
GROUPS = ("key", "panel", "sky", "nobody's")
AOVS = ("tint", "height")


@pytest.fixture(scope="module")
def pictures(host: Host, tmp_path_factory: pytest.TempPathFactory) -> dict[str, Passes]:
    folder = tmp_path_factory.mktemp("named")
    host.run("named_cases", folder)
    return {engine: passes_by_name(folder / f"{engine}.exr") for engine in ("CYCLES", "MONTE_CARLO", "ANALYTIC")}


@pytest.mark.parametrize(("engine", "tolerance"), [("MONTE_CARLO", 0.01), ("ANALYTIC", 0.02)])
@pytest.mark.parametrize("name", GROUPS)
def test_light_groups_are_cycles(pictures: dict[str, Passes], name: str, engine: str, tolerance: float) -> None:
    cycles, ours = (pictures[each][f"Combined_{name}"] for each in ("CYCLES", engine))
    np.testing.assert_allclose(ours.mean((0, 1)), cycles.mean((0, 1)), rtol=tolerance, atol=1e-6)
    assert flip(ours, cycles) <= FLIP


@pytest.mark.parametrize("engine", ["MONTE_CARLO", "ANALYTIC"])
@pytest.mark.parametrize("name", AOVS)
def test_aovs_are_cycles(pictures: dict[str, Passes], name: str, engine: str) -> None:
    cycles, ours = (pictures[each][name] for each in ("CYCLES", engine))
    assert ours.shape == cycles.shape
    assert np.abs(cycles).mean() > 0.1
    np.testing.assert_allclose(ours.mean((0, 1)), cycles.mean((0, 1)), rtol=0.01, atol=0.005)
    assert np.median(np.abs(ours - cycles)) <= 0.01


def test_groups_and_what_is_in_none_sum_to_combined(pictures: dict[str, Passes]) -> None:
    passes = pictures["MONTE_CARLO"]
    rest = passes["Combined"][..., :3] - sum(passes[f"Combined_{name}"] for name in GROUPS)
    cycles = pictures["CYCLES"]
    rest_of_cycles = cycles["Combined"][..., :3] - sum(cycles[f"Combined_{name}"] for name in GROUPS)
    assert rest.min() >= -1e-4
    np.testing.assert_allclose(rest.mean((0, 1)), rest_of_cycles.mean((0, 1)), rtol=0.015)  # the lamp without a group
