"""The exported camera sees what Blender's does."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

Inside = Callable[[str], Any]


@pytest.fixture(scope="module")
def cases(inside: Inside) -> dict[str, Any]:
    return inside("camera_cases")


def project(case: dict[str, Any]) -> np.ndarray:
    """(n, 2) view coordinates, 0..1 over the frame, of the case's points by the camera the core was given."""
    world_to_camera = np.linalg.inv(np.array(case["camera_to_world"]))
    points = np.array(case["points"]) @ world_to_camera[:3, :3].T + world_to_camera[:3, 3]
    plane = points[:, :2] / (-points[:, 2:] if case["projection"] == ["Perspective"] else 1)
    left, right, bottom, top = case["view_plane"]
    return (plane - (left, bottom)) / (right - left, top - bottom)


def test_points_project_where_blender_projects_them(cases: dict[str, Any]) -> None:
    for name, case in cases["projected"].items():
        assert case["projection"] == ["Orthographic" if "orthographic" in name else "Perspective"]
        np.testing.assert_allclose(project(case), case["blender"], atol=2e-5, err_msg=name)


def test_axes_are_unit(cases: dict[str, Any]) -> None:
    rotation = np.array(cases["projected"]["scaled"]["camera_to_world"])[:3, :3]
    np.testing.assert_allclose(rotation.T @ rotation, np.eye(3), atol=1e-6)


def test_percentage_scales_the_frame(cases: dict[str, Any]) -> None:
    assert cases["projected"]["half_size"]["frame"] == [48, 20]


def test_border_is_a_window_of_the_full_frame(cases: dict[str, Any]) -> None:
    for name in ("border", "cropped"):
        assert cases["projected"][name]["frame"] == [96, 40], name
        assert cases["projected"][name]["window"] == [24, 4, 72, 24], name
    assert cases["projected"]["wide"]["window"] == [0, 0, 96, 40]


def test_clip_distances(cases: dict[str, Any]) -> None:
    np.testing.assert_allclose(cases["projected"]["wide"]["clip"], [0.25, 70.0])


def test_stereo_eyes_stand_apart_and_converge(cases: dict[str, Any]) -> None:
    left, right = cases["stereo"]
    assert right["x"] - left["x"] == pytest.approx(0.5)
    assert left["middle"] == pytest.approx(0.0, abs=1e-5)
    assert right["middle"] == pytest.approx(0.0, abs=1e-5)


def test_panoramas_are_handed_on(cases: dict[str, Any]) -> None:
    sensor_mm = [16.0, 36.0]  # of a frame of 40 x 90 pixels
    expected = {
        "EQUIRECTANGULAR": ["Equirectangular", [-2, 1], [-0.5, 1.5]],
        "EQUIANGULAR_CUBEMAP_FACE": ["CubeMapFace"],
        "MIRRORBALL": ["MirrorBall"],
        "FISHEYE_EQUIDISTANT": ["FisheyeEquidistant", 3],
        "FISHEYE_EQUISOLID": ["FisheyeEquisolid", 12, 3, sensor_mm],
        "FISHEYE_LENS_POLYNOMIAL": ["FisheyePolynomial", [-1, -0.75, -0.5, -0.25, 0], 2, sensor_mm],
        "CENTRAL_CYLINDRICAL": ["CentralCylindrical", [-2, 1], [-0.25, 0.75]],
    }
    for name, case in cases["panoramas"].items():
        assert case["projection"] == expected[name]
        np.testing.assert_allclose(case["view_plane"], (0.25, 1.25, -0.5, 0.5), err_msg=name)


def test_depth_of_field_is_that_of_a_thin_lens(cases: dict[str, Any]) -> None:
    lenses = cases["lenses"]
    assert lenses["off"] is None
    assert {lens[0] for lens in lenses.values() if lens} == {"Lens"}
    stop = (6, 0.5, 1.5)
    for name, radius_m, focus_m in (
        ("plain", 0.05 / 4, 4),
        ("orthographic", 1 / 4, 4),
        ("nothing", 0.05 / 2e-5, 1e-5),
        ("object", 0.05 / 2e-5, 3),
        ("bone", 0.05 / 2e-5, 2),
    ):
        np.testing.assert_allclose(lenses[name][1:], (radius_m, focus_m, *stop), rtol=1e-5, err_msg=name)


def test_any_object_is_looked_through(cases: dict[str, Any]) -> None:
    """A spot with the width of its cone, other lights with that of a new spot, the rest with a lens of 50 mm."""
    for name, half_width in (
        ("empty", 18 / 50),
        ("spot", 18 / 16 * np.tan(0.5)),
        ("point", 18 / 16 * np.tan(np.radians(22.5))),
    ):
        case = cases["stand_ins"][name]
        np.testing.assert_allclose(case["view_plane"][:2], (-half_width, half_width), rtol=1e-5, err_msg=name)
        np.testing.assert_allclose(case["clip"], (1e-5, 1e5))


def test_spherical_stereo_is_said_to_be_left_out(cases: dict[str, Any]) -> None:
    assert cases["spherical_stereo"] == [
        "Pivot: camera 'Camera': Spherical Stereo is not supported, its eyes stand side by side"
    ]
