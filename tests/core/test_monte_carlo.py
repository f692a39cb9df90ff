"""clamp_indirect bounds what light that bounced adds at once, and leaves direct light alone."""

from __future__ import annotations

import numpy as np
import pivot_core

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
    direct, free, clamped = picture(max_bounces=0), picture(max_bounces=3), picture(max_bounces=3, clamp_indirect=0.5)
    assert (free - direct).max() > 10  # fireflies
    # Three bounces, and at each a light sample and what its BSDF sample meets.
    assert (clamped - direct).max() < 3 * 2 * 0.5
    assert np.all(clamped - direct > -1e-4)
    assert clamped.mean() < free.mean()


def test_a_bound_that_nothing_reaches_changes_nothing() -> None:
    np.testing.assert_array_equal(picture(max_bounces=3, clamp_indirect=1e9), picture(max_bounces=3))
    np.testing.assert_array_equal(picture(max_bounces=0, clamp_indirect=1e-3), picture(max_bounces=0))
