"""Fog by the Monte Carlo integrator, against quadrature and closed forms.

Each estimate is of one ray: all pixels of a small picture look along it, and their spread is the estimate's error.
"""

from __future__ import annotations

import time
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import pivot_core
import pytest

from tests.core.fog_quadrature import Floats, Fog, Light, Rectangle, Sphere, Spot, Sun, Triple, radiance, transmittance
from tests.core.scenes import add_box, add_plane, add_sphere, place, render, set_camera

BLACK = (0.0, 0.0, 0.0)
LOW, HIGH = (-1.0, -1.0, -1.0), (1.0, 1.0, 1.0)
CYAN = Fog(sigma_s=(0.3, 0.5, 0.8), sigma_a=(0.1, 0.05, 0.2), low=LOW, high=HIGH)
HAZE = Fog(sigma_s=(0.2, 0.3, 0.4), sigma_a=(0.1, 0.05, 0.0))
PLACES = {  # an eye, and whether the fog is bounded
    "from without": ((-0.2, -3.0, 0.2), True),
    "from within": ((-0.3, -0.7, -0.2), True),
    "everywhere": ((-0.2, -2.0, 0.2), False),
}
TARGETS = ((0.1, 0.4, 0.3), (-0.5, 0.9, 0.7))
GLOWS = (0.8, 0.95)
LIGHTS: dict[str, Light] = {
    "sphere": Sphere((0.3, 0.8, 0.9), 0.15, (3.0, 2.0, 1.0)),
    "distant sphere": Sphere((-3.0, 2.0, 4.0), 0.5, (30.0, 20.0, 10.0)),
    "spot": Spot((0.3, 0.8, 1.4), 0.1, (3.0, 2.0, 1.0), (-0.3, -0.6, -1.0), 0.8, 0.5),
    "sun": Sun((0.3, 0.8, 0.6), 0.05, (3.0, 2.0, 1.0)),
    "rectangle": Rectangle((0.2, 0.7, 0.9), (0.4, 0.0, 0.0), (0.0, -0.2, -0.2), (3.0, 2.0, 1.0)),
}


def medium_of(fog: Fog) -> pivot_core.Medium:
    grid = None
    if fog.density != (1.0, BLACK):
        corners = np.stack(np.meshgrid(*zip(fog.low, fog.high, strict=True), indexing="ij"), -1)
        grid_from_object = np.diag([*(1 / np.subtract(fog.high, fog.low)), 1.0])
        grid_from_object[:3, 3] = -grid_from_object[:3, :3] @ fog.low
        grid = pivot_core.VoxelGrid(fog.density_at(corners).T, grid_from_object)
    scattering = [(fog.sigma_s, fog.g, fog.phase)] if any(fog.sigma_s) else []
    return pivot_core.Medium(scattering=scattering, absorption=fog.sigma_a, emission=fog.emission, density=grid)


def scene_of(fogs: Sequence[Fog], lights: Sequence[Light] = (), sky: Triple = BLACK) -> pivot_core.Scene:
    scene = pivot_core.Scene()
    for number, fog in enumerate(fogs):
        if fog.low is None:
            scene.set_world_medium(medium_of(fog))
            continue
        material = scene.add_material(f"fog {number}", pivot_core.Material(), medium_of(fog), has_surface=False)
        scene.add_instances(f"fog {number}", add_box(scene, fog.low, fog.high), place(), [material])
    for light in lights:
        scene.add_light("light", light.core())
    scene.set_world(sky)
    return scene


def estimate(
    scene: pivot_core.Scene, eye: Triple, target: Triple, samples: int = 16, **settings: object
) -> tuple[Floats, Floats]:
    """(3,) each: radiance along the ray, and its standard error."""
    set_camera(scene, eye, target, size=(64, 64), half_width=1e-5)
    settings = {"max_bounces": 0} | settings
    image = render(scene, samples=samples, pixel_filter="BOX", filter_width_px=0.0, **settings)
    values = image[..., :3].reshape(-1, 3).astype(float)
    return values.mean(0), values.std(0) / np.sqrt(len(values))


def assert_is(found: tuple[Floats, Floats], truth: Floats | Triple, tolerance: float = 3e-4) -> None:
    """tolerance: of rounding and the quadrature, relative. The noise must be small enough to tell."""
    (mean, error), truth = found, np.asarray(truth, float)
    assert np.all(error <= 0.005 * truth), f"noise {error} of {truth}"
    assert np.all(abs(mean - truth) <= 5 * error + tolerance * truth), f"{mean} +- {error}, not {truth}"


