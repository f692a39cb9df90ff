"""Passes hold what Cycles' hold, in one Blender, and sum to Combined as these do."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import OpenEXR
import pytest
from beside_cycles import FLIP, flip
from blender_host import Host
from exr import passes_by_name
from pass_names import LIGHT, Passes, colored, with_old_names

DATA = ("DiffCol", "TransCol", "Emit", "Env", "UV", "Mist", "AO")


@pytest.fixture(scope="module")
def folder(host: Host, tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("passes")
    host.run("pass_cases", folder)
    return folder


@pytest.fixture(scope="module")
def headers(folder: Path) -> dict[str, dict[str, str]]:
    headers = {}
    for engine in ("CYCLES", "MONTE_CARLO"):
        with OpenEXR.File(str(folder / f"{engine}.exr"), separate_channels=True) as file:
            headers[engine] = dict(file.parts[0].header)
    return headers


@pytest.fixture(scope="module")
def pictures(folder: Path) -> dict[str, Passes]:
    return {
        engine: with_old_names(passes_by_name(folder / f"{engine}.exr"))
        for engine in ("CYCLES", "MONTE_CARLO", "ANALYTIC")
    }


@pytest.mark.parametrize("name", [*LIGHT, *DATA])
def test_passes_are_cycles(host: Host, pictures: dict[str, Passes], name: str) -> None:
    if host.version < (4, 0) and name == "TransCol":
        pytest.skip("Cycles' colour of glass has no Fresnel in it there")
    cycles, ours = (colored(pictures[engine], name) for engine in ("CYCLES", "MONTE_CARLO"))
    noise = 0.02 if name.endswith("Ind") else 0.01
    np.testing.assert_allclose(ours.mean((0, 1)), cycles.mean((0, 1)), rtol=noise, atol=1e-4)
    if cycles.shape[-1] == 3:
        assert flip(ours, cycles) <= FLIP


@pytest.mark.parametrize("engine", ["CYCLES", "MONTE_CARLO"])
def test_passes_sum_to_combined(pictures: dict[str, Passes], engine: str) -> None:
    passes = pictures[engine]
    total = passes["Emit"] + passes["Env"] + sum(colored(passes, name) for name in LIGHT)
    np.testing.assert_allclose(total, passes["Combined"][..., :3], rtol=1e-4, atol=1e-5)


@pytest.mark.parametrize("engine", ["MONTE_CARLO", "ANALYTIC"])
def test_indices_are_what_the_centre_meets(pictures: dict[str, Passes], engine: str) -> None:
    for name in ("IndexOB", "IndexMA"):
        np.testing.assert_array_equal(pictures[engine][name], pictures["CYCLES"][name])


@pytest.mark.parametrize("engine", ["MONTE_CARLO", "ANALYTIC"])
@pytest.mark.parametrize("kind", ["Object", "Material", "Asset"])
def test_mattes_rank_what_cycles_does(pictures: dict[str, Passes], kind: str, engine: str) -> None:
    """The ids are the same, and each has about the same share of the picture and of each pixel."""
    shares = [_shares(pictures[name], kind) for name in ("CYCLES", engine)]
    assert set(shares[0]) == set(shares[1])
    for id_, share in shares[0].items():
        np.testing.assert_allclose(shares[1][id_], share, atol=0.08)
        assert shares[1][id_].mean() == pytest.approx(share.mean(), rel=0.01)


def _shares(passes: Passes, kind: str) -> dict[float, np.ndarray]:
    """What each id has of each pixel."""
    ranks = np.concatenate([passes[f"Crypto{kind}{number:02d}"] for number in range(3)], axis=-1)
    ids, weights = ranks[..., 0::2], ranks[..., 1::2]
    return {float(id_): np.where(ids == id_, weights, 0).sum(-1) for id_ in np.unique(ids[weights > 0])}


def test_mattes_have_their_names_in_the_file(pictures: dict[str, Passes], headers: dict[str, dict[str, str]]) -> None:
    found = {engine: {k: v for k, v in header.items() if "crypto" in k} for engine, header in headers.items()}
    assert len(found["CYCLES"]) == 12
    for field, value in found["CYCLES"].items():
        ours = found["MONTE_CARLO"][field]
        if field.endswith("manifest"):  # Cycles' has what no surface is made of, too
            assert json.loads(ours).items() <= json.loads(value).items(), field
            assert len(json.loads(ours)) >= 2
        else:
            assert ours == value, field


def test_the_analytic_integrator_sees_the_same_surfaces(pictures: dict[str, Passes]) -> None:
    for name in ("DiffCol", "GlossCol", "TransCol", "Env", "UV", "Mist"):
        np.testing.assert_allclose(
            pictures["ANALYTIC"][name].mean((0, 1)), pictures["MONTE_CARLO"][name].mean((0, 1)), rtol=0.01
        )
    assert not pictures["ANALYTIC"]["DiffDir"].any()  # said in a warning
