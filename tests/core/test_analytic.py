"""The analytic integrator: seams between methods, area lights, many lights, its passes."""

from __future__ import annotations

import numpy as np
import pivot_core
import pytest
from numpy.typing import NDArray
from pivot_core.shading import METHODS, ggx_area_light

from tests.core.ggx_reference import LEAST_VALUE
from tests.core.scenes import add_plane, add_sphere, place, set_camera


def render(scene: pivot_core.Scene, name: str = "Combined", **settings: object) -> NDArray[np.float32]:
    session = pivot_core.Session(scene, pivot_core.RenderSettings(integrator="ANALYTIC", **settings))
    session.start()
    session.wait(120)
    assert not session.bad_samples
    return session.read(name)


def low_light(radius_m: float = 2.0) -> pivot_core.SphereLight:
    """A light that comes down to the floor, in the highlight of a camera that looks along y."""
    return pivot_core.SphereLight(position=(0, 9, 1.5), radius_m=radius_m, intensity=(100, 100, 100))


def angle_ramp(alpha: float) -> pivot_core.Scene:
    """A floor towards the horizon: each row of the picture is another angle of view and of the light."""
    scene = pivot_core.Scene()
    glossy = pivot_core.Material(alpha=alpha, conductor_f0=(1, 1, 1), conductor_f90=(1, 1, 1))
    scene.add_instances("floor", add_plane(scene), place(), [scene.add_material("floor", glossy)])
    scene.add_light("light", low_light())
    set_camera(scene, (0, -6, 1.2), (0, 3, 0), (24, 240), 0.1)
    return scene


def roughness_ramp(strips: int = 160) -> pivot_core.Scene:
    """Strips of floor side by side, from rough to sharp: each column of the picture is another alpha."""
    scene = pivot_core.Scene()
    mesh = add_plane(scene, 0.5)
    for i, roughness in enumerate(np.linspace(0.15, 1.0, strips)):
        glossy = pivot_core.Material(alpha=roughness**2, conductor_f0=(1, 1, 1), conductor_f90=(1, 1, 1))
        matrix = place()
        matrix[0, 0, 0], matrix[0, 1, 1] = 4 / strips, 40
        matrix[0, 0, 3] = -2 + 4 * (i + 0.5) / strips
        scene.add_instances(f"strip {i}", mesh, matrix, [scene.add_material(f"strip {i}", glossy)])
    scene.add_light("light", low_light())
    set_camera(scene, (0, -6, 1.2), (0, 0, 0), (strips, 40), 2 / 6.12)
    return scene


def second_difference(picture: NDArray[np.float32], axis: int) -> NDArray[np.float32]:
    return np.diff(picture[..., 0].astype(np.float64), 2, axis=axis)


@pytest.mark.parametrize("budget", [1.0, 2.0])
@pytest.mark.parametrize("alpha", [0.03, 0.2, 0.7])
def test_no_seam_along_an_angle_ramp(alpha: float, budget: float) -> None:
    assert_no_seam(angle_ramp(alpha), axis=0, budget=budget)


def test_no_seam_along_a_roughness_ramp() -> None:
    assert_no_seam(roughness_ramp(), axis=1, budget=2.0)


def assert_no_seam(scene: pivot_core.Scene, axis: int, budget: float) -> None:
    """What switching methods adds to the second difference is below the budget; and methods do switch."""
    settings = {"samples": 1, "occlusion": "NONE", "filter_width_px": 0.0}
    automatic = render(scene, error_budget_percent=budget, **settings)
    exact = render(scene, analytic_method="EXACT", **settings)
    added = np.abs(second_difference(automatic, axis) - second_difference(exact, axis))
    lines = np.moveaxis(exact[..., 0], axis, 0)
    scale = np.moveaxis(
        np.maximum.reduce([lines[:-2], lines[1:-1], lines[2:], np.full_like(lines[1:-1], 1e-2)]), 0, axis
    )
    assert np.max(added / scale) < 0.01 * budget
    assert np.max(np.abs(automatic - exact)[..., 0] / np.maximum(exact[..., 0], 1e-2)) < 0.01 * budget  # radiance is 8
    methods = render(scene, "Method", error_budget_percent=budget, **settings)
    assert len(np.unique(np.round(methods.reshape(-1, 3), 2), axis=0)) > 1
    predicted = render(scene, "Error", error_budget_percent=budget, **settings)
    assert 0 < predicted.max() <= 0.0101 * budget


