"""Whole renders whose result is known: closed forms, furnaces, the equality of all sampling strategies."""

from __future__ import annotations

import numpy as np
import pivot_core
import pytest
from scenes import add_plane, add_sphere, place, render, set_camera

STRATEGIES = ["JOINT", "SPTD", "MIS", "LIGHT", "BSDF"]


def lit_plane(light: object, **material: object) -> pivot_core.Scene:
    """A plane seen from above at its origin, in so narrow a view that one number describes the picture."""
    scene = pivot_core.Scene()
    plane = add_plane(scene)
    scene.add_instances("plane", plane, place(), [scene.add_material("m", pivot_core.Material(**material))])
    scene.add_light("light", light)
    set_camera(scene, (0, 0, 10), size=(8, 8), half_width=1e-4)
    return scene


SPHERE = pivot_core.SphereLight((0.3, 0.2, 2.0), 0.5, (3.0, 2.0, 1.0))
CLOSED_FORM_LIGHTS = {
    # A sphere above the horizon gives the irradiance of its centre, intensity cos / d^2 [the form factor of a sphere].
    "sphere": (SPHERE, np.array([3.0, 2.0, 1.0]) * 2.0 / np.sqrt(0.09 + 0.04 + 4.0) ** 3),
    "point": (pivot_core.SphereLight((0.0, 0.0, 2.0), 0.0, (1.0, 1.0, 1.0)), np.full(3, 0.25)),
    "sphere around the receiver": (pivot_core.SphereLight((0.2, 0.0, 0.1), 2.0, (4.0, 4.0, 4.0)), np.full(3, 1.0)),
    "sphere touching the receiver": (pivot_core.SphereLight((0.0, 0.0, 1.0), 1.0, (1.0, 1.0, 1.0)), np.full(3, 1.0)),
    "sun": (pivot_core.SunLight((0.0, 0.6, 0.8), 0.3, (2.0, 1.0, 0.5)), np.array([2.0, 1.0, 0.5]) * 0.8),
    "spot, inside its cone": (
        pivot_core.SpotLight((0.0, 0.0, 2.0), 0.1, (4.0, 4.0, 4.0), (0.0, 0.0, -1.0), np.cos(0.6), 0.15),
        np.full(3, 1.0),
    ),
    # A disk facing its receiver: pi L sin^2 of its half-angle.
    "disk": (
        pivot_core.AreaLight((0.0, 0.0, 2.0), (1.0, 0.0, 0.0), (0.0, -1.0, 0.0), (1.0, 1.0, 1.0), ellipse=True),
        np.full(3, np.pi / 5.0),
    ),
    # A square facing its receiver: four right triangles' form factors.
    "square": (
        pivot_core.AreaLight((0.0, 0.0, 2.0), (1.0, 0.0, 0.0), (0.0, -1.0, 0.0), (1.0, 1.0, 1.0)),
        np.full(3, 4.0 / np.sqrt(5.0) * np.arctan(1.0 / np.sqrt(5.0))),
    ),
}


@pytest.mark.parametrize("name", CLOSED_FORM_LIGHTS)
@pytest.mark.parametrize("method", [*STRATEGIES, "ANALYTIC"])
def test_diffuse_plane_has_the_irradiance_of_the_closed_form(name: str, method: str) -> None:
    light, irradiance = CLOSED_FORM_LIGHTS[name]
    if method == "BSDF" and name == "point":
        pytest.skip("a BSDF sample meets a light of radius 0 once in 10^10")
    scene = lit_plane(light, diffuse=(0.5, 0.5, 0.5))
    settings = {"integrator": "ANALYTIC"} if method == "ANALYTIC" else {"light_sampling": method}
    image = render(scene, samples=1024, max_bounces=0, **settings)[..., :3]
    expected = 0.5 / np.pi * irradiance
    noise = image.reshape(-1, 3).std(0) / 8.0  # of the mean of 64 pixels
    np.testing.assert_array_less(np.abs(image.mean((0, 1)) - expected), 5.0 * noise + 2e-4 * expected)


def test_area_light_shines_from_one_side_only() -> None:
    light = pivot_core.AreaLight((0.0, 0.0, 2.0), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (1.0, 1.0, 1.0))
    assert render(lit_plane(light, diffuse=(1, 1, 1)), samples=4)[..., :3].max() == 0.0


