"""Lights reach the core in Cycles' units."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from blender_host import Host

PI = math.pi


@pytest.fixture(scope="module")
def cases(inside: Callable[[str], Any]) -> Any:
    return inside("light_cases")


@pytest.fixture(scope="module")
def lights(cases: Any) -> Any:
    return cases["lights"]


@pytest.fixture(scope="module")
def exitance(host: Host) -> float:
    """W/m^2 of an area light per radiance, as its Blender's Cycles has it."""
    return PI if host.version >= (4, 0) else 4.0


def close(actual: Any, expected: Any) -> None:
    np.testing.assert_allclose(actual, expected, rtol=1e-5, atol=1e-6)


def test_point(lights: Any) -> None:
    point = lights["point"]
    assert point["type"] == "SphereLight"
    close(point["position"], (1, 2, 3))
    close(point["radius_m"], 0.3)
    close(point["intensity"], np.array((100, 50, 25)) / (4 * PI))
    close(lights["tiny"]["radius_m"], 0)
    close(lights["tiny"]["intensity"], np.full(3, 10 / (4 * PI)))
    close(lights["scaled"]["radius_m"], 0.3)


def test_spot(lights: Any) -> None:
    spot = lights["spot"]
    assert spot["type"] == "SpotLight"
    close(spot["intensity"], np.full(3, 40 / (4 * PI)))
    close(spot["direction"], (0, 0, -1))
    close(spot["cos_half_angle"], math.cos(math.radians(25)))
    close(spot["blend"], 0.2)
    close(lights["turned"]["direction"], (0, 1, 0))


def test_soft_falloff_is_a_disk_and_old_spots_fall_off_by_their_cosine(host: Host, lights: Any) -> None:
    """As by default from Blender 4.1, and the only way before 4.0."""
    assert lights["point"]["facing_disk"]
    assert lights["spot"]["facing_disk"]
    assert lights["spot"]["cosine"] is (host.version < (4, 0))
    assert ("sphere" in lights) is (host.version >= (4, 1))
    if "sphere" in lights:
        assert not lights["sphere"]["facing_disk"]
        assert not lights["sphere_spot"]["facing_disk"]


def test_sun(lights: Any) -> None:
    sun = lights["sun"]
    assert sun["type"] == "SunLight"
    close(sun["direction"], (1, 0, 0))
    close(sun["half_angle_rad"], 0.1)
    close(sun["irradiance"], (3, 3, 1.5))


@pytest.mark.parametrize(
    ("name", "area_m2", "half_sizes", "ellipse"),
    [
        ("square", 4, (1, 1), False),
        ("rectangle", 1, (1, 0.25), False),
        ("disk", PI, (1, 1), True),
        ("ellipse", PI / 4, (1, 0.25), True),
        ("stretched", 6, (1, 1.5), False),
        ("mirrored", 1, (0.5, 0.5), False),
    ],
)
def test_area(
    lights: Any, exitance: float, name: str, area_m2: float, half_sizes: tuple[float, float], ellipse: bool
) -> None:
    area = lights[name]
    assert area["type"] == "AreaLight"
    assert area["ellipse"] is ellipse
    close(area["radiance"], np.full(3, 12 / (exitance * area_m2)))
    half_u, half_v = np.array(area["half_u"]), np.array(area["half_v"])
    close(np.abs(half_u + half_v), (*half_sizes, 0))
    normal = np.cross(half_u, half_v)
    close(normal / np.linalg.norm(normal), (0, 0, -1))


def test_a_light_is_there_for_what_it_says(host: Host, lights: Any, cases: Any) -> None:
    close(lights["beam"]["spread_rad"], 1)
    close(lights["square"]["spread_rad"], PI)
    rules = cases["rules"]
    assert rules["square"] == [[], 1024]
    assert rules["beam"] == [["DIFFUSE", "VOLUME_SCATTER"], 1024]
    assert rules["unshadowed"] == [["SHADOW"], 2]


def test_area_shines_along_its_own_minus_z(lights: Any) -> None:
    assert np.cross(lights["inverted"]["half_u"], lights["inverted"]["half_v"])[2] > 0


def test_lights_without_light_are_left_out(lights: Any) -> None:
    assert "flat" not in lights
    assert "hidden" not in lights
    assert "portal" not in lights


def test_light_nodes_multiply(lights: Any) -> None:
    close(lights["shaded"]["intensity"], (1.5, 0.75, 3))


def test_exposure_temperature_and_normalize(host: Host, lights: Any) -> None:
    if host.version < (4, 4):
        assert "exposed" not in lights
        return
    close(lights["exposed"]["intensity"], (8, 8, 8))
    red, green, blue = lights["warm"]["intensity"]
    assert red > 1 > green > blue > 0
    close(lights["raw_point"]["intensity"], np.full(3, 8 * 0.5**2))
    close(lights["raw_tiny"]["intensity"], np.ones(3))
    close(lights["raw_area"]["radiance"], np.ones(3))
    close(lights["raw_sun"]["irradiance"], np.full(3, 2 * PI * math.sin(0.3) ** 2))


def test_what_is_left_out_is_said_once_a_job(host: Host, cases: Any) -> None:
    said = [
        "light 'unseen': Multiple Importance Sample is not supported, mirrors show it all the same",
        "light 'oval': an uneven Scale is not supported, the cone is round and as wide as its Spot Size",
        "light 'slanted': its transform is sheared, it shines from the slanted shape as a mesh would. "
        "Fix: give its parents an even Scale",
        "object 'panel', material 'glow': in the analytic integrator its triangles light others by a mean of each, "
        "in grey. Fix: use Monte Carlo",
        "object 'pane of window', material 'window': in the analytic integrator lamps do not shine through its rough "
        "glass. Fix: use Monte Carlo",
        "scene 'Scene': Clamp Direct is not supported, nothing is clamped",
    ]
    assert sorted(cases["reports"]) == sorted(f"Pivot: {text}" for text in said)


def test_negative_light_is_handed_on(cases: Any) -> None:
    close(cases["negative"]["power"], (-1, -1, -1))
    close(cases["negative"]["nodes"], (-3, -3, -3))
    close(cases["negative"]["world"], (-1, 0, -0.5))


def test_light_that_varies_has_a_shader(cases: Any) -> None:
    """Its strength is then the mean of what that leaves, here taken for 3."""
    close(cases["varying"]["far"], (3, 3, 3))
    assert cases["varying"]["shaded"] == ["far", "seen"]
    assert cases["varying"]["reports"] == []


def test_world(cases: Any) -> None:
    worlds = cases["worlds"]
    close(worlds["none"], (0, 0, 0))
    close(worlds["constant"], (0.2, 0.4, 0.6))
    assert worlds["constant_reports"] == []
    assert worlds["image"] == ["emission"]
    assert worlds["image_reports"] == []
    close(worlds["no_sky"], (0, 0, 0))
