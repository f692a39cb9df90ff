"""The analytic integrator looks on from mirrors and through glass, and sees what paths see there."""

from __future__ import annotations

import numpy as np
import pivot_core
import pytest
from scenes import Floats, add_plane, add_sphere, place, render, set_camera

MIRROR = pivot_core.Material(conductor_f0=(0.9, 0.8, 0.7), conductor_f90=(1, 1, 1), conductor_weight=1.0, alpha=0.0)
PAPER = pivot_core.Material(diffuse=(0.2, 0.5, 0.7))
SHINING = pivot_core.Material(emission=(1.5, 1.0, 0.5))


def glass(**values: object) -> pivot_core.Material:
    return pivot_core.Material(lobes=[("dielectric", values)])


def ball_on_paper(material: pivot_core.Material, lamp_radius_m: float = 0.3) -> pivot_core.Scene:
    """Beside a shining ball, under a lamp that is behind it for the camera, unless that has no radius."""
    scene = pivot_core.Scene()
    ball = add_sphere(scene)
    scene.add_instances("paper", add_plane(scene, 6.0), place(), [scene.add_material("paper", PAPER)])
    scene.add_instances("ball", ball, place(z=1.1), [scene.add_material("ball", material)])
    scene.add_instances("shining", ball, place(1.5, 0.8, 0.5, 0.4), [scene.add_material("shining", SHINING)])
    if lamp_radius_m > 0:
        scene.add_light("lamp", pivot_core.SphereLight((-0.4, 2.5, 1.6), lamp_radius_m, (3, 3, 3)))
    scene.set_world((0.1, 0.15, 0.2))
    set_camera(scene, (0.0, -5.0, 1.6), (0.0, 0.0, 1.1), size=(32, 32), half_width=0.2)
    return scene


def ball_of(picture: Floats) -> Floats:
    """Its pixels, without the rim."""
    y, x = np.mgrid[:32, :32] - 15.5
    return picture[np.hypot(x, y) < 13][:, :3]


@pytest.mark.parametrize("max_bounces", [0, 1])
def test_a_mirror_shows_what_paths_see(max_bounces: int) -> None:
    scene = ball_on_paper(MIRROR)
    seen = ball_of(render(scene, integrator="ANALYTIC", samples=16, max_bounces=max_bounces))
    paths = ball_of(render(scene, samples=64, max_bounces=max_bounces))
    assert seen.mean(0) == pytest.approx(paths.mean(0), rel=0.01)


@pytest.mark.parametrize(("alpha", "samples"), [(0.0, 16), (0.1, 64)])
def test_glass_shows_what_paths_see_through_it(alpha: float, samples: int) -> None:
    """Rough glass by as many images as there are samples, without lamps."""
    scene = ball_on_paper(glass(alpha=alpha, ior=1.4), 0.3 if alpha == 0 else 0.0)
    seen = ball_of(render(scene, integrator="ANALYTIC", samples=samples, max_bounces=4))
    paths = ball_of(render(scene, samples=512, max_bounces=4))
    assert seen.mean(0) == pytest.approx(paths.mean(0), rel=0.03)


@pytest.mark.parametrize(("alpha", "ior"), [(0.0, 1.5), (0.3, 1.3)])
def test_a_white_ball_in_a_white_furnace_is_not_seen(alpha: float, ior: float) -> None:
    scene = pivot_core.Scene()
    material = scene.add_material("glass", glass(alpha=alpha, ior=ior, multiscatter=1.0))
    scene.add_instances("ball", add_sphere(scene), place(), [material])
    scene.set_world((1, 1, 1))
    set_camera(scene, (0.0, -5.0, 0.0), size=(32, 32), half_width=0.25)
    picture = render(scene, integrator="ANALYTIC", samples=64, max_bounces=16)[..., :3]
    assert picture.mean() == pytest.approx(1, abs=0.01)


def test_two_mirrors_end_at_max_bounces() -> None:
    """A shining plane seen after so many mirrors."""

    def seen(max_bounces: int) -> float:
        scene = pivot_core.Scene()
        plane = add_plane(scene, 1000.0)
        material = pivot_core.Material(
            conductor_f0=(0.5,) * 3, conductor_f90=(0.5,) * 3, conductor_weight=1.0, alpha=0.0, emission=(1, 1, 1)
        )
        for z in (-1.0, 1.0):
            scene.add_instances(f"mirror {z}", plane, place(z=z), [scene.add_material(f"mirror {z}", material)])
        set_camera(scene, (0.0, 0.0, 0.0), (0.0, 0.2, 1.0), size=(8, 8), half_width=0.1)
        return float(render(scene, integrator="ANALYTIC", samples=4, max_bounces=max_bounces)[..., :3].mean())

    assert [seen(count) for count in (0, 1, 2)] == pytest.approx([1.5, 1.75, 1.875], rel=0.01)
