"""Paths end where an artist bounds reflections of their kind."""

from __future__ import annotations

import numpy as np
import pivot_core
import pytest
from scenes import Floats, add_plane, add_sphere, place, set_camera

NO_LIMIT = 1024


def rendered(max_bounces: int, limits: tuple[int, int, int, int] | None, is_foggy: bool = False) -> Floats:
    """A chalk ground, a mirror and a lamp, in fog or not."""
    scene = pivot_core.Scene()
    chalk = scene.add_material("chalk", pivot_core.Material(diffuse=(0.6, 0.5, 0.4)))
    mirror = pivot_core.Material(conductor_f0=(0.9, 0.9, 0.9), conductor_f90=(1, 1, 1), alpha=0.1)
    glow = scene.add_material("glow", pivot_core.Material(emission=(2, 2, 2)))
    scene.add_instances("ground", add_plane(scene, 4), place(), [chalk])
    scene.add_instances("ball", add_sphere(scene, 24), place(0, 0, 1), [scene.add_material("mirror", mirror)])
    scene.add_instances("panel", add_plane(scene, 0.5), place(1.5, 0, 1.5), [glow])
    scene.add_light("lamp", pivot_core.SphereLight((1, -1, 4), 0.5, (30, 30, 30)))
    if is_foggy:
        scene.set_world_medium(pivot_core.Medium(scattering=[((0.05,) * 3, 0.3, "HENYEY_GREENSTEIN")]))
    set_camera(scene, (0, -8, 4), (0, 0, 0.6), size=(24, 24), half_width=0.35)
    bounds = {} if limits is None else {"bounce_limits": limits}
    session = pivot_core.Session(scene, pivot_core.RenderSettings(samples=16, max_bounces=max_bounces, **bounds))
    session.start()
    while not session.wait(10.0):
        pass
    return np.array(session.read("Combined"))[..., :3]


@pytest.mark.parametrize("is_foggy", [False, True])
def test_no_reflections_of_any_kind_is_direct_light(is_foggy: bool) -> None:
    bounded, direct = rendered(4, (0, 0, 0, 0), is_foggy), rendered(0, None, is_foggy)
    np.testing.assert_allclose(bounded.mean(), direct.mean(), rtol=0.01)


def test_limits_above_all_bounces_change_nothing() -> None:
    np.testing.assert_array_equal(rendered(2, (3, 3, 3, 3)), rendered(2, None))


def test_each_kind_has_its_own() -> None:
    whole = rendered(3, None).mean()
    diffuse, glossy = (rendered(3, limits).mean() for limits in ((0, *[NO_LIMIT] * 3), (NO_LIMIT, 0, *[NO_LIMIT] * 2)))
    assert diffuse < 0.99 * whole
    assert glossy < 0.99 * whole
    through = rendered(3, (NO_LIMIT, NO_LIMIT, 0, 0))
    np.testing.assert_array_equal(through, rendered(3, None))  # nothing is transmitted
