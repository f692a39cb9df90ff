"""Cameras: a projection's rays are those of its formula, shaders find their way back, a lens blurs as one does."""

from __future__ import annotations

from typing import Any

import numpy as np
import pivot_core
import pytest

from tests.core.scenes import Floats, add_plane, add_sphere, look_at, place, render

WIDTH, HEIGHT = 24, 16
X, Y = np.meshgrid((np.arange(WIDTH) + 0.5) / WIDTH, (np.arange(HEIGHT) + 0.5) / HEIGHT)  # of pixels, over the frame
UNIT = (0.0, 1.0, 0.0, 1.0)
CAMERA = look_at((1.0, -2.0, 0.5), (3.0, 4.0, 2.0))
SENSOR_MM = (36.0, 24.0)
CENTERS = {"samples": 1, "filter_width_px": 0.0}


def around(angle: Floats, x: Floats, y: Floats) -> tuple[Floats, ...]:
    """At an angle from the axis, towards (x, y) of the picture."""
    radius = np.maximum(np.hypot(x, y), 1e-9)
    return np.sin(angle) * x / radius, np.sin(angle) * y / radius, -np.cos(angle)


def globe(longitude: Floats, latitude: Floats) -> tuple[Floats, ...]:
    return np.cos(latitude) * np.sin(longitude), np.sin(latitude), -np.cos(latitude) * np.cos(longitude)


def fisheye(u: Floats, v: Floats) -> tuple[Floats, ...]:
    x, y = 2 * u - 1, 2 * v - 1
    return around(0.5 * 3.0 * np.hypot(x, y), x, y)


def equisolid(u: Floats, v: Floats) -> tuple[Floats, ...]:
    x, y = (u - 0.5) * SENSOR_MM[0], (v - 0.5) * SENSOR_MM[1]
    return around(2 * np.arcsin(np.minimum(np.hypot(x, y) / 21, 1)), x, y)


def polynomial(u: Floats, v: Floats) -> tuple[Floats, ...]:
    x, y = (u - 0.5) * SENSOR_MM[0], (v - 0.5) * SENSOR_MM[1]
    radius = np.hypot(x, y)
    return around(0.01 + 0.06 * radius + 0.0004 * radius**2 + 2e-5 * radius**3 + 1e-7 * radius**4, x, y)


def mirrored(u: Floats, v: Floats) -> tuple[Floats, ...]:
    """The ball is seen along -z, and its normal halves the angle between the view and what is reflected."""
    x, y = 2 * u - 1, 2 * v - 1
    z = np.sqrt(np.maximum(1 - x * x - y * y, 0))
    return 2 * z * x, 2 * z * y, 1 - 2 * z * z  # 2 (n.v) n - v, mirrored in depth


# The core's, its picture's plane, and the direction in camera space at a place of it.
PANORAMAS: dict[str, tuple[Any, tuple[float, ...], Any]] = {
    "perspective": (None, (-0.5, 0.7, -0.3, 0.5), lambda u, v: (u, v, -np.ones_like(u))),
    "equirectangular": (
        pivot_core.Equirectangular((-2.0, 2.5), (-1.2, 1.0)),
        (0.1, 1.0, -0.1, 0.9),
        lambda u, v: globe(-2 + 4.5 * u, -1.2 + 2.2 * v),
    ),
    "cylinder": (
        pivot_core.CentralCylindrical((-2.0, 1.5), (-0.8, 1.2)),
        UNIT,
        lambda u, v: (np.sin(-2 + 3.5 * u), -0.8 + 2 * v, -np.cos(-2 + 3.5 * u)),
    ),
    "fisheye": (pivot_core.FisheyeEquidistant(3.0), UNIT, fisheye),
    "equisolid": (pivot_core.FisheyeEquisolid(10.5, 3.0, SENSOR_MM), UNIT, equisolid),
    "polynomial": (
        pivot_core.FisheyePolynomial((-0.01, -0.06, -4e-4, -2e-5, -1e-7), 2.8, SENSOR_MM),
        UNIT,
        polynomial,
    ),
    "cube": (
        pivot_core.CubeMapFace(),
        UNIT,
        lambda u, v: (np.tan((u - 0.5) * np.pi / 2), np.tan((v - 0.5) * np.pi / 2), -np.ones_like(u)),
    ),
    "mirror ball": (pivot_core.MirrorBall(), UNIT, mirrored),
}


