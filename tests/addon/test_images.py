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
    assert set(said) - {"broken_file"} == {"missing_file", "no_image", "tiles_without_one"}
    assert "nowhere.png' is not there or not an image. Fix: choose its file anew" in said["missing_file"][0]
    if "broken_file" in cases["pictures"]:
        assert "broken.exr' is not there or not an image" in said["broken_file"][0]
    assert "image 'saved.png'" in said["missing_file"][0]
    assert "material 'picture', node 'Image Texture': it has no image" in said["no_image"][0]
    assert "tile.1011.png' is not there" in said["tiles_without_one"][0]
    assert "supported where its first layer is of R, G, B and A" in cases["colorless"][0]


def test_a_world_lights_by_its_mean_in_the_analytic_integrator(cases: Any) -> None:
    """The surface is white."""
    assert cases["analytic"]["lit"] == pytest.approx(cases["analytic"]["mean"], rel=0.02)
    assert any("mean" in text for text in cases["analytic"]["said"])


def test_blender_keeps_no_pixels_that_it_did_not_have(cases: Any) -> None:
    assert cases["kept"] == {"has_data": False, "images": 1}


@pytest.fixture(scope="module")
def cache(host: Host, tmp_path_factory: pytest.TempPathFactory) -> Any:
    return host.run("image_cache_cases", tmp_path_factory.mktemp("image_cache"))


def test_images_are_read_when_they_have_changed(cache: Any) -> None:
    for name, (first, again, after) in cache["edits"].items():
        assert first is not None, name
        assert again is None, name
        assert (after is None) == (name == "nothing"), name
        if name not in {"nothing", "alpha mode", "color space"}:
            assert after > first, name


def test_an_animation_reads_an_image_once(cache: Any) -> None:
    read = cache["animation"]
    assert len(read["file"]) == 1
    assert len(set(read["sequence"])) == len(read["sequence"]) == 3
    assert len(read["file again"]) == len(read["sequence again"]) == 1  # nothing was kept


def test_memory_of_an_image_that_is_not_shown_is_free(cache: Any) -> None:
    before, with_it, after = cache["memory"]
    assert with_it - before > 45
    assert after - before < 10
