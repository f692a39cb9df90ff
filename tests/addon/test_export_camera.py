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
    plane = points[:, :2] / -points[:, 2:]
    left, right, bottom, top = case["view_plane"]
    return (plane - (left, bottom)) / (right - left, top - bottom)


def test_points_project_where_blender_projects_them(cases: dict[str, Any]) -> None:
    for name, case in cases.items():
        if name != "stereo":
            np.testing.assert_allclose(project(case), case["blender"], atol=2e-5, err_msg=name)


def test_axes_are_unit(cases: dict[str, Any]) -> None:
    rotation = np.array(cases["scaled"]["camera_to_world"])[:3, :3]
    np.testing.assert_allclose(rotation.T @ rotation, np.eye(3), atol=1e-6)


def test_percentage_scales_the_frame(cases: dict[str, Any]) -> None:
    assert cases["half_size"]["frame"] == [48, 20]


def test_border_is_a_window_of_the_full_frame(cases: dict[str, Any]) -> None:
    for name in ("border", "cropped"):
        assert cases[name]["frame"] == [96, 40], name
        assert cases[name]["window"] == [24, 4, 72, 24], name
    assert cases["wide"]["window"] == [0, 0, 96, 40]


def test_clip_distances(cases: dict[str, Any]) -> None:
    np.testing.assert_allclose(cases["wide"]["clip"], [0.25, 70.0])


def test_stereo_eyes_stand_apart_and_converge(cases: dict[str, Any]) -> None:
    left, right = cases["stereo"]
    assert right["x"] - left["x"] == pytest.approx(0.5)
    assert left["middle"] == pytest.approx(0.0, abs=1e-5)
    assert right["middle"] == pytest.approx(0.0, abs=1e-5)