# -- single scattering
@pytest.mark.parametrize("where", PLACES)
@pytest.mark.parametrize("g", [-0.9, 0.0, 0.3, 0.8, 0.95])
@pytest.mark.parametrize("light", LIGHTS)
def test_light_that_scatters_once_is_what_quadrature_finds(light: str, g: float, where: str) -> None:
    eye, bounded = PLACES[where]
    if light == "sun" and not bounded:
        return  # nothing of it arrives through endless fog: below
    fog = replace(CYAN if bounded else HAZE, g=g)
    scene = scene_of([fog], [LIGHTS[light]])
    for target in TARGETS:
        assert_is(estimate(scene, eye, target, 32), radiance(eye, target, [fog], [LIGHTS[light]]))


@pytest.mark.parametrize("mode", ["JOINT", "MIS"])
@pytest.mark.parametrize("g", GLOWS)
@pytest.mark.parametrize(
    "light", [Sphere((0.3, 2.8, 0.9), 0.3, (3, 2, 1)), Sun((0.5, 5.8, 0.7), 0.05, (3, 2, 1))], ids=["sphere", "sun"]
)
def test_a_lamp_behind_the_fog_glows(light: Light, g: float, mode: str) -> None:
    """The ray goes through the lamp: the peak of the phase function lies within."""
    fog, eye, target = replace(CYAN, g=g), (-0.2, -3.0, 0.2), (0.3, 2.8, 0.9)
    truth = radiance(eye, target, [fog], [light], fineness=4)
    assert_is(estimate(scene_of([fog], [light]), eye, target, light_sampling=mode), truth)


def test_the_quadrature_finds_the_airlight_of_thin_fog() -> None:
    """Intensity over the squared distance, along a ray that passes at 1 m."""
    thin, light = Fog(sigma_s=(1e-6, 2e-6, 4e-6), low=(-9, -9, -9), high=(9, 1, 9)), Sphere((0, 0, 1), 1e-3, (1, 1, 1))
    angle = np.arctan2(3, 1) + np.arctan2(1, 1)
    truth = np.array(thin.sigma_s) / (4 * np.pi) * angle
    np.testing.assert_allclose(radiance((0, -3, 0), (0, 0, 0), [thin], [light]), truth, rtol=1e-4)


@pytest.mark.parametrize("per_m", [1e2, 1e3, 1e4, 1e5])
def test_fog_as_dense_as_a_wall_scatters_at_its_face(per_m: float) -> None:
    """As a half-space does, albedo phase irradiance cos_i / (cos_i + cos_o), all within a thousandth of the lamp's
    distance."""
    eye, lamp = np.array((-0.2, -0.3, 3.0)), Sphere((-1.0, 1.0, 3.0), 0.05, (3.0, 2.0, 1.0))
    fog = replace(
        CYAN, sigma_s=(0.8 * per_m, 0.5 * per_m, 0.3 * per_m), sigma_a=(0.2 * per_m, 0.5 * per_m, 0.7 * per_m)
    )
    place = eye * (1 / 3, 1 / 3, 1 / 3)  # towards the origin, on the box's upper side
    to_lamp = np.array(lamp.position) - place
    cos_o, cos_i = eye[2] / np.linalg.norm(eye), to_lamp[2] / np.linalg.norm(to_lamp)
    irradiance = np.array(lamp.intensity) / (to_lamp @ to_lamp)
    truth = np.array((0.8, 0.5, 0.3)) / (4 * np.pi) * irradiance * cos_i / (cos_i + cos_o)
    found = estimate(scene_of([fog], [lamp]), tuple(eye), (0.0, 0.0, 0.0))
    rounding = 2 * float(np.spacing(np.float32(2))) * per_m  # of distances from the eye and from the lamp
    assert_is(found, truth, tolerance=2 / per_m + 3e-3 + rounding)


