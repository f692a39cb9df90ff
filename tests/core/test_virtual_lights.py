"""Light by way of other surfaces, by virtual lights: its energy, its place, and that it is still."""

from __future__ import annotations

import numpy as np
import pivot_core
import pytest
from scenes import Floats, add_box, add_plane, add_sphere, place, render, set_camera

WHITE = (1.0, 1.0, 1.0)
VSGL = {"integrator": "ANALYTIC", "indirect": "VSGL", "max_bounces": 1, "pixel_filter": "BOX", "filter_width_px": 1.0}
ONE_BOUNCE = {"integrator": "MONTE_CARLO", "max_bounces": 1, "pixel_filter": "BOX", "filter_width_px": 1.0}


def add_walls(scene: pivot_core.Scene, material: int) -> None:
    """The room |x|, |y|, |z| < 1, as a box that is seen from within."""
    scene.add_instances("room", add_box(scene, (-1, -1, -1), (1, 1, 1)), place(), [material])


def box_room(light: pivot_core.SphereLight | None = None, albedo: float = 0.6) -> pivot_core.Scene:
    scene = pivot_core.Scene()
    add_walls(scene, scene.add_material("wall", pivot_core.Material(diffuse=(albedo, albedo, 0.5 * albedo))))
    scene.add_light("lamp", light or pivot_core.SphereLight((0.2, 0.1, 0.4), 0.05, (1.0, 1.0, 1.0)))
    set_camera(scene, (-0.8, -0.8, -0.2), (0.6, 0.5, 0.1), (48, 32), 1.0)
    return scene


def indirect(scene: pivot_core.Scene, **settings: object) -> Floats:
    return render(scene, "Indirect", **(VSGL | settings))


def by_monte_carlo(scene: pivot_core.Scene, samples: int = 1024) -> Floats:
    """What the first bounce adds."""
    both = render(scene, samples=samples, **ONE_BOUNCE)
    direct = render(scene, samples=samples, **(ONE_BOUNCE | {"max_bounces": 0}))
    return (both - direct)[..., :3]


def test_a_diffuse_room_is_lit_as_by_monte_carlo() -> None:
    """Within 3 % on average, and 1 % in the mean."""
    scene = box_room()
    lights, reference = indirect(scene, samples=16), by_monte_carlo(scene)
    assert np.abs(lights / reference - 1).mean() < 0.03
    assert lights.mean() == pytest.approx(reference.mean(), rel=0.01)


@pytest.mark.parametrize(
    "light",
    [
        pivot_core.SphereLight((0, 0, 0.5), 0.1, WHITE),
        pivot_core.SphereLight((0, 0, 0.5), 0.1, WHITE, facing_disk=True),
        pivot_core.SpotLight((0, 0, 0.5), 0.05, WHITE, (0.6, 0.0, -0.8), 0.7, 0.4),
        pivot_core.AreaLight((0, 0, 0.5), (0.0, 0.2, 0.0), (0.3, 0.0, 0.0), WHITE),
        pivot_core.AreaLight((0, 0, 0.5), (0.0, 0.2, 0.0), (0.3, 0.0, 0.0), WHITE, ellipse=True),
    ],
)
def test_what_a_room_sends_on_is_what_came_to_it(light: pivot_core.SphereLight) -> None:
    """Every kind of lamp gives a closed room the light that Monte Carlo finds."""
    scene = box_room(light)
    lights, reference = indirect(scene, samples=8), by_monte_carlo(scene)
    assert lights.mean() == pytest.approx(reference.mean(), rel=0.02)


def open_corner() -> tuple[pivot_core.Scene, int]:
    """A floor and a wall under the open sky."""
    scene = pivot_core.Scene()
    grey = scene.add_material("grey", pivot_core.Material(diffuse=(0.7, 0.7, 0.7)))
    scene.add_instances("floor", add_box(scene, (-1, -1, -0.1), (1, 1, 0)), place(), [grey])
    scene.add_instances("wall", add_box(scene, (-1, 1, -0.1), (1, 1.1, 1.0)), place(), [grey])
    set_camera(scene, (0.2, -2.5, 1.2), (0.0, 0.5, 0.3), (48, 32), 0.5)
    return scene, grey


