"""Smoke and fire of fluid domains, in the Blenders that can simulate them: the bpy modules cannot."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from blender_host import Host, hosts

COLOR = np.array((0.8, 0.4, 0.2))


@pytest.fixture(scope="module", params=[host for host in hosts() if not host.kind.startswith("bpy")], ids=str)
def cases(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Any:
    host: Host = request.param
    folder: Path = tmp_path_factory.mktemp("smoke")
    return host.run("smoke_cases", folder)


@pytest.fixture(scope="module")
def density(cases: Any) -> np.ndarray:
    """(z, y, x), some smoke."""
    x, y, z = cases["resolution"]
    values = np.array(cases["density"]).reshape(z, y, x)
    assert values.max() > 0.5
    return values


def medium(cases: Any, name: str) -> dict[str, Any]:
    [(_, found)] = cases[name]["media"].items()
    return found


def sigma_s(found: dict[str, Any]) -> np.ndarray:
    """(z, y, x, 3)"""
    [(colour, _, _)] = found["scattering"]
    return np.array(found["density"]["values"])[..., None] * colour


def test_density_is_principleds(cases: Any, density: np.ndarray) -> None:
    found = medium(cases, "plain")
    np.testing.assert_allclose(sigma_s(found), 3 * density[..., None] * COLOR, atol=1e-5)
    np.testing.assert_allclose(
        np.divide(found["absorption"], found["scattering"][0][0]), (1 - COLOR) / COLOR, rtol=1e-4
    )
    assert found["emission_grid"] is None


def test_voxels_fill_the_domain(cases: Any, density: np.ndarray) -> None:
    """The cube is 4 m wide in its own space; values are at the voxels' centres."""
    matrix = np.array(medium(cases, "plain")["density"]["grid_from_object"])
    size = density.shape[::-1]
    np.testing.assert_allclose(matrix @ (-2, -2, -2, 1), (-0.5, -0.5, -0.5, 1), atol=1e-5)
    np.testing.assert_allclose(matrix @ (2, 2, 2, 1), (*np.subtract(size, 0.5), 1), atol=1e-5)
    k, j, i = np.unravel_index(density.argmax(), density.shape)
    assert (np.linalg.inv(matrix) @ (i, j, k, 1))[0] == pytest.approx(0.7, abs=0.7)  # where the ball burns
    assert (np.linalg.inv(matrix) @ (i, j, k, 1))[2] < 0


def test_fire_glows_by_its_temperature(cases: Any) -> None:
    found = medium(cases, "fire")
    assert found["density"] is None
    values = np.array(found["emission_grid"]["values"]) * found["emission"]
    flame = np.array(cases["flame"]).reshape(values.shape[:3])
    expected = 5.670373e-14 / np.pi * (1500 * flame) ** 4  # of luminance 1
    hot = flame > 0.75  # from 1125 K on
    assert hot.any()
    np.testing.assert_allclose(values[hot] @ (0.2126, 0.7152, 0.0722), expected[hot], rtol=0.02)
    assert not values[flame == 0].any()


def test_colors_are_those_of_the_smoke(cases: Any, density: np.ndarray) -> None:
    """Their mean by density, which is said."""
    found = medium(cases, "colored")
    color = np.array(cases["color"]).reshape(-1, 4)
    straight = color[:, :3] / np.maximum(color[:, 3:], 1e-6)
    mean = (straight * density.reshape(-1, 1)).sum(axis=0)
    np.testing.assert_allclose(sigma_s(found).sum(axis=(0, 1, 2)), mean, rtol=1e-3)
    [said] = cases["colored"]["reports"]
    assert said == (
        "Pivot: object 'domain', material 'colored': the colors of its volume vary over space, they are shown as their "
        "mean"
    )


def test_nodes_reckon_with_grids(cases: Any, density: np.ndarray) -> None:
    np.testing.assert_allclose(sigma_s(medium(cases, "info")), sigma_s(medium(cases, "colored")), atol=1e-5)
    expected = np.maximum(0.5 * density - 0.125, 0)[..., None] * COLOR
    np.testing.assert_allclose(sigma_s(medium(cases, "attribute")), expected, atol=1e-5)


def test_textures_multiply_grids(cases: Any, density: np.ndarray) -> None:
    count = density.shape[2]
    x = (np.arange(count) + 0.5) / count * 4 - 2
    expected = (density * x.clip(0))[..., None] * COLOR
    assert expected.max() > 0.1
    np.testing.assert_allclose(sigma_s(medium(cases, "textured")), expected, atol=1e-5)
    assert cases["textured"]["reports"] == []


def test_a_domain_has_no_surface(cases: Any) -> None:
    for name in ("plain", "fire", "colored", "info", "attribute", "textured"):
        assert cases[name]["without_surface"] == [f"{name} in domain"]
        assert cases[name]["instances"] == {"domain": [f"{name} in domain"]}


def test_where_there_is_none(cases: Any) -> None:
    for name in ("unlit", "off", "late"):
        assert cases[name]["instances"] == {}
    assert cases["unlit"]["reports"] == cases["off"]["reports"] == []
    [said] = cases["late"]["reports"]
    assert said.startswith("Pivot: object 'domain': it has no smoke at frame 300 and is left out. Fix: ")