@pytest.mark.parametrize("integrator", ["MONTE_CARLO", "ANALYTIC"])
def test_fog_before_the_near_clip_is_not_there(integrator: str) -> None:
    fog, light = replace(HAZE, g=0.3), LIGHTS["sphere"]
    eye, target = np.array(PLACES["everywhere"][0]), np.array(TARGETS[0])
    on_the_way = 0.25 * (target - eye) / np.linalg.norm(target - eye)
    seen = []
    for start, clip_m in ((eye, 0.25), (eye + on_the_way, 0.0)):
        scene = scene_of([fog], [light])
        set_camera(scene, tuple(start), tuple(target), (8, 8), 1e-5, clip_start_m=clip_m)
        seen.append(render(scene, samples=64, max_bounces=0, integrator=integrator)[..., :3].mean((0, 1)))
    np.testing.assert_allclose(*seen, rtol=2e-3)


def test_no_sun_arrives_through_endless_fog() -> None:
    scene = scene_of([HAZE], [LIGHTS["sun"]])
    assert_is(estimate(scene, (0, 0, 0), (0, 1, 0)), BLACK)


@pytest.mark.parametrize("light", LIGHTS)
@pytest.mark.parametrize("g_p", [-0.7, 0.5, 0.9])
def test_the_pivot_phase_function_scatters_as_it_says(light: str, g_p: float) -> None:
    fog = replace(CYAN, g=g_p, phase="PIVOT")
    eye = PLACES["from without"][0]
    scene = scene_of([fog], [LIGHTS[light]])
    assert_is(estimate(scene, eye, TARGETS[0]), radiance(eye, TARGETS[0], [fog], [LIGHTS[light]]))


@pytest.mark.parametrize("mode", ["JOINT", "SPTD", "MIS", "LIGHT"])
@pytest.mark.parametrize("light", LIGHTS)
def test_all_ways_to_sample_light_agree(light: str, mode: str) -> None:
    fog, eye = replace(CYAN, g=0.6), PLACES["from without"][0]
    found = estimate(scene_of([fog], [LIGHTS[light]]), eye, TARGETS[0], samples=64, light_sampling=mode)
    assert_is(found, radiance(eye, TARGETS[0], [fog], [LIGHTS[light]]))


def test_samples_of_the_phase_function_alone_find_the_same() -> None:
    """They meet large lights only."""
    light, fog = Sphere((0.3, 2.5, 0.9), 1.2, (3.0, 2.0, 1.0)), replace(CYAN, g=0.6)
    found = estimate(scene_of([fog], [light]), (-0.2, -3.0, 0.2), TARGETS[0], samples=64, light_sampling="BSDF")
    assert_is(found, radiance((-0.2, -3.0, 0.2), TARGETS[0], [fog], [light]))


def test_several_lights_add() -> None:
    fog, eye, lights = replace(CYAN, g=0.5), PLACES["from without"][0], list(LIGHTS.values())
    assert_is(estimate(scene_of([fog], lights), eye, TARGETS[0], 64), radiance(eye, TARGETS[0], [fog], lights))


def test_a_wall_keeps_the_light_off() -> None:
    scene = scene_of([CYAN], [Sphere((0.0, 0.0, 3.0), 0.1, (9.0, 9.0, 9.0))])
    scene.add_instances("wall", add_plane(scene), place(z=2.0), [scene.add_material("wall", pivot_core.Material())])
    assert_is(estimate(scene, (0.0, -3.0, 0.0), (0.0, 0.0, 0.0)), BLACK)


def test_a_surface_is_lit_and_seen_through_fog() -> None:
    fog, light, eye, target = CYAN, LIGHTS["sphere"], (-0.2, -0.9, 0.5), np.array([0.2, 0.3, -0.5])
    scene = scene_of([fog], [light])
    grey = scene.add_material("grey", pivot_core.Material(diffuse=(0.5, 0.5, 0.5)))
    scene.add_instances("floor", add_plane(scene, 5.0), place(z=-0.5), [grey])
    omega, distance, shine = light.seen_from(target[None], 2)
    arriving = shine * transmittance([fog], np.broadcast_to(target, omega.shape), omega, distance)
    lit = 0.5 / np.pi * (omega[..., 2:] * arriving).sum((0, 1))
    end_m = float(np.linalg.norm(target - eye))
    assert_is(estimate(scene, eye, target, 64), radiance(eye, target, [fog], [light], end_m, lit))


