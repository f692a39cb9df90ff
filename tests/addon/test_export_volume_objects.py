"""Volume objects reach the core as their OpenVDB files have them; elsewhere they are reported by name."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from blender_host import Host

VOXEL_M, LOW = 0.25, np.array((-2, 3, 1))


@pytest.fixture(scope="module")
def cases(inside: Callable[[str], Any]) -> Any:
    return inside("volume_object_cases")


@pytest.fixture(scope="module")
def clouds(cases: Any) -> Any:
    """Where the Blender has a module that reads them; Debian's python3-openvdb is one for Debian's Blender."""
    if not cases["has_module"]:
        pytest.skip("this Blender's Python has no openvdb")
    return cases


def sigma_s(case: dict[str, Any]) -> np.ndarray:
    """(z, y, x) of grey smoke."""
    [(_, medium)] = case["media"].items()
    [((red, _, _), _, _)] = medium["scattering"]
    return np.array(medium["density"]["values"]) * red


def density(clouds: Any) -> np.ndarray:
    """(z, y, x)"""
    return np.array(clouds["density"]).transpose(2, 1, 0)


def object_from_grid(grid: dict[str, Any]) -> np.ndarray:
    return np.linalg.inv(grid["grid_from_object"])


def test_without_a_module_the_fix_is_said(cases: Any) -> None:
    [said] = cases["lacking"]
    assert said.startswith("Pivot: object 'cloud': this Blender's Python has no module to read OpenVDB files")
    assert "Fix: " in said


def test_density(clouds: Any) -> None:
    """A Principled Volume of grey 0.5; the object is twice as large, and so half as dense unless in World space."""
    for name, factor in (
        ("plain", 0.5 * 3 / 2),
        ("bare", 0.5 / 2),
        ("world_space", 0.5 * 3),
        ("sequence", 0.5 * 3 / 2),
    ):
        np.testing.assert_allclose(sigma_s(clouds[name]), factor * density(clouds), rtol=1e-5, err_msg=name)
        assert clouds[name]["reports"] == []
        [material] = clouds[name]["without_surface"]
        assert clouds[name]["instances"] == {"cloud": [material]}


def test_voxels_are_where_the_file_has_them(host: Host, clouds: Any) -> None:
    """As Cycles of the same version reads them: before 5.0 half a voxel further."""
    [(_, medium)] = clouds["plain"]["media"].items()
    centre = 0 if host.version >= (5, 0) else 0.5
    for index in ((0, 0, 0), (3, 2, 1)):
        place = object_from_grid(medium["density"]) @ (*index, 1)
        np.testing.assert_allclose(place[:3], VOXEL_M * (LOW + index + centre), atol=1e-6)


def test_the_box_holds_all_and_looks_out(clouds: Any) -> None:
    case = clouds["plain"]
    [(_, medium)] = case["media"].items()
    [[positions, corners]] = case["meshes"].values()
    positions = np.array(positions)
    low, high = (object_from_grid(medium["density"]) @ (*ends, 1) for ends in ((-1, -1, -1), (4, 3, 2)))
    np.testing.assert_allclose(positions.min(axis=0), low[:3], atol=1e-5)
    np.testing.assert_allclose(positions.max(axis=0), high[:3], atol=1e-5)
    a, b, c = (positions[np.array(corners)[np.array(case["triangles"][0])]][:, i] for i in range(3))
    normals = np.cross(b - a, c - a)
    assert len(normals) == 12
    assert (np.einsum("ij,ij->i", normals, a - positions.mean(axis=0)) > 0).all()
    np.testing.assert_allclose(np.linalg.norm(normals, axis=1).sum() / 2, 2 * (1.25 * 1 + 1 * 0.75 + 0.75 * 1.25))


def test_grids_of_two_resolutions_meet(clouds: Any) -> None:
    """On the finer one's lattice, which covers both: the sums of what it holds stay."""
    fine = sigma_s(clouds["fire"])
    [(_, medium)] = clouds["fire"]["media"].items()
    assert np.linalg.det(np.array(medium["density"]["grid_from_object"])[:3, :3]) == pytest.approx((2 / VOXEL_M) ** 3)
    coarse = 0.75 * density(clouds)
    assert fine.sum() / 8 == pytest.approx(coarse.sum(), rel=1e-5)
    glow = np.array(medium["emission_grid"]["values"])
    assert (glow > 0.99 * glow.max(axis=(0, 1, 2))).all(axis=-1).sum() == 8  # the temperature's voxels


def test_what_cannot_be_shown_is_said(clouds: Any) -> None:
    [missing] = clouds["missing"]["reports"]
    assert missing.startswith("Pivot: object 'cloud': there is no file '")
    assert "nowhere.vdb', it is left out. Fix: " in missing
    assert clouds["generated"]["reports"] == [
        "Pivot: object 'cloud': volumes that modifiers or geometry nodes make are not supported, it is left out"
    ]
    for name in ("missing", "generated", "unread"):
        assert clouds[name]["instances"] == {}