def test_spot_is_dark_outside_its_cone_and_smooth_inside() -> None:
    scene = pivot_core.Scene()
    material = scene.add_material("m", pivot_core.Material(diffuse=(1, 1, 1)))
    scene.add_instances("plane", add_plane(scene), place(), [material])
    half_angle = 0.5
    scene.add_light("s", pivot_core.SpotLight((0, 0, 1), 0.0, (1, 1, 1), (0, 0, -1), np.cos(half_angle), 0.5))
    set_camera(scene, (0, 0, 10), size=(101, 1), half_width=0.08)
    row = render(scene, samples=1, max_bounces=0, filter_width_px=0.0)[0, :, 0]
    x = (np.arange(101) + 0.5) / 101 * 1.6 - 0.8
    cos_t = 1.0 / np.sqrt(1.0 + x * x)
    t = np.clip((cos_t - np.cos(half_angle)) / ((1 - np.cos(half_angle)) * 0.5), 0, 1)
    np.testing.assert_allclose(row, t * t * (3 - 2 * t) * cos_t**3 / np.pi, atol=1e-4)


def ball(material: pivot_core.Material) -> pivot_core.Scene:
    scene = pivot_core.Scene()
    scene.add_instances("ball", add_sphere(scene), place(), [scene.add_material("m", material)])
    set_camera(scene, (0, -6, 0), size=(48, 48), half_width=0.15)
    return scene


def ggx_albedo(alpha: float, cos_o: float) -> float:
    """Albedo of GGX with F = 1 by plain quadrature over visible normals: the mean of G2 / G1."""
    n = 200
    u, v = np.meshgrid((np.arange(n) + 0.5) / n, (np.arange(n) + 0.5) / n)
    wo = np.array([np.sqrt(1 - cos_o**2), 0.0, cos_o])
    stretched = wo * [alpha, alpha, 1.0]
    stretched /= np.linalg.norm(stretched)
    z = (1 - v) * (1 + stretched[2]) - stretched[2]
    r = np.sqrt(np.maximum(0, 1 - z * z))
    h = np.stack([r * np.cos(2 * np.pi * u), r * np.sin(2 * np.pi * u), z], -1) + stretched
    h *= [alpha, alpha, 1.0]
    h /= np.linalg.norm(h, axis=-1, keepdims=True)
    wi = 2 * (h @ wo)[..., None] * h - wo

    def smith_lambda(w: np.ndarray) -> np.ndarray:
        return (np.sqrt(1 + alpha**2 * (w[..., 0] ** 2 + w[..., 1] ** 2) / w[..., 2] ** 2) - 1) / 2

    ratio = (1 + smith_lambda(wo)) / (1 + smith_lambda(wo) + smith_lambda(wi))
    return float(np.where(wi[..., 2] > 0, ratio, 0.0).mean())


def furnace(material: pivot_core.Material, **settings: object) -> np.ndarray:
    """What a ball in a white world reflects: (rows of) radiance and the cosine of view, where the ball is well seen."""
    scene = ball(material)
    scene.set_world((1, 1, 1))
    image = render(scene, samples=256, max_bounces=0, filter_width_px=0.0, **settings)
    normal = render(scene, "Normal", samples=1, filter_width_px=0.0)
    position = render(scene, "Position", samples=1, filter_width_px=0.0)
    to_eye = np.array([0, -6, 0]) - position
    cos_o = (normal * to_eye).sum(-1) / np.maximum(np.linalg.norm(to_eye, axis=-1), 1e-9)
    seen = cos_o > 0.15
    return np.stack([image[seen][:, 0], cos_o[seen]])


@pytest.mark.parametrize("method", ["MONTE_CARLO", "ANALYTIC"])
def test_furnace_returns_all_of_a_white_diffuse_ball(method: str) -> None:
    radiance, _ = furnace(pivot_core.Material(diffuse=(1, 1, 1)), integrator=method)
    assert radiance.max() < 1.0 + 1e-5
    # A few directions lie above the smooth normal's horizon and below the facet's: 1 sample of 256 in 2 % of pixels.
    assert radiance.min() > 1.0 - 2.5 / 256
    assert radiance.mean() > 1.0 - 2e-4


@pytest.mark.parametrize("alpha", [0.01, 0.1, 0.5, 1.0])
@pytest.mark.parametrize("method", ["MONTE_CARLO", "ANALYTIC"])
def test_furnace_loses_what_single_scattering_loses(alpha: float, method: str) -> None:
    """A Glossy BSDF of colour 1 reflects its own albedo, which is below 1 by the light lost between microfacets."""
    glossy = pivot_core.Material(alpha=alpha, conductor_f0=(1, 1, 1), conductor_f90=(1, 1, 1))
    radiance, cos_o = furnace(glossy, integrator=method)
    expected = np.interp(cos_o, np.linspace(0.1, 1, 40), [ggx_albedo(alpha, c) for c in np.linspace(0.1, 1, 40)])
    # A single pixel's 256 samples still have noise; the table of the analytic integrator has 64 x 64 cells.
    assert np.abs(radiance - expected).max() < 0.04
    assert abs((radiance - expected).mean()) < 2e-3