# -- what fog takes and gives by itself
FOGS = {  # absorbing alone, and in the order of their names
    "one": [replace(CYAN, sigma_s=BLACK)],
    "endless, up to a wall": [replace(CYAN, sigma_s=BLACK, low=None, high=None)],
    "nested": [replace(CYAN, sigma_s=BLACK), Fog(sigma_a=(0.7, 0.2, 0.0), low=(-0.5,) * 3, high=(0.6,) * 3)],
    "overlapping": [replace(CYAN, sigma_s=BLACK), Fog(sigma_a=(0.7, 0.2, 0.0), low=(-0.6, 0.2, -0.6), high=(2,) * 3)],
    "in endless fog": [replace(CYAN, sigma_s=BLACK), Fog(sigma_a=(0.1, 0.2, 0.3))],
    "with a common face": [Fog(sigma_a=(0.7, 0.2, 0.1), low=LOW, high=(1, 0, 1)),
                           Fog(sigma_a=(0.7, 0.2, 0.1), low=(-1, 0, -1), high=HIGH)],
    "denser to one side": [replace(CYAN, sigma_s=BLACK, density=(1.0, (0.2, 0.5, -0.1)))],
}  # fmt: skip


@pytest.mark.parametrize("eye", [(-0.2, -3.0, 0.2), (-0.3, -0.4, -0.2)], ids=["without", "within"])
@pytest.mark.parametrize("name", FOGS)
def test_what_is_behind_is_seen_by_transmittance(name: str, eye: Triple) -> None:
    fogs, wall_y = FOGS[name], 3.0
    scene = scene_of(fogs)
    glow = scene.add_material("glow", pivot_core.Material(emission=(1.0, 2.0, 3.0)))
    scene.add_instances("wall", add_box(scene, (-9, wall_y, -9), (9, wall_y + 1, 9)), place(), [glow])
    for target in TARGETS:
        direction = np.subtract(target, eye) / np.linalg.norm(np.subtract(target, eye))
        end_m = (wall_y - eye[1]) / direction[1]
        truth = radiance(eye, target, fogs, [], float(end_m), (1.0, 2.0, 3.0))
        assert_is(estimate(scene, eye, target, 64), truth)


@pytest.mark.parametrize("eye", [(-0.2, -3.0, 0.2), (-0.3, -0.4, -0.2)], ids=["without", "within"])
@pytest.mark.parametrize("sigma_a", [BLACK, (0.5, 1.0, 4.0)])
def test_fog_glows(sigma_a: Triple, eye: Triple) -> None:
    fog = Fog(sigma_a=sigma_a, emission=(1.0, 2.0, 3.0), low=LOW, high=HIGH)
    assert_is(estimate(scene_of([fog]), eye, TARGETS[0], 64), radiance(eye, TARGETS[0], [fog], []))


@pytest.mark.parametrize(
    "fogs", ["nested", "overlapping", "in endless fog", "with a common face", "denser to one side"]
)
def test_several_fogs_scatter_each_its_own(fogs: str) -> None:
    scattering = [replace(fog, sigma_s=fog.sigma_a, g=g) for fog, g in zip(FOGS[fogs], (0.7, -0.3), strict=False)]
    eye, light = (-0.2, -3.0, 0.2), LIGHTS["distant sphere"]
    found = estimate(scene_of(scattering, [light]), eye, TARGETS[0], 64)
    assert_is(found, radiance(eye, TARGETS[0], scattering, [light]))


def test_a_floor_may_be_the_bottom_of_the_fog() -> None:
    """Seen through it is what stands a little above the bottom."""

    def picture(bottom: float) -> tuple[Floats, Floats]:
        scene = scene_of([replace(CYAN, low=(-1, -1, bottom))], [LIGHTS["sphere"]])
        grey = scene.add_material("grey", pivot_core.Material(diffuse=(0.5, 0.5, 0.5)))
        scene.add_instances("floor", add_box(scene, (-1, -1, -1.5), (1, 1, -0.5)), place(), [grey])
        return estimate(scene, (-0.2, -2.5, 0.6), (0.1, 0.2, -0.5), 64, max_bounces=2)

    (shared, error), (above, other_error) = picture(-0.5), picture(-0.6)
    assert np.all(abs(shared - above) < 5 * (error + other_error))
    assert np.all(error < 0.005 * above)


