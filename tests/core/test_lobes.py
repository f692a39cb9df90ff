"""Every kind of lobe that the core lists, on whatever a material may give it: its samples follow its density, its
albedo is the integral of what it scatters, and pictures of it are one by every light sampling and by quadrature. A kind
that is added is tested by being in the list."""

from __future__ import annotations

import functools
import itertools
import re
from collections.abc import Callable

import numpy as np
import pivot_core
import pytest
from light_cells import Array
from scenes import add_plane, place, render, set_camera
from scipy.stats import chi2, ttest_ind

from tests.core.chi_squared import expected_share, frame_around

KINDS = list(pivot_core.LOBES)
VIEWS_RAD = (0.3, 1.0, 1.4)
SIGNIFICANCE = 1e-4
COUNT = 40_000
NORMAL = np.array([0.0, 0.0, 1.0])
RINGS, AZIMUTHS = np.linspace(0, 2, 65), 64


def direction(theta: float, phi: float = 0.4) -> tuple[float, float, float]:
    return (np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi), np.cos(theta))


def random_lobe(kind: str, seed: int) -> tuple[str, dict[str, object]]:
    """A lobe with parameters from most of their ranges, those without an end up to one more than the least; none from
    the lowest tenth, where lobes may be finer than the cells that count them. Light that goes beneath a surface comes
    out where it entered: what walks there is no lobe."""
    random = np.random.default_rng(seed)
    values: dict[str, object] = {}
    for name, (count, low, high) in pivot_core.LOBES[kind].items():
        drawn = low + (min(high, low + 1) - low) * random.uniform(0.1, 1, count)
        values[name] = tuple(drawn) if count > 1 else float(drawn[0])
    if "normal" in values:
        values["normal"] = direction(random.uniform(0, 0.2), random.uniform(0, 2 * np.pi))
    if kind == "thin_film":  # Principled's, whose microfacets are GGX's
        values["beckmann"] = 0.0
    if "radius_m" in values:
        values["radius_m"] = (0.0, 0.0, 0.0)
    if kind in pivot_core.LOBES_WITH_NDF:
        values["ndf"] = two_yarns(*random.uniform((0.1, 0.2, 0.1), (0.2, 0.4, 0.5)))
    return kind, values


def with_closed_form(lobe: tuple[str, dict[str, object]]) -> tuple[str, dict[str, object]]:
    """What of a lobe the analytic integrator shows: of a dielectric what GGX mirrors outside, without a film."""
    kind, values = lobe
    shown = {"transmission": (0, 0, 0), "ior": 1.5, "film_nm": 0.0, "beckmann": 0.0}
    return (kind, values | shown) if kind == "dielectric" else lobe


@functools.cache
def two_yarns(alpha: float, alpha_along: float, tilt: float) -> pivot_core.TabulatedNdf:
    """Two lobes that lean to either side."""
    edges = (np.arange(64) + 0.5) / 32 - 1
    x, y = np.meshgrid(edges, edges)
    z = np.sqrt(np.maximum(1 - x * x - y * y, 1e-9))
    lobes = [
        z**-4.0 / (1 + ((x / z - shift) / alpha) ** 2 + (y / z / alpha_along) ** 2) ** 2 for shift in (-tilt, tilt)
    ]
    return pivot_core.TabulatedNdf(np.where(x * x + y * y < 1, lobes[0] + 0.5 * lobes[1], 0))


def materials(
    make_lobe: Callable[[str, int], tuple[str, dict[str, object]]] = random_lobe,
) -> dict[str, pivot_core.Material]:
    """Each kind alone, more of it at once, and as many of them as there may be beside a base."""
    made = {}
    for kind in KINDS:
        for seed in range(3):
            made[f"{kind} {seed}"] = pivot_core.Material(lobes=[make_lobe(kind, seed)])
        made[f"{kind} twice"] = pivot_core.Material(lobes=[make_lobe(kind, 5), make_lobe(kind, 6)])
    every = [make_lobe(kind, 7) for kind in KINDS[: pivot_core.MAX_LOBES]]
    made["all beside a base"] = pivot_core.Material(
        diffuse=(0.3, 0.2, 0.1), alpha=0.3, dielectric_weight=1, lobes=every
    )
    return made


MATERIALS = materials()
WITH_CLOSED_FORMS = materials(lambda kind, seed: with_closed_form(random_lobe(kind, seed)))
CASES = list(itertools.product(MATERIALS, VIEWS_RAD))