def sky(op: str) -> pivot_core.Scene:
    """All around shines what an op gives."""
    scene = pivot_core.Scene()
    program = pivot_core.Program()
    x = program.add(op, [])
    scene.set_world_shader(pivot_core.Shader(pivot_core.Material(), program, {"emission": [x, x + 1, x + 2]}))
    return scene


def directions(name: str) -> tuple[Floats, Floats]:
    """World space, by the formula, and whether the picture shows any there."""
    _, (left, right, bottom, top), formula = PANORAMAS[name]
    u, v = left + (right - left) * X, bottom + (top - bottom) * Y
    local = np.stack(formula(u, v), -1)
    seen = {
        "fisheye": np.hypot(2 * u - 1, 2 * v - 1) <= 1,
        "equisolid": np.hypot((u - 0.5) * 36, (v - 0.5) * 24) <= 21 * np.sin(0.75),
        "polynomial": np.arccos(np.clip(-local[..., 2], -1, 1)) <= 1.4,
        "mirror ball": np.hypot(2 * u - 1, 2 * v - 1) <= 1,
    }.get(name, np.ones_like(u, bool))
    return local @ CAMERA[:3, :3].T / np.linalg.norm(local, axis=-1, keepdims=True), seen


@pytest.mark.parametrize("name", PANORAMAS)
def test_rays_are_those_of_the_formula(name: str) -> None:
    scene = sky("position")
    projection, plane, _ = PANORAMAS[name]
    scene.set_camera(CAMERA, plane, WIDTH, HEIGHT, projection=projection)
    expected, seen = directions(name)
    picture = render(scene, **CENTERS)
    assert seen.mean() > 0.3
    np.testing.assert_allclose(picture[seen][:, :3], expected[seen], atol=2e-5)
    np.testing.assert_array_equal(picture[~seen], np.broadcast_to((0, 0, 0, 1), picture[~seen].shape))


@pytest.mark.parametrize("name", PANORAMAS)
@pytest.mark.parametrize("on_surfaces", [False, True])
def test_window_coordinates_are_those_of_the_pixel(name: str, on_surfaces: bool) -> None:
    """Also on a ball around the camera."""
    scene = sky("window")
    if on_surfaces:
        program = pivot_core.Program()
        x = program.add("window", [])
        shader = pivot_core.Shader(pivot_core.Material(), program, {"emission": [x, x + 1, x + 2]})
        scene.add_instances("ball", add_sphere(scene), place(1, -2, 0.5, 9), [scene.add_material("window", shader)])
    projection, plane, _ = PANORAMAS[name]
    scene.set_camera(CAMERA, plane, WIDTH, HEIGHT, projection=projection)
    _, seen = directions(name)
    np.testing.assert_allclose(render(scene, **CENTERS)[seen][:, :2], np.stack([X, Y], -1)[seen], atol=2e-4)


def floor(projection: Any, plane: tuple[float, ...], **camera: Any) -> pivot_core.Scene:
    """A floor that shines, 5 m below the camera."""
    scene = pivot_core.Scene()
    glow = scene.add_material("glow", pivot_core.Material(emission=(1, 1, 1)))
    scene.add_instances("floor", add_plane(scene), place(), [glow])
    matrix = np.eye(4, dtype=np.float32)
    matrix[:3, 3] = 2, 3, 5
    scene.set_camera(matrix, plane, WIDTH, HEIGHT, projection=projection, **camera)
    return scene


def test_orthographic_rays_are_parallel() -> None:
    plane = (-1.0, 2.0, -1.5, 0.5)
    scene = floor(pivot_core.Orthographic(), plane, clip_start_m=1.0, clip_end_m=6.0)
    position = render(scene, "Position", **CENTERS)
    np.testing.assert_allclose(position[..., 0], 2 + plane[0] + 3 * X, atol=1e-5)
    np.testing.assert_allclose(position[..., 1], 3 + plane[2] + 2 * Y, atol=1e-5)
    np.testing.assert_allclose(render(scene, "Depth", **CENTERS), 5.0, rtol=1e-6)


def test_an_orthographic_view_sees_what_is_behind_it() -> None:
    plane = (-1.0, 1.0, -1.0, 1.0)
    for clip_start_m, sees in ((-20.0, True), (6.0, False)):
        scene = floor(pivot_core.Orthographic(), plane, clip_start_m=clip_start_m, clip_end_m=20.0)
        assert (render(scene, **CENTERS)[..., 0].min() == 1.0) == sees
    scene = floor(pivot_core.Orthographic(), plane, clip_end_m=4.9)
    assert render(scene, **CENTERS)[..., 0].max() == 0.0