# -- light that scatters many times
@pytest.mark.parametrize("g", [0.0, 0.6])
@pytest.mark.parametrize("density", [(1.0, BLACK), (1.0, (0.2, 0.5, -0.1))], ids=["even", "uneven"])
def test_white_fog_in_a_white_world_is_not_seen(g: float, density: tuple[float, Triple]) -> None:
    fog = Fog(sigma_s=(0.5, 1.0, 2.0), g=g, low=LOW, high=HIGH, density=density)
    scene = scene_of([fog], sky=(1.0, 1.0, 1.0))
    for eye in ((-0.2, -3.0, 0.2), (-0.3, -0.4, -0.2)):
        assert_is(estimate(scene, eye, TARGETS[0], 64, max_bounces=256), (1.0, 1.0, 1.0), tolerance=1e-3)


def test_endless_fog_that_glows_is_as_bright_as_it_is_thick() -> None:
    """Emission over absorption, whatever it scatters."""
    fog = Fog(sigma_s=(1.0, 0.5, 2.0), sigma_a=(1.0, 0.5, 2.0), emission=(1.0, 1.0, 1.0), g=0.3)
    found = estimate(scene_of([fog]), (0, 0, 0), (1, 1, 1), 64, max_bounces=64)
    assert_is(found, (1.0, 2.0, 0.5), tolerance=1e-3)


# -- limits
def ball_scene(fog: Fog | None) -> pivot_core.Scene:
    scene = scene_of([fog] if fog else [], [LIGHTS["sphere"], LIGHTS["sun"]], sky=(0.1, 0.1, 0.2))
    grey = scene.add_material("grey", pivot_core.Material(diffuse=(0.5, 0.5, 0.5)))
    scene.add_instances("ball", add_sphere(scene), place(scale=0.4), [grey])
    set_camera(scene, (-0.2, -3.0, 0.4), size=(32, 32))
    return scene


@pytest.mark.parametrize("density", [0.0, 1e-12])
def test_the_thinnest_fog_is_none(density: float) -> None:
    thin = Fog(sigma_s=(density,) * 3, sigma_a=(density,) * 3, low=LOW, high=HIGH)
    with_fog, without = (render(ball_scene(fog), samples=16, max_bounces=2) for fog in (thin, None))
    np.testing.assert_allclose(with_fog, without, atol=1e-4)


@pytest.mark.parametrize("density", [(1.0, BLACK), (1.0, (0.2, 0.5, -0.1))], ids=["even", "uneven"])
@pytest.mark.parametrize("absorption", [0.0, 1e4])
def test_the_densest_fog_ends_in_time(absorption: float, density: tuple[float, Triple]) -> None:
    dense = Fog(sigma_s=(1e4, 2e4, 5e3), sigma_a=(absorption,) * 3, g=0.5, low=LOW, high=HIGH, density=density)
    start_s = time.monotonic()
    image = render(ball_scene(dense), samples=4, max_bounces=16)
    assert time.monotonic() - start_s < 20
    assert np.isfinite(image).all()
    assert image[12:20, 12:20, :3].mean() > 1e-3  # its surface is lit


@pytest.mark.parametrize("mode", ["JOINT", "MIS", "LIGHT", "BSDF"])
@pytest.mark.parametrize("phase", ["HENYEY_GREENSTEIN", "PIVOT"])
@pytest.mark.parametrize("g", [-0.999, 0.999])
def test_the_sharpest_phase_functions_are_finite(g: float, phase: str, mode: str) -> None:
    fog = replace(CYAN, g=g, phase=phase)
    image = render(ball_scene(fog), samples=8, max_bounces=2, light_sampling=mode)
    assert np.isfinite(image).all()


@pytest.mark.parametrize("mode", ["JOINT", "MIS", "LIGHT", "BSDF"])
@pytest.mark.parametrize("eye", [(0.3, 0.8, 0.9), (0.3, 0.72, 0.93)], ids=["at the middle", "beside it"])
def test_a_camera_inside_a_lamp_is_finite(eye: Triple, mode: str) -> None:
    scene = ball_scene(replace(CYAN, g=0.9))
    set_camera(scene, eye, (0.0, 0.0, 0.0), size=(32, 32))
    image = render(scene, samples=8, max_bounces=2, light_sampling=mode)
    assert np.isfinite(image).all()
    assert image[..., :3].mean() > 0.0


def test_fog_is_the_same_for_any_number_of_threads() -> None:
    one, two = (render(ball_scene(CYAN), samples=8, max_bounces=2, threads=threads) for threads in (1, 2))
    np.testing.assert_array_equal(one, two)