def evaluate(material: pivot_core.Material, wo: tuple[float, float, float], wi: Array) -> tuple[Array, Array]:
    """BSDF times |cos| (n, 3) and density (n,)."""
    value, pdf = material.evaluate(wo, wi.reshape(-1, 3).astype(np.float32))
    return value.astype(float).reshape(wi.shape), pdf.astype(float)[:, 0].reshape(wi.shape[:-1])


def cells_of(wi: Array) -> Array:
    """How many directions lie in each cell: rings about the normal, of which one edge is the horizon, by azimuths."""
    local = wi @ frame_around(NORMAL)
    phi = np.arctan2(local[:, 1], local[:, 0]) % (2 * np.pi)
    return np.histogram2d(1 - local[:, 2], phi, (RINGS, np.linspace(0, 2 * np.pi, AZIMUTHS + 1)))[0].ravel()


def integral(of: Callable[[Array], Array]) -> Array:
    """Over each of these cells, by Gauss-Legendre points in the solid angle."""
    return expected_share(of, NORMAL, RINGS, AZIMUTHS).ravel()


@pytest.mark.parametrize(("name", "theta"), CASES)
def test_samples_follow_their_density(name: str, theta: float) -> None:
    """Pearson's chi^2; samples where the density is 0, below the surface of a lobe that reflects, count as one cell."""
    wo, material = direction(theta), MATERIALS[name]
    wi = material.sample(wo, np.random.default_rng(1).random((COUNT, 3), np.float32)).astype(float)
    has_density = evaluate(material, wo, wi)[1] > 0
    assert np.all(wi[~has_density][:, 2] < 1e-6)
    np.testing.assert_allclose(np.linalg.norm(wi[has_density], axis=-1), 1, rtol=1e-5)
    share = integral(lambda omega: evaluate(material, wo, omega)[1])
    assert 0.5 < share.sum() < 1.001
    expected = COUNT * np.append(share, max(1 - share.sum(), 0))
    observed = np.append(cells_of(wi[has_density]), (~has_density).sum())
    rare = expected < 5
    expected, observed = (np.append(a[~rare], a[rare].sum()) for a in (expected, observed))
    if expected[-1] < 1 and observed[-1] < 3:
        expected, observed = expected[:-1], observed[:-1]
    statistic = ((observed - expected) ** 2 / expected).sum()
    assert chi2.sf(statistic, len(expected) - 1) > SIGNIFICANCE


@pytest.mark.parametrize(("name", "theta"), CASES)
def test_albedo_is_the_integral_of_the_lobes(name: str, theta: float) -> None:
    """Which is what a furnace of radiance 1 shows; about, for Fresnel is that of one angle. Less than a millionth is
    never chosen."""
    wo, material = direction(theta), MATERIALS[name]
    scattered = [integral(lambda omega, c=c: evaluate(material, wo, omega)[0][..., c]).sum() for c in range(3)]
    np.testing.assert_allclose(np.mean(material.albedo(wo)), np.mean(scattered), rtol=0.1, atol=1e-6)


def on_floor(material: pivot_core.Material, lit_from: str) -> pivot_core.Scene:
    """A sheet of the material seen from above, with a light of each shape, above it or below, and a world."""
    scene = pivot_core.Scene()
    scene.add_instances("sheet", add_plane(scene, 50.0), place(), [scene.add_material("sheet", material)])
    side = 1.0 if lit_from == "above" else -1.0
    scene.add_light("sphere", pivot_core.SphereLight((0.5, 0.8, side * 1.5), 0.7, (3, 3, 3)))
    scene.add_light("area", pivot_core.AreaLight((-1, 1.2, side * 1.2), (0.8, 0, 0), (0, -0.8 * side, 0), (1, 2, 1)))
    scene.add_light("sun", pivot_core.SunLight((0, 0.6, side * 0.8), 0.3, (0.5, 0.5, 0.5)))
    scene.set_world((0.1, 0.1, 0.1))
    set_camera(scene, (0, -2, 1.5), size=(8, 8))
    return scene


MODES = ("JOINT", "SPTD", "MIS", "LIGHT")  # each against BSDF
PICTURES = list(itertools.product([name for name in MATERIALS if not name.endswith(("1", "2"))], ("above", "below")))
# Lamps behind a strand are no light to it, but samples of the BSDF find them: see strand.h.
LIKE_OTHER_LIGHT = [case for case in PICTURES if not (case[0].startswith("strand") and case[1] == "below")]
SEEDS = 8


