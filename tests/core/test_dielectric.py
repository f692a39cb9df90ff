"""The dielectric lobe: bends light as it should, loses none, is the same both ways but for the index of refraction, and
knows which side of a surface is seen. That samples follow its density is test_lobes.py's."""

from __future__ import annotations

import itertools

import numpy as np
import numpy.typing as npt
import pivot_core
import pivot_core.tables as tables
import pytest
from scenes import add_plane, add_sphere, place, render, set_camera

ALPHAS = (0.001, 0.01, 0.1, 0.3, 0.6, 1.0)
IORS = (1.33, 1.5, 2.4, 1 / 1.33, 1 / 1.5, 1 / 2.4)
VIEWS_RAD = (0.0, 0.5, 1.0, 1.4)
COUNT = 100_000
SMOOTH = 0.0

Array = npt.NDArray[np.float64]


def dielectric(**values: object) -> pivot_core.Material:
    return pivot_core.Material(lobes=[("dielectric", values)])


def direction(theta: float, phi: float = 0.3) -> tuple[float, float, float]:
    return (np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi), np.cos(theta))


def numbers(count: int = COUNT) -> npt.NDArray[np.float32]:
    """(count, 3), evenly spread in [0, 1)."""
    ratios = np.array([0.8191725134, 0.6710436067, 0.5497004779])  # R3's
    return ((0.5 + np.arange(1, count + 1)[:, None] * ratios) % 1).astype(np.float32) * np.float32(1 - 2**-24)


def evaluate(material: pivot_core.Material, wo: tuple[float, float, float], wi: Array) -> tuple[Array, Array]:
    """BSDF times |cos| (n, 3), density (n,)."""
    value, pdf = material.evaluate(wo, wi.astype(np.float32))
    return value.astype(float), pdf.astype(float)[:, 0]


def worth(material: pivot_core.Material, theta: float) -> tuple[Array, Array]:
    """Directions (n, 3) of samples, and what each brings of a white furnace (n, 3)."""
    wo = direction(theta)
    wi = material.sample(wo, numbers()).astype(float)
    value, pdf = evaluate(material, wo, wi)
    for numbers_of in (value, pdf, wi):
        assert np.isfinite(numbers_of).all()
    return wi, np.where(pdf[:, None] > 0, value / np.maximum(pdf, 1e-30)[:, None], 0)


@pytest.mark.parametrize(("alpha", "ior"), list(itertools.product(ALPHAS, IORS)))
def test_a_white_one_loses_nothing(alpha: float, ior: float) -> None:
    for theta in VIEWS_RAD:
        brought = worth(dielectric(alpha=alpha, ior=ior, multiscatter=1.0), theta)[1].mean()
        assert brought == pytest.approx(1, abs=0.01), theta


@pytest.mark.parametrize(("alpha", "ior"), list(itertools.product(ALPHAS, IORS)))
def test_the_table_is_the_albedo_by_side(alpha: float, ior: float) -> None:
    for theta in VIEWS_RAD:
        wi, brought = worth(dielectric(alpha=alpha, ior=ior), theta)
        stands = tables.ggx_glass_albedo(max(alpha, 1e-3), np.cos(theta), ior)
        found = [brought[is_of_side].sum() / brought.size for is_of_side in (wi[:, 2] > 0, wi[:, 2] < 0)]
        assert sum(stands) == pytest.approx(sum(found), abs=6e-3)
        # Between nodes the angle past which all is reflected is blurred.
        np.testing.assert_allclose(stands, found, atol=6e-3 if ior > 1 else 0.1)


@pytest.mark.parametrize("ior", IORS)
def test_light_through_a_smooth_one_bends_by_snell(ior: float) -> None:
    """And its shares are Fresnel's."""
    for theta in VIEWS_RAD[1:]:
        wi, brought = worth(dielectric(alpha=SMOOTH, ior=ior), theta)
        comes_through = wi[:, 2] < 0
        s = np.sin(theta) / ior
        if s >= 1:
            assert not comes_through.any() or brought[comes_through].sum() / brought.size < 1e-3
            continue
        c_o, c_i = np.cos(theta), np.sqrt(1 - s * s)
        parallel, across = (c_o * ior - c_i) / (c_o * ior + c_i), (c_o - ior * c_i) / (c_o + ior * c_i)
        reflected = (parallel**2 + across**2) / 2
        assert brought[~comes_through].sum() / brought.size == pytest.approx(reflected, abs=2e-3)
        np.testing.assert_allclose(
            np.median(wi[comes_through], 0), [-s * np.cos(0.3), -s * np.sin(0.3), -c_i], atol=2e-3
        )