def test_a_sun_is_reflected() -> None:
    scene, _ = open_corner()
    scene.add_light("sun", pivot_core.SunLight((0.0, -0.6, 0.8), 0.02, (3.0, 3.0, 3.0)))
    lights, reference = indirect(scene, samples=16), by_monte_carlo(scene)
    assert lights.mean() == pytest.approx(reference.mean(), rel=0.03)


def test_the_sky_is_reflected() -> None:
    scene, _ = open_corner()
    scene.set_world((0.5, 0.6, 0.8))
    lights, reference = indirect(scene, samples=16), by_monte_carlo(scene, 2048)
    assert lights.mean() == pytest.approx(reference.mean(), rel=0.03)


def test_an_emissive_mesh_is_reflected() -> None:
    """What others send on of its light; its own is direct."""
    scene, _ = open_corner()
    lamp = scene.add_material("lamp", pivot_core.Material(emission=(5.0, 4.0, 3.0)))
    scene.add_instances("lamp", add_box(scene, (-0.2, -0.2, 0.6), (0.2, 0.2, 0.7)), place(), [lamp])
    lights, reference = indirect(scene, samples=16), by_monte_carlo(scene, 2048)
    assert lights.mean() == pytest.approx(reference.mean(), rel=0.05)


def test_more_bounces_add_what_monte_carlo_adds() -> None:
    scene = box_room()
    lights = indirect(scene, samples=8, max_bounces=4)
    both = render(scene, samples=512, **(ONE_BOUNCE | {"max_bounces": 4}))
    direct = render(scene, samples=512, **(ONE_BOUNCE | {"max_bounces": 0}))
    assert lights.mean() == pytest.approx((both - direct)[..., :3].mean(), rel=0.02)


def test_no_bounces_are_no_lights() -> None:
    session = pivot_core.Session(box_room(), pivot_core.RenderSettings(**(VSGL | {"max_bounces": 0}), samples=1))
    session.start()
    assert session.wait(60)
    assert session.virtual_lights[:2] == (0, 0)


def test_metal_sends_light_on_too() -> None:
    """A wall of rough metal beside a diffuse floor."""
    scene = pivot_core.Scene()
    grey = scene.add_material("grey", pivot_core.Material(diffuse=(0.7, 0.7, 0.7)))
    gold = scene.add_material("gold", pivot_core.Material(conductor_f0=(0.9, 0.7, 0.3), conductor_f90=WHITE, alpha=0.2))
    scene.add_instances("floor", add_box(scene, (-1, -1, -0.1), (1, 1, 0)), place(), [grey])
    scene.add_instances("wall", add_box(scene, (-1, 1, -0.1), (1, 1.1, 1.0)), place(), [gold])
    scene.add_light("lamp", pivot_core.SphereLight((0.3, -0.3, 0.9), 0.1, WHITE))
    set_camera(scene, (0.2, -2.5, 1.2), (0.0, 0.5, 0.3), (48, 32), 0.5)
    lights, reference = indirect(scene, samples=16), by_monte_carlo(scene, 2048)
    assert np.abs(lights - reference).mean() < 0.1 * reference.mean()
    assert lights.mean() == pytest.approx(reference.mean(), rel=0.03)


def test_the_camera_moves_nothing() -> None:
    """A place on a wall is as bright from anywhere."""
    scene = box_room()
    seen = []
    for eye in ((-0.8, -0.8, -0.2), (0.5, 0.5, 0.5), (-0.9, 0.3, 0.7)):
        set_camera(scene, eye, (1.0, 0.3, 0.2), (1, 1))
        seen.append(indirect(scene, samples=1, filter_width_px=0.0)[0, 0])
    np.testing.assert_allclose(seen[1:], [seen[0]] * 2, rtol=1e-4)


