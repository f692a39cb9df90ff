"""Image textures show what Cycles shows, pixel by pixel, and what is missing is said."""

from __future__ import annotations

from typing import Any

import pytest
from blender_host import Host


@pytest.fixture(scope="module")
def cases(host: Host, tmp_path_factory: pytest.TempPathFactory) -> Any:
    return host.run("image_cases", tmp_path_factory.mktemp("images"))


def test_pictures_are_cycles(cases: Any) -> None:
    """But for a pixel or two where an edge or a seam is within Cycles' filter."""
    assert {name: case["wrong"] for name, case in cases["pictures"].items() if case["wrong"] > 1.5e-3} == {}
    assert min(case["varies"] for case in cases["pictures"].values()) > 0.1


def test_what_is_missing_is_said(cases: Any) -> None:
    said = {name: case["said"] for name, case in cases["pictures"].items() if case["said"]}
    assert set(said) == {"missing_file", "no_image", "tiles_without_one"}
    assert "nowhere.png' is not there or not an image. Fix: choose its file anew" in said["missing_file"][0]
    assert "image 'saved.png'" in said["missing_file"][0]
    assert "material 'picture', node 'Image Texture': it has no image" in said["no_image"][0]
    assert "tile.1011.png' is not there" in said["tiles_without_one"][0]


def test_a_world_lights_by_its_mean_in_the_analytic_integrator(cases: Any) -> None:
    """The surface is white."""
    assert cases["analytic"]["lit"] == pytest.approx(cases["analytic"]["mean"], rel=0.02)
    assert any("mean" in text for text in cases["analytic"]["said"])


def test_blender_keeps_no_pixels_that_it_did_not_have(cases: Any) -> None:
    assert cases["kept"] == {"has_data": False, "images": 1}