@functools.cache
def energies(name: str, lit_from: str, mode: str) -> Array:
    """Means of small pictures over seeds, (SEEDS,)."""
    first = 1000 * ("BSDF", *MODES).index(mode)
    scene = on_floor(MATERIALS[name], lit_from)
    return np.array(
        [
            render(scene, light_sampling=mode, samples=64, max_bounces=0, seed=first + s)[..., :3].mean()
            for s in range(SEEDS)
        ]
    )


@pytest.mark.parametrize("mode", MODES)
@pytest.mark.parametrize(("name", "lit_from"), [case for case in PICTURES if not case[0].startswith("strand")])
def test_light_samplings_have_one_energy(name: str, lit_from: str, mode: str) -> None:
    """The generic product of any lobe with any light, above the surface and through it. Not of strands: as in Cycles
    samples of the BSDF find light where lamps give them none."""
    ours, alone = energies(name, lit_from, mode), energies(name, lit_from, "BSDF")
    if abs(ours.mean() / alone.mean() - 1) < 1e-4:
        return
    pvalue = ttest_ind(ours, alone, equal_var=False).pvalue
    assert pvalue > SIGNIFICANCE, (
        f"{mode} {ours.mean():.5g} +- {ours.std():.1g}, BSDF {alone.mean():.5g}, p {pvalue:.2g}"
    )


@pytest.mark.parametrize(("name", "lit_from"), LIKE_OTHER_LIGHT)
def test_pictures_are_the_integral_of_the_lobes(name: str, lit_from: str) -> None:
    """Under a sun that covers a cap, of each pixel's view: by quadrature."""
    material = MATERIALS[name]
    scene = pivot_core.Scene()
    scene.add_instances("sheet", add_plane(scene, 50.0), place(), [scene.add_material("sheet", material)])
    axis = np.array([0.0, 0.6, 0.8 if lit_from == "above" else -0.8])
    half_angle = 0.3
    scene.add_light("sun", pivot_core.SunLight(tuple(axis), half_angle, (1, 1, 1)))
    set_camera(scene, (0, -2, 1.5), size=(1, 1), half_width=1e-3)
    seen = render(scene, samples=4096, max_bounces=0)[0, 0, :3]
    wo = (0.0, -0.8, 0.6)
    radiance = 1 / (np.pi * np.sin(half_angle) ** 2)
    edges = np.linspace(0, 1 - np.cos(half_angle), 9)
    expected = [
        radiance * expected_share(lambda omega, c=c: evaluate(material, wo, omega)[0][..., c], axis, edges, 16).sum()
        for c in range(3)
    ]
    np.testing.assert_allclose(seen, expected, rtol=0.02, atol=1e-6)


def test_light_below_does_not_leak_through_what_only_reflects() -> None:
    for name, material in MATERIALS.items():
        if name.startswith("strand"):
            continue
        wi = np.array([[0.6, 0.0, -0.8], [0.0, 0.0, -1.0]])
        comes_through = evaluate(material, direction(0.5), wi)[0].max() > 0
        scene = on_floor(material, "below")
        scene.set_world((0, 0, 0))
        seen = render(scene, samples=4, max_bounces=0)[..., :3]
        assert (seen.max() > 0) == comes_through, name


def test_every_light_that_comes_through_can_be_chosen() -> None:
    """More lamps than a vertex samples, all behind a sheet."""
    scene = pivot_core.Scene()
    for i in range(20):
        scene.add_light("lamp", pivot_core.SphereLight((i - 10, 3, -1 - i % 3), 0.1, (1, 1, 1)))
    set_camera(scene, (0, -2, 1.5))
    sheet = pivot_core.Material(lobes=[("translucent", {})])
    assert scene.choice_probabilities(sheet, (0, 0, 0), (0, 0, 1)).min() > 0
    assert scene.choice_probabilities(pivot_core.Material(diffuse=(1, 1, 1)), (0, 0, 0), (0, 0, 1)).max() == 0


def test_a_translucent_sheet_is_a_white_one_seen_from_behind() -> None:
    """Lit from below it shows what a diffuse sheet shows lit from above; each the other way round shows nothing."""
    color = (0.8, 0.5, 0.2)
    through, white = pivot_core.Material(lobes=[("translucent", {"color": color})]), pivot_core.Material(diffuse=color)
    picture = {
        (name, side): render(on_floor(material, side), samples=256, max_bounces=0)[..., :3].mean((0, 1))
        for name, material in (("through", through), ("white", white))
        for side in ("above", "below")
    }
    np.testing.assert_allclose(picture["through", "below"], picture["white", "above"], rtol=0.02)