@pytest.mark.parametrize(("alpha", "ior"), list(itertools.product((0.1, 0.4, 1.0), (1.2, 1.5, 2.4))))
def test_it_is_the_same_both_ways(alpha: float, ior: float) -> None:
    """f(wo, wi) = ior^2 f(wi, wo), ior that of wi's side over wo's; what is mirrored as it is."""
    outside, inside = dielectric(alpha=alpha, ior=ior), dielectric(alpha=alpha, ior=1 / ior)
    for theta_o, theta_i, phi in itertools.product((0.1, 0.7, 1.3), (0.2, 0.8, 1.2), (0.0, 2.0, 3.1)):
        wo, wi = direction(theta_o, 0.0), direction(theta_i, phi)
        through = (wi[0], wi[1], -wi[2])
        there = evaluate(outside, wo, np.array([through]))[0][0] / wi[2]
        # The other way round in a frame turned over, about x.
        back = evaluate(inside, (wi[0], -wi[1], wi[2]), np.array([(wo[0], -wo[1], -wo[2])]))[0][0] / wo[2]
        np.testing.assert_allclose(there, ior**2 * back, rtol=2e-4, atol=1e-6)
        mirrored = [evaluate(outside, a, np.array([b]))[0][0] / b[2] for a, b in ((wo, wi), (wi, wo))]
        np.testing.assert_allclose(*mirrored, rtol=2e-4, atol=1e-6)


def test_colours_scale_what_they_name() -> None:
    red, blue = (0.9, 0.2, 0.1), (0.1, 0.3, 0.8)
    wi, brought = worth(dielectric(alpha=0.1, reflection=red, transmission=blue), 0.6)
    white = worth(dielectric(alpha=0.1), 0.6)
    for is_of_side, color in ((lambda w: w[:, 2] > 0, red), (lambda w: w[:, 2] < 0, blue)):
        whole = white[1][is_of_side(white[0])].sum(0)
        np.testing.assert_allclose(brought[is_of_side(wi)].sum(0) / whole, color, rtol=0.02)


@pytest.mark.parametrize("ior", [1.5, 1 / 1.5])
def test_without_fresnel_all_that_can_comes_through(ior: float) -> None:
    """As of Blender's Refraction BSDF: nothing is reflected, and what would be past the angle is black."""
    for theta in VIEWS_RAD:
        wi, brought = worth(dielectric(alpha=SMOOTH, ior=ior, fresnel=0.0, reflection=(0, 0, 0)), theta)
        assert not (wi[:, 2] > 1e-6).any()
        assert brought.mean() == pytest.approx(float(np.sin(theta) < ior), abs=5e-3)


@pytest.mark.parametrize("ior", [1e-5, 0.3, 1.0, 1 + 1e-6, 1.0001, 50.0, 1e30])
@pytest.mark.parametrize("alpha", [0.0, 0.03, 1.0])
def test_extremes_have_values(ior: float, alpha: float) -> None:
    """A view along the surface, and media of almost one index, which light crosses straight on."""
    material = dielectric(alpha=alpha, ior=ior, multiscatter=1.0)
    for theta in (0.0, 1.0, np.pi / 2 - 1e-3, np.pi / 2 - 1e-6):
        wi, brought = worth(material, theta)
        assert 0.8 < brought.mean() < 1.2 or theta > 1.5 or ior > 100 or ior < 0.01
        assert np.isfinite(material.albedo(direction(theta))).all()
    if abs(ior - 1) < 1e-3 and alpha == 0:
        wi, brought = worth(material, 0.7)
        np.testing.assert_allclose(np.average(wi, 0, brought[:, 0]), -np.array(direction(0.7)), atol=1e-3)


def ball(material: pivot_core.Material) -> pivot_core.Scene:
    scene = pivot_core.Scene()
    scene.add_instances("ball", add_sphere(scene), place(), [scene.add_material("ball", material)])
    scene.set_world((1, 1, 1))
    set_camera(scene, (0, -4, 0), size=(16, 16), half_width=0.22)
    return scene


@pytest.mark.parametrize(
    ("alpha", "ior"),
    [(0.0, 1.0), (0.0, 1.5), (0.0, 2.4), (0.04, 1.33), (0.04, 1.5), (0.25, 1.5), (0.25, 1.0), (1.0, 1.33), (1.0, 1.5)],
)
def test_a_white_ball_in_a_white_furnace_is_not_seen(alpha: float, ior: float) -> None:
    """Its inside is seen from behind, where light meets the other side of the same boundary."""
    seen = render(ball(dielectric(alpha=alpha, ior=ior, multiscatter=1.0)), samples=1024, max_bounces=100)[..., :3]
    assert seen.mean() == pytest.approx(1, abs=0.01)


