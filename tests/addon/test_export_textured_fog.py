"""Fog that nodes vary within an object becomes voxels of the object."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

COLOR = np.array((0.8, 0.4, 0.2))


@pytest.fixture(scope="module")
def cases(inside: Callable[[str], Any]) -> Any:
    return inside("textured_fog_cases")


def medium(cases: Any, case: str, name: str = "fog in box") -> dict[str, Any]:
    return cases[case]["media"][name]


def ramp(voxels: dict[str, Any]) -> np.ndarray:
    """What the nodes give at the voxels."""
    return np.clip((np.array(voxels["places"])[:, 0] + 1) / 2, 0, 1)


def test_a_density_that_varies(cases: Any) -> None:
    found = medium(cases, "density")
    [(sigma_s, anisotropy, _)] = found["scattering"]
    voxels = found["density"]
    assert anisotropy == pytest.approx(0.5)
    assert voxels["size"] == [65, 65, 128]  # as far apart along each side
    np.testing.assert_allclose(np.outer(voxels["values"], sigma_s), np.outer(ramp(voxels), COLOR), atol=1e-5)
    np.testing.assert_allclose(found["absorption"], np.array(sigma_s) * (1 - COLOR) / COLOR, rtol=1e-4)
    assert cases["density"]["reports"] == []
    assert found["emission_grid"] is None


def test_a_glow_that_varies(cases: Any) -> None:
    found = medium(cases, "glow")
    voxels = found["emission_grid"]
    np.testing.assert_allclose(np.array(voxels["values"]) * found["emission"], np.outer(ramp(voxels), COLOR), atol=1e-5)
    np.testing.assert_allclose(found["scattering"][0][0], COLOR, rtol=1e-5)
    assert found["density"] is None
    assert cases["glow"]["reports"] == []


def test_what_no_one_density_multiplies_is_said(cases: Any) -> None:
    """The extinction is right everywhere, and what is scattered of it on the whole."""
    found = medium(cases, "mixed")
    np.testing.assert_allclose(found["density"]["values"], 1, rtol=1e-5)  # both take half everywhere
    [(sigma_s, _, _)] = found["scattering"]
    np.testing.assert_allclose(np.add(sigma_s, found["absorption"]), 0.5, rtol=1e-4)
    np.testing.assert_allclose(sigma_s, 0.25, rtol=1e-2)
    found = medium(cases, "colored")
    voxels, [(sigma_s, _, _)] = found["density"], found["scattering"]
    np.testing.assert_allclose(np.array(voxels["values"]) * sum(sigma_s), ramp(voxels) + 0.5, rtol=2e-2)
    said = "Pivot: object 'box', material 'fog': the colors of its volume vary over space, they are shown as their mean"
    assert cases["mixed"]["reports"] == cases["colored"]["reports"] == [said]


def test_each_object_has_its_own(cases: Any) -> None:
    assert cases["shared"]["instances"] == [["short", ["fog in short"]], ["long", ["fog in long"]]]
    for name, low in (("fog in short", -2), ("fog in long", -6)):
        found = medium(cases, "shared", name)
        voxels = found["density"]
        assert voxels["places"][0][0] == pytest.approx(low)
        sigma_s = np.array(voxels["values"]) * found["scattering"][0][0][0]
        np.testing.assert_allclose(sigma_s, 0.8 * ramp(voxels), atol=1e-5)


def test_what_is_the_same_within_an_object_needs_no_voxels(cases: Any) -> None:
    for index in (2, 3):
        found = medium(cases, "same", f"fog in box {index}")
        np.testing.assert_allclose(found["scattering"][0][0], index * COLOR, rtol=1e-5)
        assert found["density"] is None


def test_instances_are_filled_as_the_first(cases: Any) -> None:
    said = "Pivot: object 'box': its volume depends on where it is, its instances are filled as the first"
    assert said in cases["placed"]["reports"]


def test_a_world_that_varies_is_its_mean(cases: Any) -> None:
    assert medium(cases, "world", "world")["density"] is None
    [said] = cases["world"]["reports"]
    assert said.endswith(": Density varies over space, it is shown as its mean")
