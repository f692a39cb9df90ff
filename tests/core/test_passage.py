"""Light that goes straight on through surfaces: seen by the camera, in shadows, and by paths."""

from __future__ import annotations

import numpy as np
import pivot_core
import pytest
from numpy.typing import NDArray
from scenes import Floats, add_plane, place, render, set_camera

INTEGRATORS = ("MONTE_CARLO", "ANALYTIC")
ALPHA = 0.3
VEIL = pivot_core.Material(transparency=(0.7, 0.7, 0.35), opacity=ALPHA)
PASSES = np.array([0.7, 0.7, 0.35])
WHITE = pivot_core.Material(diffuse=(0.8, 0.8, 0.8))
SUN = pivot_core.SunLight((0, 0, 1), 0.01, (1, 1, 1))
LIGHTS = {
    "sun": SUN,
    "sphere": pivot_core.SphereLight((0, 0, 6), 0.3, (50, 50, 50)),
    "area": pivot_core.AreaLight((0, 0, 6), (0.5, 0, 0), (0, -0.5, 0), (20, 20, 20)),
}


def stack(count: int, material: pivot_core.Material | pivot_core.Shader, lowest_m: float = 1.0) -> pivot_core.Scene:
    """So many wide planes of a material above each other."""
    scene = pivot_core.Scene()
    plane, id_ = add_plane(scene), scene.add_material("veil", material)
    for i in range(count):
        scene.add_instances(f"veil {i}", plane, place(z=lowest_m + 0.1 * i), [id_])
    return scene


def seen_from_above(scene: pivot_core.Scene, **settings: object) -> NDArray[np.float64]:
    """The mean pixel."""
    set_camera(scene, (0.3, 0.2, 9.0), size=(16, 16))
    return mean(render(scene, **settings))


def mean(picture: Floats) -> NDArray[np.float64]:
    return picture.mean(axis=(0, 1), dtype=np.float64)


def lit_ground(count: int, light: object, **settings: object) -> NDArray[np.float64]:
    """The mean of a ground that a camera sees from beneath the stack."""
    scene = stack(count, VEIL)
    scene.add_instances("ground", add_plane(scene), place(), [scene.add_material("ground", WHITE)])
    scene.add_light("light", light)
    set_camera(scene, (0.3, 0.2, 0.9), size=(16, 16))
    return mean(render(scene, max_bounces=0, samples=16, **settings))[:3]


@pytest.mark.parametrize("integrator", INTEGRATORS)
@pytest.mark.parametrize("count", [1, 3, 8])
def test_a_stack_passes_what_each_passes(integrator: str, count: int) -> None:
    scene = stack(count, VEIL)
    scene.set_world((1, 1, 1))
    samples = 16 if count == 1 or integrator == "ANALYTIC" else 256
    found = seen_from_above(scene, integrator=integrator, samples=samples)[:3]
    assert found == pytest.approx(PASSES**count, rel=1e-4 if integrator == "ANALYTIC" else 3e-3)


@pytest.mark.parametrize("integrator", INTEGRATORS)
@pytest.mark.parametrize("kind", LIGHTS)
@pytest.mark.parametrize("count", [1, 5])
def test_shadows_are_what_a_stack_passes(integrator: str, kind: str, count: int) -> None:
    free, veiled = (lit_ground(n, LIGHTS[kind], integrator=integrator) for n in (0, count))
    assert veiled / free == pytest.approx(PASSES**count, rel=2e-4)


def test_a_furnace_stays_white() -> None:
    """What is not let through is reflected."""
    scene = stack(4, pivot_core.Material(diffuse=(0.5, 0.5, 0.5), transparency=(0.5, 0.5, 0.5)))
    scene.set_world((1, 1, 1))
    picture = render_from_above(scene, samples=256, max_bounces=64, max_passages=1000, max_path_passages=1000)
    noise = picture[..., 0].std() / np.sqrt(picture[..., 0].size)
    assert mean(picture)[:3] == pytest.approx(np.ones(3), abs=4 * noise + 1e-5)


def render_from_above(scene: pivot_core.Scene, **settings: object) -> Floats:
    set_camera(scene, (0.3, 0.2, 9.0), size=(16, 16))
    return render(scene, **settings)


@pytest.mark.parametrize("integrator", INTEGRATORS)
def test_so_many_surfaces_are_seen_and_shade_and_then_what_shines_is_seen(integrator: str) -> None:
    def world_seen(count: int, max_path_passages: int) -> float:
        scene = stack(count, pivot_core.Material(transparency=(1, 1, 1)))
        scene.set_world((1, 1, 1))
        settings = {"max_passages": 2, "max_path_passages": max_path_passages}
        return seen_from_above(scene, integrator=integrator, samples=4, **settings)[0]

    assert [world_seen(count, 3) for count in (2, 3, 4)] == pytest.approx([1, 1, 0])
    assert [world_seen(count, 2) for count in (2, 3)] == pytest.approx([1, 0])
    free = lit_ground(0, SUN, integrator=integrator)
    shaded = [lit_ground(count, SUN, integrator=integrator, max_passages=2)[0] / free[0] for count in (2, 3)]
    assert shaded == pytest.approx([0.49, 0], rel=1e-3)


@pytest.mark.parametrize("integrator", INTEGRATORS)
def test_a_transparent_film_keeps_what_veils_hide(integrator: str) -> None:
    grey = pivot_core.Material(transparency=(0.6, 0.6, 0.6))
    alpha = seen_from_above(stack(2, grey), integrator=integrator, samples=16, transparent_film=True)[3]
    assert alpha == pytest.approx(1 - 0.6**2, abs=1e-3)