def test_a_ball_shows_what_is_behind_upside_down() -> None:
    """A ball lens: red above, blue below, seen through the middle of smooth glass; through air it stays."""
    for ior, turned in ((1.5, True), (1.0001, False)):
        scene = ball(dielectric(ior=ior))
        scene.set_world((0, 0, 0))
        for name, color, z in (("red", (1, 0, 0), 10), ("blue", (0, 0, 1), -10)):
            material = scene.add_material(name, pivot_core.Material(emission=color))
            matrix = place(0, 10, z)
            matrix[0, :3, :3] = [[1, 0, 0], [0, 0, 1], [0, 1, 0]]
            scene.add_instances(name, add_plane(scene, 10.0), matrix, [material])
        seen = render(scene, samples=16, max_bounces=8)[..., :3]
        upper, lower = seen[9:12, 6:10].mean((0, 1)), seen[4:7, 6:10].mean((0, 1))
        top, bottom = (lower, upper) if turned else (upper, lower)
        assert top[0] > 0.7 > 0.1 > top[2], (ior, top)
        assert bottom[2] > 0.7 > 0.1 > bottom[0], (ior, bottom)


def test_the_back_of_a_sheet_is_the_inside() -> None:
    """A sheet seen from behind is one of the inverse index seen from the front."""
    for ior in (1.5, 2.0):
        pictures = []
        for value, side in ((ior, -1.0), (1 / ior, 1.0)):
            scene = pivot_core.Scene()
            material = scene.add_material("sheet", dielectric(alpha=0.3, ior=value))
            scene.add_instances("sheet", add_plane(scene, 50.0), place(), [material])
            scene.add_light("above", pivot_core.SphereLight((0.5, 1.0, side * 2), 0.5, (9, 9, 9)))
            scene.add_light("below", pivot_core.SphereLight((0.2, 0.8, -side * 2), 0.5, (3, 6, 9)))
            set_camera(scene, (0, -2, side * 1.5), size=(8, 8))
            pictures.append(render(scene, samples=2048, max_bounces=0)[..., :3].mean((0, 1)))
        np.testing.assert_allclose(*pictures, rtol=0.02)


GLOSSY_RAY, TRANSMISSION_RAY = 4, 8  # RayKind of core/shaders/place.h


@pytest.mark.parametrize(("kind", "side"), [(TRANSMISSION_RAY, -1.0), (GLOSSY_RAY, 0.0)])
def test_what_comes_through_meets_transmission_rays(kind: int, side: float) -> None:
    """Which alone see the one world; all of a dielectric's are glossy, which see the other."""
    program = pivot_core.Program()
    seen = program.add("ray_is", [], [kind])
    scene = pivot_core.Scene()
    material = dielectric(alpha=0.2)
    scene.add_instances("sheet", add_plane(scene, 50.0), place(), [scene.add_material("sheet", material)])
    scene.set_world_shader(
        pivot_core.Shader(pivot_core.Material(emission=(1, 1, 1)), program, {"emission": [seen] * 3})
    )
    set_camera(scene, (0, 0, 2), size=(4, 4), half_width=0.02)
    picture = render(scene, samples=1024, max_bounces=0, light_sampling="BSDF")[..., :3].mean()
    wi, brought = worth(material, 0.0)
    counts = wi[:, 2] < 0 if side else np.full(len(wi), True)
    assert picture == pytest.approx(brought[counts].sum() / brought.size, rel=0.01)


@pytest.mark.parametrize("lobe", [("translucent", {}), ("dielectric", {"alpha": 0.5})])
def test_a_sky_is_seen_through_a_sheet_by_every_sampling(lobe: tuple[str, dict[str, object]]) -> None:
    """One that varies, so that it is sampled beside the BSDF: also where it shines from behind."""
    program = pivot_core.Program()
    towards = program.add("position", [])
    below = program.add("math_multiply_add", [(towards + 2, 0.0), (-1, -3.0), (-1, 0.5)])
    sky = pivot_core.Shader(pivot_core.Material(emission=(1, 1, 1)), program, {"emission": [below] * 3})
    scene = pivot_core.Scene()
    material = scene.add_material("sheet", pivot_core.Material(lobes=[lobe]))
    scene.add_instances("sheet", add_plane(scene, 50.0), place(), [material])
    scene.set_world_shader(sky)
    set_camera(scene, (0, -1, 2), size=(4, 4), half_width=0.02)
    means = [
        render(scene, samples=4096, max_bounces=0, light_sampling=mode)[..., :3].mean()
        for mode in ("BSDF", "JOINT", "LIGHT")
    ]
    np.testing.assert_allclose(means, means[0], rtol=0.02)