def test_threads_do_not_matter() -> None:
    scene = box_room()
    one, many = (indirect(scene, samples=2, threads=threads) for threads in (1, 4))
    np.testing.assert_array_equal(one, many)


def test_light_that_moves_a_little_changes_a_little() -> None:
    """A step of a millimetre changes no pixel by more than 1 %, and the mean by far less."""
    pictures = [
        indirect(box_room(pivot_core.SphereLight((0.2 + step, 0.1, 0.4), 0.05, WHITE)), samples=4)
        for step in (0.0, 0.001)
    ]
    change = np.abs(pictures[1] / pictures[0] - 1)
    assert change.max() < 0.03
    assert change.mean() < 0.003


def light_count(scene: pivot_core.Scene, asked: int) -> int:
    session = pivot_core.Session(scene, pivot_core.RenderSettings(**VSGL, samples=1, virtual_lights=asked))
    session.start()
    assert session.wait(60)
    return int(session.virtual_lights[0])


@pytest.mark.parametrize("asked", [256, 2048])
def test_there_are_about_as_many_lights_as_asked_for(asked: int) -> None:
    """Half to twice as many where walls are lit; no more where a little metal on a huge ground gives few photons."""
    sparse = pivot_core.Scene()
    grey = sparse.add_material("grey", pivot_core.Material(diffuse=(0.7, 0.7, 0.7)))
    gold = sparse.add_material(
        "gold", pivot_core.Material(conductor_f0=(0.9, 0.7, 0.3), conductor_f90=WHITE, alpha=0.1)
    )
    sparse.add_instances("floor", add_plane(sparse, 20.0), place(), [grey])
    sparse.add_instances("ball", add_sphere(sparse), place(z=0.2, scale=0.2), [gold])
    sparse.add_light("sun", pivot_core.SunLight((0.0, -0.6, 0.8), 0.02, (3.0, 3.0, 3.0)))
    set_camera(sparse, (0.0, -1.2, 0.8), (0.0, 0.0, 0.1), (4, 4), 0.4)
    assert 0.4 * asked < light_count(box_room(), asked) < 2.2 * asked
    assert 0 < light_count(sparse, asked) < 2.2 * asked


def test_light_comes_from_the_little_of_a_wall_that_is_before_a_surface() -> None:
    """A long wall, whose bright end is behind the pillar's front that is seen."""
    scene = pivot_core.Scene()
    grey = scene.add_material("grey", pivot_core.Material(diffuse=(0.7, 0.7, 0.7)))
    scene.add_instances("wall", add_box(scene, (1.0, -1.0, 0.0), (1.1, 9.0, 2.2)), place(), [grey])
    scene.add_instances("pillar", add_box(scene, (-1.0, 2.0, 0.0), (-0.4, 2.4, 2.2)), place(), [grey])
    scene.add_light("lamp", pivot_core.SphereLight((0.5, 7.5, 1.9), 0.05, WHITE))
    scene.add_light("lamp", pivot_core.SphereLight((-0.7, 3.2, 1.8), 0.05, WHITE))
    set_camera(scene, (-0.7, -0.6, 1.1), (-0.7, 2.0, 1.1), (12, 8), 0.1)
    lights, reference = indirect(scene, samples=4), by_monte_carlo(scene)
    assert lights.mean() == pytest.approx(reference.mean(), rel=0.1)


def test_an_object_carries_its_light_along() -> None:
    """All that is lit moves together, so that all cells do."""
    pictures = []
    for shift in (0.0, 0.37):
        scene = pivot_core.Scene()
        grey = scene.add_material("grey", pivot_core.Material(diffuse=(0.6, 0.6, 0.6)))
        scene.add_instances("room", add_box(scene, (-1, -1, -1), (1, 1, 1)), place(x=shift), [grey])
        scene.add_light("lamp", pivot_core.SphereLight((0.2 + shift, 0.1, 0.4), 0.05, WHITE))
        set_camera(scene, (-0.8 + shift, -0.8, -0.2), (0.6 + shift, 0.5, 0.1), (48, 32), 1.0)
        pictures.append(indirect(scene, samples=2))
    np.testing.assert_allclose(pictures[1], pictures[0], rtol=0.02)