@pytest.mark.parametrize("alpha", [0.1, 0.5, 1.0])
def test_furnace_keeps_all_with_multiple_scattering(alpha: float) -> None:
    material = pivot_core.Material(alpha=alpha, conductor_f0=(1, 1, 1), conductor_f90=(1, 1, 1), multiscatter=True)
    radiance, _ = furnace(material)
    assert abs(radiance.mean() - 1.0) < 3e-3


@pytest.mark.parametrize("alpha", [0.04, 0.25, 1.0])
def test_furnace_gains_nothing_on_a_white_plastic(alpha: float) -> None:
    """The diffuse lobe gives up the dielectric's share of a surface that loses nothing between microfacets, as in
    Cycles; what is missing is that share of the lobe's own loss. Below 0.1 of the light is reflected at these angles
    on average."""
    radiance, cos_o = furnace(pivot_core.Material(diffuse=(1, 1, 1), alpha=alpha, dielectric_weight=1.0))
    lobe_loss = 1.0 - np.mean([ggx_albedo(alpha, c) for c in cos_o[::20]])
    assert 1.0 - 0.1 * lobe_loss - 3e-3 < radiance.mean() < 1.0 + 3e-3


@pytest.mark.parametrize("alpha", [0.04, 0.25, 1.0])
@pytest.mark.parametrize("metallic", [0.0, 0.5])
def test_furnace_keeps_all_of_a_white_multiscatter_plastic(alpha: float, metallic: float) -> None:
    """Also beside a share of white metal."""
    plastic, metal = (3 * (weight,) for weight in (1.0 - metallic, metallic))
    material = pivot_core.Material(
        diffuse=plastic,
        alpha=alpha,
        conductor_f0=metal,
        conductor_f90=metal,
        conductor_weight=metallic,
        dielectric_weight=1.0 - metallic,
        multiscatter=True,
    )
    radiance, _ = furnace(material)
    assert abs(radiance.mean() - 1.0) < 3e-3


@pytest.mark.parametrize("metallic", [0.5, 1.0])
def test_furnace_of_a_coloured_conductor_loses_at_each_bounce(metallic: float) -> None:
    """Its multiple scattering is that of its own reflectance, whatever weight the lobe has."""
    single, multiple = (
        furnace(
            pivot_core.Material(
                alpha=1.0,
                conductor_f0=3 * (0.2 * metallic,),
                conductor_f90=3 * (0.2 * metallic,),
                conductor_weight=metallic,
                multiscatter=multiscatter,
            )
        )[0].mean()
        for multiscatter in (False, True)
    )
    mean_albedo = single / (0.2 * metallic)
    gain = 1.0 + 0.2 * mean_albedo / (1.0 - 0.2 * (1.0 - mean_albedo)) * (1.0 - mean_albedo) / mean_albedo
    assert multiple / single == pytest.approx(gain, rel=0.05)


def still_life() -> pivot_core.Scene:
    """Every light type on every kind of material, with shadows; lights so large that BSDF samples meet them too."""
    scene = pivot_core.Scene()
    floor = scene.add_material("floor", pivot_core.Material(diffuse=(0.4, 0.3, 0.2), dielectric_weight=1.0, alpha=0.05))
    metal = scene.add_material(
        "metal", pivot_core.Material(alpha=0.1, conductor_f0=(0.9, 0.6, 0.3), conductor_f90=(1, 1, 1))
    )
    chalk = scene.add_material("chalk", pivot_core.Material(diffuse=(0.8, 0.8, 0.8)))
    satin = scene.add_material(
        "satin", pivot_core.Material(diffuse=(0.1, 0.2, 0.5), dielectric_weight=1.0, alpha=0.3, multiscatter=True)
    )
    sphere = add_sphere(scene)
    scene.add_instances("floor", add_plane(scene), place(), [floor])
    for x, material in [(-2.2, metal), (0.0, chalk), (2.2, satin)]:
        scene.add_instances("ball", sphere, place(x, 0, 1), [material])
    scene.add_light("sphere", pivot_core.SphereLight((2.0, -2.0, 4.5), 1.5, (25, 25, 25)))
    scene.add_light("spot", pivot_core.SpotLight((-3, -4, 4), 1.2, (30, 10, 10), (0.5, 0.6, -0.62449980), 0.9, 0.5))
    scene.add_light("sun", pivot_core.SunLight((0.6, 0.0, 0.8), 0.4, (0.5, 0.5, 0.6)))
    scene.add_light("area", pivot_core.AreaLight((0, 3, 3), (1.5, 0, 0), (0, -0.5, -0.5), (4, 4, 4)))
    set_camera(scene, (0, -9, 3.5), (0, 0, 0.8), (64, 36), 0.45)
    return scene


