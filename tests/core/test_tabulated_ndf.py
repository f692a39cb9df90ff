"""The lobe whose microfacets are a picture: beside GGX where that is drawn, and where it is as sharp as can be.
test_lobes.py has what all lobes have: samples by their density, albedo, one picture by every light sampling."""

from __future__ import annotations

import flip_evaluator
import numpy as np
import pivot_core
import pytest
from ndf_pictures import Array, draw, ggx, sharp
from scenes import add_plane, add_sphere, look_at, place, render, set_camera

METAL = {"conductor_f0": (0.9, 0.8, 0.6), "conductor_f90": (1.0, 1.0, 1.0)}
WHITE = {"conductor_f0": (1.0, 1.0, 1.0), "conductor_f90": (1.0, 1.0, 1.0), "multiscatter": True}


def of_picture(picture: Array, **base: object) -> pivot_core.Material:
    return pivot_core.Material(lobes=[("tabulated", {"ndf": pivot_core.TabulatedNdf(picture), **base})])


def ball(material: pivot_core.Material, side_px: int = 64) -> pivot_core.Scene:
    scene = pivot_core.Scene()
    scene.add_instances("ball", add_sphere(scene), place(), [scene.add_material("metal", material)])
    scene.add_light("warm", pivot_core.SphereLight((2, -2, 3), 0.5, (20, 20, 20)))
    scene.add_light("cold", pivot_core.SphereLight((-3, -1, 1), 0.3, (10, 12, 20)))
    scene.add_light("panel", pivot_core.AreaLight((0, -2, 4), (0.5, 0, 0), (0, -0.5, 0.2), (4, 4, 4)))
    set_camera(scene, (0, -4, 1), size=(side_px, side_px), half_width=0.3)
    return scene


def analytic(scene: pivot_core.Scene) -> Array:
    return render(scene, integrator="ANALYTIC", samples=4)[..., :3].astype(float)


def monte_carlo(scene: pivot_core.Scene) -> Array:
    return render(scene, samples=64, max_bounces=0)[..., :3].astype(float)


def shown(image: Array) -> Array:
    """As a display shows it, sRGB."""
    x = np.clip(image, 0, 1)
    return np.where(x <= 0.0031308, 12.92 * x, 1.055 * np.maximum(x, 1e-9) ** (1 / 2.4) - 0.055).astype(np.float32)


@pytest.mark.parametrize("integrator", [monte_carlo, analytic])
@pytest.mark.parametrize("roughness", [0.1, 0.2, 0.4, 0.7, 1.0])
def test_ggx_drawn_is_ggx(integrator: object, roughness: float) -> None:
    alpha = roughness**2
    ours = integrator(ball(of_picture(draw(512, alpha), **METAL), 48))
    expected = integrator(ball(pivot_core.Material(alpha=alpha, **METAL), 48))
    assert ours.mean() == pytest.approx(expected.mean(), rel=0.01)
    assert flip_evaluator.evaluate(shown(expected), shown(ours), "LDR")[1] < 0.02


@pytest.mark.parametrize("roughness", [0.1, 0.3, 0.6, 1.0])
def test_joint_samples_are_as_good_as_those_of_ggx(roughness: float) -> None:
    """Within three times the variance."""
    alpha = roughness**2
    errors = []
    for material in (of_picture(draw(512, alpha), **METAL), pivot_core.Material(alpha=alpha, **METAL)):
        scene = ball(material)
        converged = render(scene, samples=512, max_bounces=0, seed=9)[..., :3].astype(float)
        weight = 1 / (converged.mean(-1, keepdims=True) ** 2 + 1e-2)
        pictures = [render(scene, samples=16, max_bounces=0, seed=s)[..., :3].astype(float) for s in range(4)]
        errors.append(np.mean([weight * (picture - converged) ** 2 for picture in pictures]))
    assert errors[0] < 3 * errors[1]