def test_a_wall_hides_what_is_behind_it() -> None:
    """A floor that no light leaves but behind a wall."""
    scene = pivot_core.Scene()
    grey = scene.add_material("grey", pivot_core.Material(diffuse=(0.7, 0.7, 0.7)))
    black = scene.add_material("black", pivot_core.Material())
    scene.add_instances("floor", add_plane(scene, 2.0), place(), [grey])
    scene.add_instances("lit", add_box(scene, (-2, 1.5, 0), (2, 1.6, 2)), place(), [grey])
    scene.add_instances("wall", add_box(scene, (-2.5, -0.1, -1), (2.5, 0.0, 4)), place(), [black])
    scene.add_light("lamp", pivot_core.SphereLight((0, 1.0, 1.0), 0.1, WHITE))
    set_camera(scene, (0.0, -2.0, 2.0), (0.0, -1.0, 0.0), (32, 32), 0.3)
    assert indirect(scene, samples=4).max() < 1e-6
    assert indirect(scene, samples=1, occlusion="NONE").min() > 0.0


@pytest.mark.parametrize("alpha", [1e-3, 0.05, 1.0])
@pytest.mark.parametrize("scale", [1e-3, 1.0, 1e3])
def test_any_scene_gives_numbers(alpha: float, scale: float) -> None:
    """Sharp lobes, light that touches what it lights, within and behind it; tiny and huge."""
    scene = pivot_core.Scene()
    shiny = pivot_core.Material(diffuse=(0.3, 0.3, 0.3), conductor_f0=(0.6,) * 3, conductor_f90=WHITE, alpha=alpha)
    material = scene.add_material("shiny", shiny)
    scene.add_instances("floor", add_plane(scene, 2.0), place(scale=scale), [material])
    scene.add_instances("ball", add_sphere(scene), place(z=0.5 * scale, scale=0.5 * scale), [material])
    for z in (0.0, 0.5, 1.0, 1.001, -0.5, 3.0):
        scene.add_light("lamp", pivot_core.SphereLight((0.0, 0.0, z * scale), 0.01 * scale, (scale**2,) * 3))
    eye = (1.5 * scale, -2.0 * scale, 1.0 * scale)
    set_camera(scene, eye, (0.0, 0.0, 0.3 * scale), (32, 24), 0.5)
    light = indirect(scene, samples=2, virtual_lights=256)
    assert np.isfinite(light).all()
    assert (light >= 0).all()


def test_the_setting_is_named() -> None:
    with pytest.raises(ValueError, match="indirect must be one of NONE, VSGL, not 'PHOTONS'"):
        pivot_core.RenderSettings(indirect="PHOTONS")
    with pytest.raises(ValueError, match="virtual_lights"):
        pivot_core.RenderSettings(virtual_lights=0)


def test_few_photons_make_no_bright_points() -> None:
    """A little metal that few photons of many meet, close to a floor."""
    scene = pivot_core.Scene()
    grey = scene.add_material("grey", pivot_core.Material(diffuse=(0.7, 0.7, 0.7)))
    gold = scene.add_material("gold", pivot_core.Material(conductor_f0=(0.9, 0.7, 0.3), conductor_f90=WHITE, alpha=0.1))
    scene.add_instances("floor", add_plane(scene, 3.0), place(), [grey])
    scene.add_instances("ball", add_sphere(scene), place(z=0.2, scale=0.2), [gold])
    scene.add_light("lamp", pivot_core.SphereLight((1.5, 0.0, 2.0), 0.1, WHITE))
    set_camera(scene, (0.0, -1.2, 0.8), (0.0, 0.0, 0.1), (64, 48), 0.4)
    reference = by_monte_carlo(scene, 512)
    assert indirect(scene, samples=8).max() < 2 * np.quantile(reference, 0.9999)