@pytest.mark.parametrize("integrator", INTEGRATORS)
def test_a_program_says_where_light_passes(integrator: str) -> None:
    """A leaf's picture: opaque where x is positive."""
    program = pivot_core.Program()
    x = program.add("position", [], [])
    opacity = program.add("math_greater_than", [(x, 0.0), (-1, 0.0)], [])
    passed = program.add("math_subtract", [(-1, 1.0), (opacity, 0.0)], [])
    leaf = pivot_core.Shader(
        pivot_core.Material(),
        program,
        {"transparency": [passed] * 3, "opacity": [opacity]},
    )
    scene = stack(3, leaf)
    scene.set_world((1, 1, 1))
    set_camera(scene, (0, 0, 9.0), size=(16, 16))
    picture = render(scene, integrator=integrator, samples=4, filter_width_px=0.1)
    assert picture[:, :8, 0] == pytest.approx(1.0)
    assert picture[:, 8:, 0] == pytest.approx(0.0)


def test_light_behind_a_veil_keeps_the_weights_of_who_samples_it() -> None:
    """A shining mesh above a veil and a glossy ground, found by light samples, by BSDF samples, and by both."""

    def lit(sampling: str, samples: int) -> Floats:
        scene = stack(2, VEIL)
        metal = pivot_core.Material(diffuse=(0.3, 0.3, 0.3), conductor_f0=(0.6,) * 3, conductor_f90=(0.6,) * 3)
        lamp = pivot_core.Material(emission=(3, 3, 3))
        scene.add_instances("ground", add_plane(scene), place(), [scene.add_material("ground", metal)])
        scene.add_instances("lamp", add_plane(scene, 1.0), place(z=3), [scene.add_material("lamp", lamp)])
        scene.add_light("ball", pivot_core.SphereLight((1.5, 0, 2.5), 0.5, (4, 4, 4)))
        set_camera(scene, (1.5, 1.0, 0.9), (0, 0, 0), size=(16, 16))
        return render(scene, light_sampling=sampling, samples=samples, max_bounces=0)[..., :3]

    pictures = {sampling: mean(lit(sampling, 256)) for sampling in ("JOINT", "MIS", "LIGHT")}
    found = mean(lit("BSDF", 4096))
    for sampling, picture in pictures.items():
        assert picture == pytest.approx(found, rel=0.01), sampling


def test_a_material_that_becomes_transparent_lets_light_pass() -> None:
    scene = stack(1, WHITE)
    scene.set_world((1, 1, 1))
    before = seen_from_above(scene, samples=4)
    scene.set_material(0, VEIL)
    assert seen_from_above(scene, samples=16)[:3] == pytest.approx(PASSES, rel=1e-3)
    scene.set_material(0, WHITE)
    assert np.array_equal(seen_from_above(scene, samples=4), before)


def test_a_mesh_may_be_transparent_in_part() -> None:
    """Its other material stops light, on an instance in a space of its own too."""
    scene = pivot_core.Scene()
    e = 50.0
    positions = np.array([[-e, -e, 0], [0, -e, 0], [e, -e, 0], [-e, e, 0], [0, e, 0], [e, e, 0]], np.float32)
    corners = np.array([[0, 1, 4], [0, 4, 3], [1, 2, 5], [1, 5, 4]])
    mesh = scene.add_mesh("halves", positions, np.arange(6), corners, triangle_slots=np.array([0, 0, 1, 1], np.int32))
    ids = [scene.add_material("veil", VEIL), scene.add_material("black", pivot_core.Material())]
    instance = scene.add_instances("halves", mesh, place(z=5), ids)
    scene.add_instances("ground", add_plane(scene), place(), [scene.add_material("ground", WHITE)])
    scene.add_light("sun", SUN)

    def lit() -> Floats:
        set_camera(scene, (0, 0, 0.9), size=(16, 16))
        return render(scene, samples=4, max_bounces=0)[..., 0]

    still = lit()
    assert still[:, :6] == pytest.approx(0.7 * 0.8 / np.pi, rel=0.02)
    assert still[:, 10:] == pytest.approx(0.0)
    scene.set_instance_transform(instance, place(z=4)[0])
    moved = lit()
    assert np.delete(moved, range(6, 10), 1) == pytest.approx(np.delete(still, range(6, 10), 1), abs=1e-4)


def test_surfaces_of_no_opacity_change_no_fog() -> None:
    """Each part of a ray between them scatters as the whole would."""

    def foggy(count: int, **settings: object) -> NDArray[np.float64]:
        scene = stack(count, pivot_core.Material(transparency=(1, 1, 1)), lowest_m=0.5)
        fog = pivot_core.Medium(scattering=[((0.15, 0.1, 0.05), 0.3, "HENYEY_GREENSTEIN")], absorption=(0.02,) * 3)
        scene.set_world_medium(fog)
        scene.add_instances("ground", add_plane(scene, 8.0), place(), [scene.add_material("ground", WHITE)])
        scene.add_light("ball", pivot_core.SphereLight((0.5, 0.3, 2.5), 0.3, (5, 5, 5)))
        return seen_from_above(scene, **settings)[:3]

    settings = {"samples": 256, "max_bounces": 2, "max_passages": 100, "max_path_passages": 100}
    assert foggy(3, **settings) == pytest.approx(foggy(0, **settings), rel=0.01)