def test_a_panorama_is_as_deep_as_far() -> None:
    scene = floor(pivot_core.FisheyeEquidistant(1.5), UNIT)
    position = render(scene, "Position", **CENTERS)
    seen = np.hypot(2 * X - 1, 2 * Y - 1) <= 1
    far = np.linalg.norm(position - (2, 3, 5), axis=-1)
    np.testing.assert_allclose(render(scene, "Depth", **CENTERS)[seen][:, 0], far[seen], rtol=1e-5)


SIDE = 40
SQUARE_HALF_M = 0.05


def blurred_point(integrator: str, projection: Any, plane_half: float, lens: pivot_core.Lens) -> Floats:
    """The picture of a small square in the middle, 10 m before a camera whose frame is 2 m wide there."""
    scene = pivot_core.Scene()
    glow = scene.add_material("glow", pivot_core.Material(emission=(1, 1, 1)))
    square = add_plane(scene, SQUARE_HALF_M)
    scene.add_instances("square", square, place(), [glow])
    matrix = np.eye(4, dtype=np.float32)
    matrix[2, 3] = 10
    plane = (-plane_half, plane_half, -plane_half, plane_half)
    scene.set_camera(matrix, plane, SIDE, SIDE, projection=projection, lens=lens)
    return render(scene, samples=256, filter_width_px=0.0, integrator=integrator)[..., 0]


@pytest.mark.parametrize("integrator", ["MONTE_CARLO", "ANALYTIC"])
@pytest.mark.parametrize("kind", ["perspective", "orthographic"])
@pytest.mark.parametrize("blades", [0, 3, 5])
def test_a_lens_shows_a_point_as_its_stop(integrator: str, kind: str, blades: int) -> None:
    """Out of focus by half its distance it covers what the lens does, as bright as its share; twice as narrow in x."""
    radius_m = 0.6
    projection, half = (None, 0.1) if kind == "perspective" else (pivot_core.Orthographic(), 1.0)
    lens = pivot_core.Lens(radius_m, 20.0, blades, 0.4, 2.0)
    picture = blurred_point(integrator, projection, half, lens)
    # A point at half the focal distance is blurred over half the lens.
    area = 0.5 * blades * np.sin(2 * np.pi / blades) if blades else np.pi
    stop_m2 = area * (0.5 * radius_m) ** 2 / 2
    share = (2 * SQUARE_HALF_M) ** 2 / stop_m2
    total = picture.sum() * (2.0 / SIDE) ** 2
    assert total == pytest.approx((2 * SQUARE_HALF_M) ** 2, rel=0.03)
    assert picture[SIDE // 2 - 1 : SIDE // 2 + 1, SIDE // 2 - 1 : SIDE // 2 + 1].mean() == pytest.approx(share, rel=0.1)
    rows, columns = np.nonzero(picture > 0.3 * share)
    if blades == 0:
        assert np.ptp(rows) * 2.0 / SIDE == pytest.approx(radius_m, abs=0.2)
        assert np.ptp(columns) * 2.0 / SIDE == pytest.approx(radius_m / 2, abs=0.2)


def test_what_is_in_focus_is_sharp() -> None:
    sharp = blurred_point("MONTE_CARLO", None, 0.1, pivot_core.Lens(0.0, 1.0))
    focused = blurred_point("MONTE_CARLO", None, 0.1, pivot_core.Lens(0.5, 10.0))
    np.testing.assert_array_equal(focused, sharp)


@pytest.mark.parametrize(
    ("wrong", "text"),
    [
        ({"lens": pivot_core.Lens(float("nan"), 1.0)}, "lens"),
        ({"lens": pivot_core.Lens(0.1, 0.0)}, "focus"),
        ({"lens": pivot_core.Lens(0.1, 1.0, ratio=0.0)}, "ratio"),
        ({"projection": pivot_core.FisheyeEquidistant(float("nan"))}, "projection"),
        ({"projection": pivot_core.Equirectangular((float("inf"), 0.0), (0.0, 1.0))}, "projection"),
        ({"clip_start_m": float("inf")}, "clip"),
    ],
)
def test_wrong_numbers_are_refused(wrong: dict[str, Any], text: str) -> None:
    with pytest.raises(ValueError, match=text):
        floor(wrong.pop("projection", None), UNIT, **wrong)