@pytest.mark.parametrize("kind", ["oren_nayar", "disney_diffuse", "velvet"])
def test_diffuse_lobes_are_reciprocal(kind: str) -> None:
    """The BRDF is one from either end: not of sheen, a fit with the cosine in it."""
    material = pivot_core.Material(lobes=[random_lobe(kind, 3)])
    for theta, theta_i in itertools.combinations(VIEWS_RAD, 2):
        ends = direction(theta, 0.4), direction(theta_i, 1.9)
        there, back = (evaluate(material, a, np.array([b]))[0] / b[2] for a, b in (ends, ends[::-1]))
        np.testing.assert_allclose(there, back, rtol=1e-4)


@pytest.mark.parametrize("roughness", [0.3, 1.0])
def test_a_rough_white_surface_keeps_all_light(roughness: float) -> None:
    material = pivot_core.Material(lobes=[("oren_nayar", {"roughness": roughness})])
    for theta in VIEWS_RAD:
        wo = direction(theta)
        np.testing.assert_allclose(material.albedo(wo), 1, rtol=1e-5)
        assert integral(lambda omega, wo=wo: evaluate(material, wo, omega)[0][..., 0]).sum() == pytest.approx(
            1, rel=1e-3
        )


def test_a_base_in_shares_is_the_whole() -> None:
    """Halves of one material, the second a further lobe, are that material."""
    whole = {"diffuse": (0.4, 0.2, 0.6), "alpha": 0.2, "dielectric_weight": 1.0}
    half = {"diffuse": (0.2, 0.1, 0.3), "alpha": 0.2, "dielectric_weight": 0.5, "weight": 0.5}
    one, two = pivot_core.Material(**whole), pivot_core.Material(**half, lobes=[("base", half)])
    wi = pivot_core.Material(diffuse=(1, 1, 1)).sample((0, 0, 1), np.random.default_rng(1).random((100, 3), np.float32))
    for theta in VIEWS_RAD:
        values = [m.evaluate(direction(theta), wi)[0] for m in (one, two)]
        np.testing.assert_allclose(values[1], values[0], rtol=1e-5)


@pytest.mark.parametrize(
    ("lobes", "said"),
    [
        ([("felt", {})], f"lobe 'felt': there is no such kind; there are {', '.join(KINDS)}"),
        ([("translucent", {"colour": (1, 1, 1)})], "lobe 'translucent': its parameters are color"),
        ([("translucent", {"color": 1.0})], "lobe 'translucent': color must be three numbers"),
        ([("base", {"alpha": 2.0})], "lobe 'base': alpha must be finite and in .0"),
        ([("base", {"dielectric_ior": float("nan")})], "lobe 'base': dielectric_ior must be finite and at least 1"),
        ([("tabulated", {})], "lobe 'tabulated': ndf must be a TabulatedNdf"),
        ([("tabulated", {"ndf": 1.0})], "lobe 'tabulated': ndf must be a TabulatedNdf"),
        ([("translucent", {})] * 4, "a material has at most 3 lobes beside its base"),
    ],
)
def test_bad_lobes_are_named(lobes: list[tuple[str, dict[str, object]]], said: str) -> None:
    with pytest.raises(ValueError, match=re.escape(said) if "in .0" not in said else said):
        pivot_core.Material(lobes=lobes)


@pytest.mark.parametrize(("name", "lit_from"), LIKE_OTHER_LIGHT)
def test_the_analytic_integrator_knows_every_lobe(name: str, lit_from: str) -> None:
    """Its picture is Monte Carlo's within the error that it predicts and what Monte Carlo leaves; the world apart.
    Upright fibres send next to nothing here: a millionth of the lights' radiance is not seen."""
    scene = on_floor(WITH_CLOSED_FORMS[name], lit_from)
    scene.set_world((0, 0, 0))
    session = pivot_core.Session(
        scene, pivot_core.RenderSettings(integrator="ANALYTIC", samples=16, error_budget_percent=1.0)
    )
    session.start()
    while not session.wait(10.0):
        pass
    ours = session.read("Combined")[..., :3].astype(float).mean(-1)
    error = session.read("Error")[..., 0] * ours
    samples = 4096 if name.startswith("velvet") else 1024  # few of which find upright fibres
    random = render(scene, samples=samples, max_bounces=0)[..., :3].astype(float).mean(-1)
    assert np.abs(ours.mean() - random.mean()) <= error.mean() + 0.005 * random.mean() + 1e-6
    np.testing.assert_allclose(ours, random, atol=(3 * error + 0.05 * random.mean()).max() + 1e-6)
