"""Where paths bounce: what clamp_indirect bounds, what filter_glossy blurs, and what no path may lose."""

from __future__ import annotations

import numpy as np
import pivot_core
import pytest

from tests.core.scenes import Floats, add_plane, add_sphere, place, render, set_camera


def caustic() -> pivot_core.Scene:
    """A floor beside a mirror-like ball under a small, strong light: few paths bring much."""
    scene = pivot_core.Scene()
    grey = scene.add_material("grey", pivot_core.Material(diffuse=(0.6, 0.6, 0.6)))
    mirror = scene.add_material(
        "mirror", pivot_core.Material(alpha=0.02, conductor_f0=(1,) * 3, conductor_f90=(1,) * 3)
    )
    scene.add_instances("floor", add_plane(scene, 5), place(), [grey])
    scene.add_instances("ball", add_sphere(scene), place(0, 0, 0.6, 0.6), [mirror])
    scene.add_light("light", pivot_core.SphereLight((1.5, -1, 2), 0.05, (20, 20, 20)))
    set_camera(scene, (0, -4, 3), size=(48, 36))
    return scene


def picture(**settings: object) -> Floats:
    return render(caustic(), samples=16, pixel_filter="BOX", filter_width_px=0.0, **settings)[..., :3].astype(float)


def test_what_bounced_is_bounded_and_direct_light_is_not() -> None:
    def pictures(**settings: object) -> Floats:
        return np.array([picture(seed=seed, **settings) for seed in range(8)])  # not every one has fireflies

    direct, free = pictures(max_bounces=0), pictures(max_bounces=3)
    clamped = pictures(max_bounces=3, clamp_indirect=0.5)
    assert (free - direct).max() > 10
    # Three bounces, and at each a light sample and what its BSDF sample meets.
    assert (clamped - direct).max() < 3 * 2 * 0.5
    assert np.all(clamped - direct > -1e-4)
    assert clamped.mean() < free.mean()


def test_a_bound_that_nothing_reaches_changes_nothing() -> None:
    np.testing.assert_array_equal(picture(max_bounces=3, clamp_indirect=1e9), picture(max_bounces=3))
    np.testing.assert_array_equal(picture(max_bounces=0, clamp_indirect=1e-3), picture(max_bounces=0))


def test_filtered_reflections_have_less_noise() -> None:
    def variance(**settings: object) -> float:
        return float(np.var(picture(max_bounces=3, seed=0, **settings) - picture(max_bounces=3, seed=1, **settings)))

    assert variance(filter_glossy=1.0) < 0.1 * variance()


def test_a_filter_that_nothing_reaches_changes_nothing() -> None:
    """The camera's own hits are never blurred, nor what samples of a density above the bound meet."""
    np.testing.assert_array_equal(picture(max_bounces=0, filter_glossy=10.0), picture(max_bounces=0))
    np.testing.assert_array_equal(picture(max_bounces=3, filter_glossy=1e-9), picture(max_bounces=3))
    with pytest.raises(ValueError, match="filter_glossy must not be negative"):
        picture(filter_glossy=-1.0)


def hidden_lamps(lamps: int, wall: bool) -> pivot_core.Scene:
    """An area light close over the floor, which shares with BSDF samples, and strong lamps that a plate hides.

    wall: the camera sees what the floor throws on a wall; else the floor.
    """
    scene = pivot_core.Scene()
    grey = scene.add_material("grey", pivot_core.Material(diffuse=(0.8, 0.8, 0.8)))
    black = scene.add_material("black", pivot_core.Material())
    scene.add_instances("floor", add_plane(scene, 20.0), place(), [grey])
    scene.add_instances("plate", add_plane(scene, 20.0), place(0.0, 0.0, 10.0), [black])
    for i in range(lamps):
        scene.add_light(f"hidden {i}", pivot_core.SphereLight((i - lamps / 2, 0, 12), 0.1, (2000, 2000, 2000)))
    scene.add_light("area", pivot_core.AreaLight((0, 0, 0.5), (1, 0, 0), (0, -1, 0), (1, 1, 1)))
    if not wall:
        set_camera(scene, (0, -0.9, 0.3), (0, 0, 0), size=(8, 8), half_width=0.2)
        return scene
    upright = np.array([[1, 0, 0, 0], [0, 0, -1, 1.5], [0, 1, 0, 0], [0, 0, 0, 1]], np.float32)
    scene.add_instances("wall", add_plane(scene, 20.0), upright[None], [grey])
    set_camera(scene, (0, -1.5, 1.6), (0, 1.5, 1.6), size=(8, 8), half_width=0.2)
    return scene


def test_a_lamp_that_is_seldom_chosen_keeps_its_light() -> None:
    """More lamps than a first hit samples: what BSDF samples bring of the one that is left out is not lost."""

    def mean(mode: str) -> float:  # of one picture it varies by up to 4 %
        scene = hidden_lamps(30, wall=False)
        pictures = [render(scene, light_sampling=mode, samples=256, seed=seed, max_bounces=0) for seed in range(8)]
        return float(np.mean([picture[..., 0] for picture in pictures]))

    means = [mean(mode) for mode in ("JOINT", "MIS", "LIGHT", "BSDF")]
    np.testing.assert_allclose(means, means[-1], rtol=0.05)


def test_later_hits_keep_the_light_of_both_lamps() -> None:
    """A later hit samples one of the two."""

    def bounced(mode: str) -> float:
        means = [
            render(hidden_lamps(1, wall=True), light_sampling=mode, samples=1024, max_bounces=bounces)[..., 0].mean()
            for bounces in (0, 1)
        ]
        return float(means[1] - means[0])

    joint, mis = bounced("JOINT"), bounced("MIS")
    assert abs(joint / mis - 1) < 0.1


def test_corners_on_one_line_give_no_bad_sample() -> None:
    """Turned into world space they are slivers that rays meet, without a normal of their own."""
    scene = pivot_core.Scene()
    grey = scene.add_material("grey", pivot_core.Material(diffuse=(0.8, 0.8, 0.8)))
    positions = np.array([[0, 0, 0], [1, 0, 0], [3, 0, 0], [0, 1, 0], [3, 1, 0]], np.float32)
    triangles = np.array([[0, 1, 2], [0, 2, 4], [0, 4, 3]], np.uint32)
    mesh = scene.add_mesh("edge", positions, triangles.ravel(), np.arange(9, dtype=np.uint32).reshape(3, 3))
    c, s = np.cos(0.7), np.sin(0.7)
    turned = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]]) @ np.array([[1, 0, 0], [0, c, -s], [0, s, c]])
    transform = np.eye(4)
    transform[:3, :3], transform[:3, 3] = 1.3 * turned, (0.31, -0.77, 0.53)
    scene.add_instances("edge", mesh, transform[None].astype(np.float32), [grey])
    scene.set_world((1, 1, 1))
    camera = np.eye(4)
    camera[:3, :3] = turned
    camera[:3, 3] = 1.3 * turned @ np.array([1.5, 0, 1.0]) + transform[:3, 3]
    scene.set_camera(camera.astype(np.float32), (-0.9, 0.9, -2e-7, 2e-7), 64, 16)
    session = pivot_core.Session(scene, pivot_core.RenderSettings(samples=16, max_bounces=1))
    session.start()
    assert session.wait(60)
    assert session.bad_samples == []