@pytest.fixture(scope="module")
def by_strategy() -> dict[str, tuple[np.ndarray, np.ndarray]]:
    """Direct light: mean and variance of the mean of each pixel, per strategy, from independent seeds."""
    scene = still_life()
    scene.set_world((0.1, 0.1, 0.12))
    result = {}
    for index, strategy in enumerate(STRATEGIES):
        seeds = range(100 * index, 100 * index + 24)
        runs = [
            render(scene, samples=128, seed=seed, max_bounces=0, light_sampling=strategy)[..., :3].mean(-1)
            for seed in seeds
        ]
        result[strategy] = np.mean(runs, 0), np.var(runs, 0, ddof=1) / len(runs)
    return result


@pytest.mark.parametrize("strategy", [s for s in STRATEGIES if s != "MIS"])
def test_strategies_converge_to_one_image(strategy: str, by_strategy: dict) -> None:
    """Per-pixel z-test against MIS: z is near a standard normal if both are unbiased."""
    mean, variance = by_strategy[strategy]
    reference, reference_variance = by_strategy["MIS"]
    z = (mean - reference) / np.sqrt(variance + reference_variance + 1e-12)
    # Student's t with about 20 degrees of freedom has a variance of 1.1; a heavy tail of rare paths widens it a little.
    assert abs(z.mean()) < 0.1
    assert z.std() < 1.35
    assert abs(mean.mean() / reference.mean() - 1.0) < 4e-3


@pytest.mark.parametrize("strategy", [s for s in STRATEGIES if s != "MIS"])
def test_strategies_agree_on_indirect_light(strategy: str) -> None:
    """Later vertices sample one light of four: the picture's mean must not notice."""
    scene = still_life()
    means = {}
    for seed, name in enumerate((strategy, "MIS")):
        direct, all_light = (
            render(scene, samples=256, seed=seed, max_bounces=bounces, light_sampling=name)[..., :3].mean()
            for bounces in (0, 2)
        )
        means[name] = all_light - direct
    assert abs(means[strategy] / means["MIS"] - 1.0) < 0.02


def test_same_seed_same_image_on_any_number_of_threads() -> None:
    scene = still_life()
    for integrator in ("MONTE_CARLO", "ANALYTIC"):
        images = [render(scene, integrator=integrator, samples=4, threads=threads) for threads in (1, 2, 3)]
        np.testing.assert_array_equal(images[0], images[1])
        np.testing.assert_array_equal(images[0], images[2])
    other = render(scene, samples=4, seed=1)
    assert not np.array_equal(other, render(scene, samples=4, seed=0))
    analytic = [render(scene, integrator="ANALYTIC", samples=4, seed=seed) for seed in (0, 1)]
    np.testing.assert_array_equal(analytic[0], analytic[1])


def test_two_renders_live_in_one_process() -> None:
    sessions = [pivot_core.Session(still_life(), pivot_core.RenderSettings(samples=4)) for _ in range(2)]
    for session in sessions:
        session.start()
    while not all(session.wait(1.0) for session in sessions):
        pass
    np.testing.assert_array_equal(sessions[0].read("Combined"), sessions[1].read("Combined"))


@pytest.mark.parametrize("pixel_filter", [{"pixel_filter": "BOX", "filter_width_px": 1.0}, {"filter_width_px": 3.0}])
def test_adaptive_sampling_is_unbiased(by_strategy: dict, pixel_filter: dict) -> None:
    """Its mean over seeds is that of the same picture with as many samples in each pixel."""
    scene = still_life()
    scene.set_world((0.1, 0.1, 0.12))

    def pictures(seeds: range, **settings: object) -> tuple[np.ndarray, np.ndarray]:
        runs = [render(scene, seed=seed, **pixel_filter, **settings)[..., :3].mean(-1) for seed in seeds]
        return np.mean(runs, 0), np.var(runs, 0, ddof=1) / len(runs)

    settings = {"samples": 128, "max_bounces": 0}
    mean, variance = pictures(range(900, 916), adaptive=True, error_budget_percent=2.0, **settings)
    reference, reference_variance = pictures(range(500, 516), **settings)
    z = (mean - reference) / np.sqrt(variance + reference_variance + 1e-12)
    assert abs(z.mean()) < 0.1
    assert z.std() < 1.35


