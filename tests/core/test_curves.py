"""Curves as rays meet them: where, how wide, with what normal and what shaders read there."""

from __future__ import annotations

import numpy as np
import pivot_core
import pytest
from scenes import place, render, set_camera

RADIUS_M = 0.2


def strand(scene: pivot_core.Scene, shape: str, material: pivot_core.Material, **attributes: np.ndarray) -> int:
    """A straight one along x from -2 to 2, through (0, 0, 0), of even thickness."""
    positions = np.zeros((5, 3), np.float32)
    positions[:, 0] = np.linspace(-2, 2, 5)
    curves = scene.add_curves(
        "strand", positions, np.full(5, RADIUS_M, np.float32), np.array([0, 5]), shape, point_attributes=attributes
    )
    return scene.add_instances("strand", curves, place(), [scene.add_material("m", material)])


def picture(shape: str, material: pivot_core.Material, size: int = 64) -> np.ndarray:
    """From z = 10, 1 m to each side, under a world of radiance 1, which the background shows."""
    scene = pivot_core.Scene()
    strand(scene, shape, material)
    scene.set_world((1, 1, 1))
    set_camera(scene, (0, 0, 10), size=(size, size), half_width=0.1)
    return render(scene, samples=64, max_bounces=0)[..., :3]


@pytest.mark.parametrize("shape", ["RIBBON", "ROUND"])
def test_a_strand_is_as_wide_as_its_radius_says(shape: str) -> None:
    """A black one before a white sky."""
    dark = 1 - picture(shape, pivot_core.Material())[..., 0]
    assert dark.mean() == pytest.approx(RADIUS_M, rel=0.02)
    np.testing.assert_allclose(dark[29:35], 1, atol=1e-6)


@pytest.mark.parametrize("shape", ["RIBBON", "ROUND"])
def test_a_strand_is_lit_as_a_cylinder(shape: str) -> None:
    """By a sun from the side: Lambert's cosine of the tube's normal."""
    scene = pivot_core.Scene()
    strand(scene, shape, pivot_core.Material(diffuse=(1, 1, 1)))
    scene.add_light("sun", pivot_core.SunLight((0, 0.8, 0.6), 0.01, (1, 1, 1)))
    set_camera(scene, (0, 0, 10), size=(1, 201), half_width=0.022 / 201)
    seen = render(scene, samples=16, max_bounces=0)[:, 0, 0]
    sine = ((np.arange(201) + 0.5) / 201 * 0.44 - 0.22) / RADIUS_M
    inside = np.abs(sine) < 0.97
    cosine = 0.8 * sine + 0.6 * np.sqrt(np.maximum(1 - sine**2, 0))
    np.testing.assert_allclose(seen[inside], np.maximum(cosine, 0)[inside] / np.pi, atol=0.01)
    np.testing.assert_array_equal(seen[np.abs(sine) > 1.03], 0)


def test_a_strand_in_an_even_world_is_as_bright_as_its_colour() -> None:
    """The light that each place of a convex body reflects, whichever way its normal stands."""
    seen = picture("ROUND", pivot_core.Material(diffuse=(0.5, 0.25, 0.75)))[31, 32]
    np.testing.assert_allclose(seen, (0.5, 0.25, 0.75), rtol=0.02)


def test_hair_without_absorption_keeps_all_light() -> None:
    """The white furnace."""
    for shape in ("RIBBON", "ROUND"):
        hair = pivot_core.Material(lobes=[("hair", {"absorption": (0.0, 0.0, 0.0)})])
        np.testing.assert_allclose(picture(shape, hair)[29:35].mean(), 1, rtol=0.02)


def test_a_ball_is_lit_as_a_sphere() -> None:
    """By a sun from the side: Lambert's cosine of its normal."""
    scene = pivot_core.Scene()
    ball = scene.add_curves("ball", np.zeros((1, 3)), np.full(1, RADIUS_M), np.array([0, 1]), "BALL")
    white = pivot_core.Material(diffuse=(1, 1, 1))
    scene.add_instances("ball", ball, place(), [scene.add_material("m", white)])
    toward = np.array([0.48, 0.64, 0.6])
    scene.add_light("sun", pivot_core.SunLight(tuple(toward), 0.01, (1, 1, 1)))
    set_camera(scene, (0, 0, 10), size=(64, 64), half_width=0.022)
    seen = render(scene, samples=64, max_bounces=0)[..., 0]
    x, y = np.meshgrid(*2 * [((np.arange(64) + 0.5) / 32 - 1) * 0.22 / RADIUS_M])
    inside = x * x + y * y < 0.9
    z = np.sqrt(np.maximum(1 - x * x - y * y, 0))
    cosine = np.maximum(np.stack([x, y, z], -1) @ toward, 0)
    np.testing.assert_allclose(seen[inside], cosine[inside] / np.pi, atol=0.015)