@pytest.mark.parametrize("kind", ["pixel", "tilted pixel", "ring", "grid", "rim"])
def test_sharp_pictures_render(kind: str) -> None:
    """By light samples as by BSDF samples, and no NaN in any integrator."""
    scene = ball(of_picture(sharp(kind), **METAL), 20)
    seeds = range(4)
    joint, alone = (
        np.array([render(scene, samples=256, max_bounces=0, light_sampling=m, seed=s)[..., :3].mean() for s in seeds])
        for m in ("JOINT", "BSDF")
    )
    assert np.all(np.isfinite([joint, alone]))
    noise = np.hypot(joint.std(ddof=1), alone.std(ddof=1)) / 2 + 1e-3 * alone.mean()
    assert abs(joint.mean() - alone.mean()) < 5 * noise
    assert np.all(np.isfinite(analytic(scene)))


@pytest.mark.parametrize(
    "picture",
    [draw(256, 0.04), draw(256, 0.3), draw(256, 1.0), draw(256, 0.1, 0.3, 0.6), sharp("ring"), sharp("pixel")],
)
def test_a_white_furnace_loses_nothing(picture: Array) -> None:
    """Where light bounces between microfacets too."""
    scene = pivot_core.Scene()
    scene.add_instances("ball", add_sphere(scene), place(), [scene.add_material("white", of_picture(picture, **WHITE))])
    scene.set_world((1, 1, 1))
    set_camera(scene, (0, -4, 0), size=(32, 32), half_width=0.2)
    seen = render(scene, samples=256, max_bounces=0)[..., :3].astype(float)
    assert seen.mean() == pytest.approx(1, abs=0.02)


def test_light_goes_both_ways() -> None:
    """Reciprocity: what wi sends to wo, wo sends to wi."""
    material = of_picture(draw(128, 0.2, 0.5, 0.3), **METAL)
    random = np.random.default_rng(3)
    for _ in range(20):
        wo, wi = ((*random.uniform(-0.6, 0.6, 2), random.uniform(0.3, 1)) for _ in range(2))
        wo, wi = (np.array(w) / np.linalg.norm(w) for w in (wo, wi))
        there = material.evaluate(tuple(wo), wi[None].astype(np.float32))[0] / wi[2]
        back = material.evaluate(tuple(wi), wo[None].astype(np.float32))[0] / wo[2]
        np.testing.assert_allclose(there, back, rtol=1e-3)


def test_the_picture_lies_along_the_tangent() -> None:
    """A program's tangent turns it: grooves along x and along y, each seen from either side."""
    picture = draw(128, 0.02, 0.5)
    seen = []
    for tangent in ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0)):
        program = pivot_core.Program()
        along = program.add("position", [])
        parts = [program.add("math_multiply", [(along, 0.0), (-1, 0.0)]) for _ in range(3)]
        registers = [program.add("math_add", [(p, 0.0), (-1, t)]) for p, t in zip(parts, tangent, strict=True)]
        shader = pivot_core.Shader(of_picture(picture, **METAL), program, {"tangent": registers})
        scene = pivot_core.Scene()
        scene.add_instances("floor", add_plane(scene, 10.0), place(), [scene.add_material("brushed", shader)])
        scene.add_light("lamp", pivot_core.SphereLight((0, 4, 2), 0.1, (100, 100, 100)))
        set_camera(scene, (0, -2, 2.0), size=(16, 16), half_width=0.02)
        seen.append(render(scene, samples=64, max_bounces=0)[..., :3].mean())
    assert seen[1] != pytest.approx(seen[0], rel=0.3)


ALONG, ACROSS, TILT = 0.3, 0.08, 0.45  # of a weave: alphas and the slope of its fibres


def weave_lit_by(lamp: Array, radius: float, wo: Array, to_lamp: Array) -> Array:
    """What two tilted GGX lobes, of F = 1, reflect to wo of a sphere of intensity 1, by points of its cap."""

    def sigma(w: Array, tilt: float) -> Array:
        stretched = np.stack([ACROSS * w[..., 0], ALONG * w[..., 1], w[..., 2] + tilt * w[..., 0]], -1)
        return (np.linalg.norm(stretched, axis=-1) + stretched[..., 2]) / 2

    def masking(w: Array) -> Array:
        return np.maximum((sigma(w, TILT) + sigma(w, -TILT)) / 2 / w[..., 2] - 1, 0)

    distance = np.linalg.norm(to_lamp, axis=-1)
    axis, versine = to_lamp / distance[..., None], 1 - np.sqrt(1 - (radius / distance) ** 2)
    x = np.cross(axis, (0, 1, 0))
    x /= np.linalg.norm(x, axis=-1, keepdims=True)
    y, total, count = np.cross(axis, x), 0.0, 64
    for k in range(count):
        z = 1 - versine * (k + 0.5) / count
        phi, sine = 2 * np.pi * 0.618034 * k, np.sqrt(1 - z * z)
        wi = axis * z[..., None] + (x * np.cos(phi) + y * np.sin(phi)) * sine[..., None]
        h = (wi + wo) / np.linalg.norm(wi + wo, axis=-1, keepdims=True)
        d = sum(ggx(h[..., 0], h[..., 1], h[..., 2] ** 2, ACROSS, ALONG, tilt) / 2 for tilt in (TILT, -TILT))
        total = total + d / (4 * wo[..., 2] * (1 + masking(wo) + masking(wi)))
    return total * 2 * np.pi * versine / count / (np.pi * radius**2)


