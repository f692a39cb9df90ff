"""Emissive meshes light what is around them in analytic pictures: few triangles exactly, many as virtual lights."""

from __future__ import annotations

import numpy as np
import pivot_core
import pytest

from tests.core.scenes import Floats, add_box, add_plane, add_sphere, place, set_camera
from tests.core.test_mesh_lights import EMISSION

BOX = {"integrator": "ANALYTIC", "samples": 4, "max_bounces": 0, "pixel_filter": "BOX", "filter_width_px": 1.0}


def half_shining() -> pivot_core.Shader:
    """On one half."""
    program = pivot_core.Program()
    white = program.add("math_greater_than", [(program.add("position", []), 0.0), (-1, 0.0)])
    return pivot_core.Shader(pivot_core.Material(), program, {"emission": [white] * 3})


def lit_by(light: str, alpha: float = 0.1, radius_m: float = 0.3) -> pivot_core.Scene:
    """A plastic floor and box and a metal ball, under a light 1.5 m up that the camera does not see."""
    scene = pivot_core.Scene()
    plastic = scene.add_material("plastic", pivot_core.Material(diffuse=(0.5,) * 3, alpha=0.3, dielectric_weight=1.0))
    metal = scene.add_material(
        "metal", pivot_core.Material(alpha=alpha, conductor_f0=(0.8,) * 3, conductor_f90=(1,) * 3)
    )
    glow = scene.add_material("glow", half_shining() if light == "half" else pivot_core.Material(emission=EMISSION))
    scene.add_instances("floor", add_plane(scene, 4), place(), [plastic])
    scene.add_instances("ball", add_sphere(scene), place(0.7, 0, 0.4, 0.4), [metal])
    scene.add_instances("box", add_box(scene, (-0.9, -0.3, 0), (-0.5, 0.3, 0.5)), place(), [plastic])
    height = 1.5
    if light in ("quad", "half"):
        scene.add_instances("quad", add_plane(scene, 0.5), place(z=height), [glow], hidden_from=["CAMERA"])
    elif light == "area":
        scene.add_light("area", pivot_core.AreaLight((0, 0, height), (0, 0.5, 0), (0.5, 0, 0), EMISSION))
    elif light == "bulb":
        scene.add_instances(
            "bulb", add_sphere(scene, 16), place(0, 0, height, radius_m), [glow], hidden_from=["CAMERA"]
        )
    elif light == "sphere":
        intensity = np.pi * radius_m**2 * np.array(EMISSION)
        scene.add_light("sphere", pivot_core.SphereLight((0, 0, height), radius_m, intensity))
    set_camera(scene, (0, -4, 2.5), (0, 0, 0.4), (64, 48), 0.45)
    return scene


def read(scene: pivot_core.Scene, *passes: str, **settings: object) -> list[Floats]:
    session = pivot_core.Session(scene, pivot_core.RenderSettings(**(BOX | settings)))
    session.start()
    while not session.wait(10.0):
        pass
    assert session.bad_samples == []
    return [session.read(name)[..., :3].astype(float) for name in passes]


def apart(image: Floats, other: Floats) -> Floats:
    """Relative, of each pixel."""
    return np.abs(image - other).mean(-1) / np.maximum(other.mean(-1), 1e-2)


@pytest.mark.parametrize("alpha", [0.02, 0.1, 0.5])
def test_a_quad_is_the_area_light_of_its_place(alpha: float) -> None:
    for method in ("AUTO", "LTC"):
        settings = {"occlusion": "NONE", "analytic_method": method}
        (quad,), (area,) = (read(lit_by(light, alpha), "Combined", **settings) for light in ("quad", "area"))
        assert np.quantile(apart(quad, area), 0.995) < 0.01
        np.testing.assert_allclose(quad.mean(), area.mean(), rtol=1e-3)


def test_a_quad_casts_the_area_light_s_shadows() -> None:
    """The penumbrae are of other points."""
    (quad,), (area,) = (read(lit_by(light), "Combined", samples=16) for light in ("quad", "area"))
    assert apart(quad, area).mean() < 0.01
    np.testing.assert_allclose(quad.mean(), area.mean(), rtol=0.002)


def test_a_bulb_of_a_thousand_triangles_is_about_a_sphere_light() -> None:
    (bulb, error, indirect), (sphere,) = (
        read(lit_by(light), *passes, samples=16)
        for light, passes in (("bulb", ("Combined", "Error", "Indirect")), ("sphere", ("Combined",)))
    )
    difference = apart(bulb, sphere)
    assert difference.mean() < 0.04
    np.testing.assert_allclose(bulb.mean(), sphere.mean(), rtol=0.02)
    assert np.mean(difference < error[..., 0] + 0.01) > 0.95
    assert not indirect.any()


def test_emission_that_varies_is_a_mean_of_each_triangle() -> None:
    (analytic,) = read(lit_by("half"), "Combined")
    (monte_carlo,) = read(lit_by("half"), "Combined", integrator="MONTE_CARLO", samples=256)
    np.testing.assert_allclose(analytic.mean(), monte_carlo.mean(), rtol=0.1)


def test_a_flat_emitter_does_not_light_itself() -> None:
    """Nor does what lies in its plane, anywhere in space."""
    for far in (0.0, 1000.0):
        scene = pivot_core.Scene()
        glow = scene.add_material("glow", pivot_core.Material(diffuse=(0.5,) * 3, emission=EMISSION, alpha=0.1))
        grey = scene.add_material("grey", pivot_core.Material(diffuse=(0.5,) * 3))
        turned = place(far, far, far) @ np.array(
            [[0.8, 0.0, 0.6, 0], [0.0, 1, 0, 0], [-0.6, 0.0, 0.8, 0], [0, 0, 0, 1]], np.float32
        )
        scene.add_instances("glow", add_plane(scene, 0.5), turned, [glow])
        scene.add_instances("beside", add_plane(scene, 3.0), turned, [grey])
        set_camera(scene, (far, far - 1.0, far + 3.0), (far, far, far), (32, 24), 0.3)
        combined, emission = read(scene, "Combined", "Emit", occlusion="NONE")
        np.testing.assert_allclose(combined, emission, atol=2e-3)


def test_light_of_a_closed_mesh_stays_on_its_side() -> None:
    """A shell that shines, of few triangles and of many, seen from within."""
    for rings, tolerance in ((2, 0.005), (24, 0.03)):
        scene = pivot_core.Scene()
        glow = scene.add_material("glow", pivot_core.Material(emission=EMISSION))
        grey = scene.add_material("grey", pivot_core.Material(diffuse=(0.5,) * 3))
        scene.add_instances("shell", add_sphere(scene, rings), place(scale=0.5), [glow])
        scene.add_instances("within", add_box(scene, (-0.1,) * 3, (0.1,) * 3), place(), [grey])
        set_camera(scene, (0, -0.3, 0.05), (0, 0, 0), (16, 12), 0.5)
        (within,) = read(scene, "Combined", samples=8)
        (reference,) = read(scene, "Combined", integrator="MONTE_CARLO", samples=256)
        np.testing.assert_allclose(within.mean(), reference.mean(), rtol=tolerance)
