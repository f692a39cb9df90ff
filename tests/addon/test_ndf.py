"""Pictures of microfacets in Blender: made, saved, read, shown in the panel, and seen by a render."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest


@pytest.fixture(scope="module")
def cases(inside: Callable[[str], Any]) -> Any:
    return inside("ndf_cases")


def test_a_distribution_is_drawn_and_set(cases: Any) -> None:
    made = cases["made"]
    assert made["before"] == [False, True]
    assert made["draw"] == ["FINISHED"]
    assert made["use"]
    assert made["name"] == "cloth NDF"
    assert made["color space"]
    assert made["is as drawn"]


def test_a_weave_has_its_peaks_in_pairs(cases: Any) -> None:
    assert cases["made"]["weave"] == ["FINISHED"]
    assert cases["made"]["peaks"] < 0.2  # of the brightest, at the surface's own normal
    assert cases["made"]["twin"] < 1e-5


def test_the_picture_is_saved_with_the_file(cases: Any) -> None:
    assert cases["saved"] == [True, True]


@pytest.mark.parametrize(
    ("name", "normal"),
    [
        ("opengl", (0.5 / 0.99, 0.3 / 0.99)),
        ("directx", (0.5 / 0.99, -0.3 / 0.99)),
        ("rough", (0.5 / 0.99, 0.3 / 0.99)),
        ("height", (0.0, -0.5 / 1.25**0.5)),
    ],
)
def test_a_maps_normal_is_where_it_points(cases: Any, name: str, normal: tuple[float, float]) -> None:
    pixel = 2 / 128
    assert cases["map"][name] == pytest.approx(normal, abs=pixel)


def test_what_is_wrong_with_a_map_is_said(cases: Any) -> None:
    said = cases["errors"]
    assert "no image is chosen to take normals from. Fix: choose a" in said[""]
    assert "there is no image 'nowhere'" in said["nowhere"]
    assert "image 'inward': 16 of its 16 texels look into the surface" in said["inward"]
    assert "image 'colors': its numbers are colors of the space sRGB. Fix: set its Color Space" in said["colors"]
    assert "image 'holes': some of its pixels are not finite" in said["holes"]
    assert "image 'missing': it has no pixels. Fix: choose its file anew" in said["missing"]
    assert said["untouched"]
    assert said["poll"] is False


def test_images_are_read_as_they_are_stored_and_colors_made_linear(cases: Any) -> None:
    read = cases["read"]
    assert read["floats"] == [pytest.approx([0, 0.6]), pytest.approx([1.2, 3])]
    assert read["numbers"] == [pytest.approx([0, 0.2]), pytest.approx([0.4, 1])]
    assert read["colors"] == [pytest.approx([0, 0.033105], rel=1e-3), pytest.approx([0.132868, 1], rel=1e-3)]
    assert not read["numbers kept"]
    assert not read["colors kept"]


def test_an_image_that_cannot_be_read_is_named(cases: Any) -> None:
    kind, text = cases["read"]["missing"]
    assert kind == "RenderError"
    assert text == "image 'missing': it has no pixels. Fix: choose its file anew, or another image"
    kind, text = cases["read"]["tiles"]
    assert kind == "RenderError"
    assert text.startswith("image 'tiles': its source is UDIM")


def test_the_panel_shows_the_image_and_the_buttons(cases: Any) -> None:
    assert cases["drawn"]["polls"] == [True, False, False]
    without, with_image = cases["drawn"]["shown"]
    buttons = ["pivot.ndf_draw", "pivot.ndf_weave", "pivot.ndf_from_map"]
    assert without == ["use_ndf_image", "ndf_image", *buttons]
    assert with_image == ["use_ndf_image", "ndf_image", "icon 64", *buttons]


def test_a_render_sees_the_settings_and_the_viewport_is_told(cases: Any) -> None:
    assert cases["evaluated"] == {"told": True, "seen": [[True, "cloth NDF"], [False, "cloth NDF"]]}