def test_adaptive_sampling_puts_samples_where_they_lower_the_error_most() -> None:
    """For one error of a picture that is noisy almost everywhere it takes three quarters of the samples."""
    scene = still_life()
    set_camera(scene, (0, -9, 3.5), (0, 0, 0.8), (128, 72), 0.45)
    converged = render(scene, samples=2048, max_bounces=0, filter_width_px=3.0)[..., :3]

    def relative_error(**settings: object) -> tuple[float, float]:
        session = pivot_core.Session(scene, pivot_core.RenderSettings(max_bounces=0, filter_width_px=3.0, **settings))
        session.start()
        while not session.wait(1.0):
            pass
        error = (session.read("Combined")[..., :3] - converged) ** 2 / (converged**2 + 0.01)
        return float(error.mean()), session.pixel_samples / (session.width * session.height)

    adaptive, samples = relative_error(samples=1024, adaptive=True, error_budget_percent=1.0)
    even, _ = relative_error(samples=round(1.33 * samples))
    assert adaptive < even
    assert adaptive < 0.01**2


def test_an_easy_budget_is_met_by_the_pilot() -> None:
    session = pivot_core.Session(
        still_life(), pivot_core.RenderSettings(samples=512, adaptive=True, error_budget_percent=1000.0)
    )
    session.start()
    assert session.wait(60.0)
    squares = (session.width + 2) * (session.height + 2)  # with those whose samples reach the picture
    assert session.pixel_samples == 16 * squares


@pytest.mark.parametrize("samples", [1, 15, 16])
def test_few_samples_are_even(samples: int) -> None:
    """What a pilot would take."""
    pictures = [render(still_life(), samples=samples, adaptive=adaptive) for adaptive in (False, True)]
    np.testing.assert_array_equal(*pictures)


def lamps_in_a_grid(count: int) -> pivot_core.Scene:
    """A glossy floor under count * count lamps of many sizes, a spot and a sun."""
    scene = pivot_core.Scene()
    gloss = scene.add_material(
        "gloss",
        pivot_core.Material(diffuse=(0.2, 0.2, 0.2), alpha=0.1, conductor_f0=(0.5,) * 3, conductor_f90=(1,) * 3),
    )
    scene.add_instances("floor", add_plane(scene), place(), [gloss])
    scene.add_instances("ball", add_sphere(scene), place(0, 0, 1), [gloss])
    for x in range(count):
        for y in range(count):
            radius, power = 0.1 + 0.1 * ((3 * x + y) % 4), 1.0 + (x * y) % 5
            place_m = (2.0 * x - count + 1, 2.0 * y - count + 1, 4.0 + 0.1 * x)
            scene.add_light("lamp", pivot_core.SphereLight(place_m, radius, (power,) * 3))
    scene.add_light("spot", pivot_core.SpotLight((-3, -4, 4), 0.3, (30, 10, 10), (0.5, 0.6, -0.62449980), 0.9, 0.5))
    scene.add_light("sun", pivot_core.SunLight((0.6, 0.0, 0.8), 0.1, (0.5, 0.5, 0.6)))
    set_camera(scene, (0, -9, 3.5), (0, 0, 0.8), (32, 18), 0.45)
    return scene


@pytest.mark.parametrize("strategy", ["JOINT", "MIS"])
def test_chosen_lights_converge_to_the_sum_of_single_lights(strategy: str) -> None:
    """Eleven lights are chosen among; each alone, nothing is chosen."""
    scene = lamps_in_a_grid(3)
    seeds = range(24)
    runs = [render(scene, samples=64, seed=s, max_bounces=0, light_sampling=strategy)[..., :3].mean(-1) for s in seeds]
    lights = range(11)
    singles = []
    for seed in range(100, 112):
        total = np.zeros_like(runs[0])
        for kept in lights:
            alone = lamps_in_a_grid(3)
            for light in lights:
                if light != kept:
                    alone.remove_light(light)
            total += render(alone, samples=16, seed=seed, max_bounces=0)[..., :3].mean(-1)
        singles.append(total)
    difference = np.mean(runs, 0) - np.mean(singles, 0)
    z = difference / np.sqrt(np.var(runs, 0, ddof=1) / len(runs) + np.var(singles, 0, ddof=1) / len(singles) + 1e-12)
    assert abs(difference.mean() / np.mean(singles)) < 3e-3
    assert abs(z.mean()) < 0.15
    assert np.median(np.abs(z)) < 0.95  # of a standard normal: 0.67
