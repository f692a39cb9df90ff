"""Lights that are linked light their receivers alone, past all but their blockers, however they are sampled."""

from __future__ import annotations

import numpy as np
import pivot_core
import pytest
from scenes import Floats, add_plane, add_sphere, place, set_camera

ALL = 2**64 - 1
BUT_FIRST = ALL - 2  # all sets but 1


def scene_of(
    links: tuple[int, int] = (ALL, ALL), ball_sets: tuple[int, int] = (1, 1), has_ball: bool = True, panel: bool = False
) -> pivot_core.Scene:
    """A glossy ball over a ground, and a lamp or a panel that is linked."""
    scene = pivot_core.Scene()
    chalk = scene.add_material("chalk", pivot_core.Material(diffuse=(0.6, 0.5, 0.4)))
    shiny = pivot_core.Material(diffuse=(0.2, 0.4, 0.6), dielectric_weight=1.0, alpha=0.3)
    scene.add_instances("ground", add_plane(scene, 4), place(), [chalk])
    if has_ball:
        ball = [scene.add_material("shiny", shiny)]
        scene.add_instances("ball", add_sphere(scene, 24), place(0, 0, 1), ball, link_sets=ball_sets)
    if panel:
        glow = scene.add_material("glow", pivot_core.Material(emission=(5, 5, 5)))
        scene.add_instances("panel", add_plane(scene, 0.7), place(1, 0, 3), [glow], links=links)
    else:
        scene.add_light("lamp", pivot_core.SphereLight((1, 0, 4), 0.5, (30, 30, 30)), links=links)
    set_camera(scene, (0, -8, 4), (0, 0, 0.6), size=(24, 24), half_width=0.35)
    return scene


def rendered(scene: pivot_core.Scene, samples: int = 16, max_bounces: int = 0, **settings: object) -> Floats:
    session = pivot_core.Session(
        scene, pivot_core.RenderSettings(samples=samples, max_bounces=max_bounces, filter_width_px=0.0, **settings)
    )
    session.start()
    while not session.wait(10.0):
        pass
    return np.array(session.read("Combined"))[..., :3]


def is_ball() -> np.ndarray:
    scene = scene_of()
    session = pivot_core.Session(scene, pivot_core.RenderSettings(samples=1, filter_width_px=0.0))
    session.start()
    session.wait(60.0)
    return np.array(session.read("Position"))[..., 2] > 1e-3


@pytest.mark.parametrize("panel", [False, True])
def test_only_receivers_are_lit(panel: bool) -> None:
    lit, linked = rendered(scene_of(panel=panel)), rendered(scene_of((BUT_FIRST, ALL), panel=panel))
    ball = is_ball()
    bright = linked[ball].max(axis=-1) > 1e-6
    assert bright.sum() == (lit[ball].max(axis=-1) > 4.9).sum()  # a camera sees the panel itself
    np.testing.assert_array_equal(linked[~ball], lit[~ball])


@pytest.mark.parametrize("panel", [False, True])
def test_only_blockers_cast_shadows(panel: bool) -> None:
    """The ground is as it would be without the ball."""
    linked = rendered(scene_of((ALL, BUT_FIRST), panel=panel), samples=64)
    free = rendered(scene_of(has_ball=False, panel=panel), samples=64)
    blocked = rendered(scene_of(panel=panel), samples=64)
    ground = ~is_ball()
    assert np.abs(linked - free)[ground].mean() < 0.01 * free.mean()
    assert np.abs(blocked - free)[ground].mean() > 0.05 * free.mean()


@pytest.mark.parametrize("links", [(BUT_FIRST, ALL), (ALL, BUT_FIRST)])
@pytest.mark.parametrize("panel", [False, True])
def test_strategies_agree(links: tuple[int, int], panel: bool) -> None:
    scene = scene_of(links, ball_sets=(1, 1), panel=panel)
    means = [
        rendered(scene, samples=256, max_bounces=1, light_sampling=strategy).mean()
        for strategy in ("JOINT", "MIS", "LIGHT", "BSDF")
    ]
    np.testing.assert_allclose(means, means[0], rtol=0.03)


@pytest.mark.parametrize("links", [(BUT_FIRST, ALL), (ALL, BUT_FIRST)])
@pytest.mark.parametrize("panel", [False, True])
@pytest.mark.parametrize("indirect", ["NONE", "VSGL"])
def test_integrators_agree(links: tuple[int, int], panel: bool, indirect: str) -> None:
    scene = scene_of(links, panel=panel)
    bounces = 1 if indirect == "VSGL" else 0
    exact = rendered(scene, samples=256, max_bounces=bounces)
    ours = rendered(scene, samples=4, max_bounces=bounces, integrator="ANALYTIC", indirect=indirect)
    assert ours.mean() == pytest.approx(exact.mean(), rel=0.015)
    assert np.abs(ours - exact).mean() < 0.03 * exact.mean()


@pytest.mark.parametrize("integrator", ["MONTE_CARLO", "ANALYTIC"])
def test_fog_is_a_receiver(integrator: str) -> None:
    def foggy(links: tuple[int, int]) -> float:
        scene = scene_of(links, has_ball=False)
        medium = pivot_core.Medium(scattering=[((0.2, 0.2, 0.2), 0.0, "HENYEY_GREENSTEIN")])
        within = scene.add_material("fog", pivot_core.Material(), medium=medium, has_surface=False)
        scene.add_instances("fog", add_sphere(scene, 24), place(0, 0, 1), [within], link_sets=(1, 1))
        session = pivot_core.Session(scene, pivot_core.RenderSettings(samples=16, max_bounces=0, integrator=integrator))
        session.start()
        while not session.wait(10.0):
            pass
        return float(np.array(session.read("VolumeDir")).mean())

    assert foggy((ALL, ALL)) > 0.001
    assert foggy((BUT_FIRST, ALL)) == 0.0