def test_attributes_go_from_point_to_point() -> None:
    """Emission by an attribute of the points."""
    scene = pivot_core.Scene()
    program = pivot_core.Program()
    first = program.add("attribute", [], [scene.attribute_id("along"), 0.0], 0)
    shader = pivot_core.Shader(pivot_core.Material(), program, varying={"emission": [first, first + 1, first + 2]})
    positions = np.zeros((5, 3), np.float32)
    positions[:, 0] = np.linspace(-2, 2, 5)
    along = np.linspace(0, 4, 5, dtype=np.float32)[:, None]
    curves = scene.add_curves(
        "strand", positions, np.full(5, RADIUS_M, np.float32), np.array([0, 5]), point_attributes={"along": along}
    )
    scene.add_instances("strand", curves, place(), [scene.add_material("m", shader)])
    set_camera(scene, (0, 0, 10), size=(64, 1), half_width=0.1)
    seen = render(scene, samples=16, max_bounces=0)[0, :, 0]
    x = (np.arange(64) + 0.5) / 32 - 1
    np.testing.assert_allclose(seen, x + 2, atol=0.03)


@pytest.mark.parametrize(
    ("positions", "radii", "offsets", "said"),
    [
        ([[0, 0, 0], [np.nan, 0, 0]], [1, 1], [0, 2], "point 1 is not finite"),
        ([[0, 0, 0], [1, 0, 0]], [1, -1], [0, 2], "point 1 is not finite, or its radius is negative"),
        ([[0, 0, 0], [1, 0, 0]], [1, 1], [0, 1], "offsets must go from 0 to the number of points"),
        ([[0, 0, 0], [1, 0, 0]], [1, 1], [0, 3, 2], "offset 2 is out of order"),
    ],
)
def test_bad_curves_are_named(positions: list[list[float]], radii: list[float], offsets: list[int], said: str) -> None:
    with pytest.raises(ValueError, match=f"curves 'wig': {said}"):
        pivot_core.Scene().add_curves("wig", np.array(positions), np.array(radii), np.array(offsets))


@pytest.mark.parametrize("shape", ["RIBBON", "ROUND", "BALL"])
def test_what_deforms_is_seen_as_what_moves(shape: str) -> None:
    """Two strands of which one is shorter, shifted by their points, and by their place."""
    offsets = np.array([0, 3, 5])
    positions = np.zeros((5, 3), np.float32)
    positions[:, 0], positions[3:, 1] = (-1, 0, 1, -0.5, 0.5), 0.6

    def seen(deforms: bool) -> np.ndarray:
        scene = pivot_core.Scene()
        curves = scene.add_curves("strands", positions, np.full(5, RADIUS_M, np.float32), offsets, shape)
        grey = scene.add_material("grey", pivot_core.Material(diffuse=(0.5, 0.5, 0.5)))
        scene.add_instances("strands", curves, place(), [grey])
        shifts = [np.array((0, y, 0), np.float32) for y in (-0.4, 0.0, 0.2)]
        if deforms:
            scene.set_mesh_motion(curves, positions=[positions + shift for shift in shifts])
        else:
            scene.set_instance_motion(0, np.concatenate([place(*shift) for shift in shifts]))
        scene.add_light("sun", pivot_core.SunLight((0, 0.8, 0.6), 0.1, (1, 1, 1)))
        set_camera(scene, (0, 0, 10), size=(32, 32), half_width=0.15)
        return render(scene, samples=32, max_bounces=1)[..., :3]

    moved, deformed = seen(False), seen(True)
    assert moved.mean() > 0.002
    assert np.abs(deformed - moved).mean() < 0.01 * moved.mean()


def test_motion_of_fewer_points_is_refused() -> None:
    scene = pivot_core.Scene()
    strand(scene, "RIBBON", pivot_core.Material())
    with pytest.raises(ValueError, match="curves 'strand': their motion needs 2 to 129"):
        scene.set_mesh_motion(0, positions=[np.zeros((4, 3), np.float32)] * 2)