@pytest.mark.parametrize("integrator", [monte_carlo, analytic])
def test_a_weave_is_the_sum_of_its_lobes(integrator: object) -> None:
    """Its two highlights on a plane, by quadrature."""
    white = {"conductor_f0": (1, 1, 1), "conductor_f90": (1, 1, 1)}
    lamp, radius, eye, side_px, half_width = np.array([0, 0, 2.0]), 0.1, (0.0, -0.5, 3.0), 48, 0.9
    scene = pivot_core.Scene()
    material = scene.add_material("weave", of_picture(draw(512, ACROSS, ALONG, TILT), **white))
    scene.add_instances("plane", add_plane(scene, 10.0), place(), [material])
    scene.add_light("lamp", pivot_core.SphereLight(tuple(lamp), radius, (1, 1, 1)))
    set_camera(scene, eye, size=(side_px, side_px), half_width=half_width)
    camera, fine = look_at(eye, (0, 0, 0)).astype(float), 3
    u = ((np.arange(fine * side_px) + 0.5) / (fine * side_px) * 2 - 1) * half_width
    across, up = np.meshgrid(u, u)
    view = camera[:3, 0] * across[..., None] + camera[:3, 1] * up[..., None] - camera[:3, 2]
    view /= np.linalg.norm(view, axis=-1, keepdims=True)
    places = camera[:3, 3] - view * (eye[2] / view[..., 2])[..., None]
    expected = weave_lit_by(lamp, radius, -view, lamp - places).reshape(side_px, fine, side_px, fine).mean((1, 3))
    seen = integrator(scene).mean(-1)
    assert seen.mean() == pytest.approx(expected.mean(), rel=5e-3)
    np.testing.assert_allclose(seen, expected, atol=0.04 * expected.max())
    peaks = expected.max(axis=0)
    assert (np.diff(np.sign(np.diff(peaks))) < 0).sum() == 2


GLOSSY_RAY = 4  # RayKind of core/shaders/place.h


@pytest.mark.parametrize("has_lobe_beside", [False, True])
def test_its_highlight_sends_glossy_rays(has_lobe_beside: bool) -> None:
    """Which alone see this world; the diffuse half of it sees none."""
    program = pivot_core.Program()
    seen = program.add("ray_is", [], [GLOSSY_RAY])
    sky = pivot_core.Shader(pivot_core.Material(emission=(1, 1, 1)), program, {"emission": [seen] * 3})
    lobes = [("base", {"diffuse": (0.5, 0.5, 0.5)})] if has_lobe_beside else []
    tabulated = ("tabulated", {"ndf": pivot_core.TabulatedNdf(draw(128, 0.1)), **METAL})
    pictures = []
    for material in (
        pivot_core.Material(lobes=[tabulated, *lobes]),
        pivot_core.Material(alpha=0.1, **METAL, lobes=lobes),
    ):
        scene = pivot_core.Scene()
        scene.add_instances("floor", add_plane(scene, 10.0), place(), [scene.add_material("metal", material)])
        scene.set_world_shader(sky)
        set_camera(scene, (0, -2, 2.0), size=(16, 16), half_width=0.02)
        pictures.append(render(scene, samples=256, max_bounces=0, light_sampling="BSDF")[..., :3].mean())
    assert pictures[0] == pytest.approx(pictures[1], rel=0.02)
    assert 0.5 < pictures[0] < 1