@pytest.mark.parametrize("ellipse", [False, True])
def test_area_lights_within_the_budget(ellipse: bool) -> None:
    import pivot_core.bsdf as bsdf

    rng = np.random.default_rng(4)
    grid = (np.arange(500) + 0.5) / 250 - 1
    x, y = (axis.ravel() for axis in np.meshgrid(grid, grid))
    inside = x**2 + y**2 <= 1 if ellipse else np.ones(len(x), bool)
    errors, covered = [], []
    for _ in range(60):
        alpha, theta = rng.uniform(0.15, 1), np.radians(rng.uniform(0, 85))
        wo = np.array([np.sin(theta), 0, np.cos(theta)])
        half_u, half_v = rng.normal(size=(2, 3))
        half_v -= half_u * (half_u @ half_v) / (half_u @ half_u)
        half_u *= 10 ** rng.uniform(-1.7, 0.3) / np.linalg.norm(half_u)
        half_v *= 10 ** rng.uniform(-1.7, 0.3) / np.linalg.norm(half_v)
        normal = np.cross(half_u, half_v) / np.linalg.norm(half_u) / np.linalg.norm(half_v)
        center = rng.normal(size=3)
        center *= 10 ** rng.uniform(-0.3, 1) / np.linalg.norm(center)
        if abs(normal @ center) < 0.2 or center[2] < -0.2:
            continue
        p = center + x[inside, None] * half_u + y[inside, None] * half_v
        distance = np.linalg.norm(p, axis=1)
        wi, solid_angle = p / distance[:, None], np.abs(p @ normal) / distance**3
        up = wi[:, 2] > 0
        area = np.linalg.norm(np.cross(half_u, half_v)) / 250**2
        exact = area * np.sum(solid_angle[up] * bsdf.ggx_eval(alpha, wo, wi[up])) if up.any() else 0.0
        value, predicted, method = ggx_area_light(alpha, wo, center, half_u, half_v, ellipse, 1.0)
        assert METHODS[method] in (("AREA_POINTS", "LOBE_DIRECTIONS") if exact > 0 else ("NONE",))
        errors.append(abs(value - exact) / max(exact, LEAST_VALUE))
        covered.append(errors[-1] <= predicted + 1e-3)  # the grid's own error
    assert len(errors) > 30
    assert max(errors) < 0.02
    assert np.mean(errors) < 0.003
    assert np.mean(covered) >= 0.95


def test_many_dim_lights_give_what_one_bright_one_gives() -> None:
    """64 lights at one place are one of their sum, and light hidden from the floor stays hidden."""

    def picture(count: int) -> NDArray[np.float32]:
        scene = pivot_core.Scene()
        matte = scene.add_material(
            "m", pivot_core.Material(diffuse=(0.5, 0.5, 0.5), alpha=0.2, conductor_f0=(0.3,) * 3)
        )
        scene.add_instances("floor", add_plane(scene), place(), [matte])
        scene.add_instances("ball", add_sphere(scene), place(0, 0, 0.5, 0.5), [matte])
        for i in range(count):
            light = pivot_core.SphereLight(position=(2, 1, 4), radius_m=0.1, intensity=(50 / count,) * 3)
            scene.add_light(f"light {i}", light)
        set_camera(scene, (0, -5, 3), size=(40, 30))
        return render(scene, samples=4)

    one, many = picture(1), picture(64)
    difference = np.abs(many - one)[..., 0]
    assert np.mean(difference) < 0.01 * np.mean(one[..., 0])
    assert np.median(difference) < 1e-3 * np.mean(one[..., 0])


def test_methods_of_the_papers_are_kept_whole() -> None:
    """SPTD and LTC at a view where the papers call them good, and far off at grazing, where the exact core is not."""
    pictures = {
        m: render(angle_ramp(0.2), samples=1, occlusion="NONE", analytic_method=m) for m in ("EXACT", "SPTD", "LTC")
    }
    exact = pictures["EXACT"][..., 0]
    for method in ("SPTD", "LTC"):
        error = np.abs(pictures[method][..., 0] - exact) / np.maximum(exact, 1e-2 * exact.max())
        assert 0.005 < np.mean(error) < 0.6, method
