"""Shadow catchers tell what others do to their light: nothing, where there are no others."""

from __future__ import annotations

import numpy as np
import pivot_core
import pytest
from scenes import Floats, add_plane, add_sphere, place, set_camera


def session_of(has_ball: bool, **settings: object) -> pivot_core.Session:
    scene = pivot_core.Scene()
    chalk = scene.add_material("chalk", pivot_core.Material(diffuse=(0.6, 0.5, 0.4)))
    scene.add_instances("ground", add_plane(scene, 4), place(), [chalk], shadow_catcher=True)
    if has_ball:
        scene.add_instances("ball", add_sphere(scene, 24), place(0, 0, 1), [chalk])
    scene.add_light("lamp", pivot_core.SphereLight((1, -1, 4), 0.5, (30, 30, 30)))
    scene.set_world((0.2, 0.3, 0.4))
    set_camera(scene, (0, -8, 4), (0, 0, 0.6), size=(24, 24), half_width=0.35)
    session = pivot_core.Session(scene, pivot_core.RenderSettings(shadow_catchers=True, max_bounces=1, **settings))
    session.start()
    while not session.wait(10.0):
        pass
    return session


def read(session: pivot_core.Session, kind: str) -> Floats:
    return np.array(session.read_shadow_catchers(kind))


@pytest.mark.parametrize(
    ("integrator", "adaptive"), [("MONTE_CARLO", False), ("MONTE_CARLO", True), ("ANALYTIC", False)]
)
def test_alone_they_are_as_if_they_were_not_there(integrator: str, adaptive: bool) -> None:
    samples = 64 if integrator == "MONTE_CARLO" else 4
    session = session_of(False, samples=samples, adaptive=adaptive, integrator=integrator, indirect="VSGL")
    np.testing.assert_allclose(read(session, "FACTOR"), 1.0, atol=1e-3)
    world = np.broadcast_to(np.array((0.2, 0.3, 0.4, 1.0), np.float32), (24, 24, 4))
    np.testing.assert_allclose(read(session, "WORLD"), world, atol=2e-3)


def test_what_hides_light_from_them_is_alpha() -> None:
    session = session_of(True, samples=64, transparent_film=True)
    factor, beside, over = (read(session, kind) for kind in ("FACTOR", "NOTHING", "ALPHA"))
    assert factor.min() < 0.4
    assert over[..., 3].sum() > 1.1 * beside[..., 3].sum()
    np.testing.assert_array_equal(over[..., :3], beside[..., :3])
    is_clear = beside[..., 3] == 0
    np.testing.assert_allclose(over[is_clear][:, 3], 1 - factor[is_clear].mean(-1).clip(0, 1), atol=1e-4)


def test_integrators_agree_on_what_they_lose() -> None:
    exact, ours = (
        read(session_of(True, samples=samples, integrator=integrator, indirect="VSGL"), "FACTOR")
        for integrator, samples in (("MONTE_CARLO", 256), ("ANALYTIC", 4))
    )
    assert np.abs(ours - exact).mean() < 0.01


def test_passes_that_nobody_asked_for_are_refused() -> None:
    scene = pivot_core.Scene()
    set_camera(scene, (0, -8, 4), size=(4, 4))
    with pytest.raises(ValueError, match="named pass"):
        pivot_core.Session(scene, pivot_core.RenderSettings(samples=1)).read_shadow_catchers("FACTOR")
