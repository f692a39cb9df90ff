"""Highlights about axes of their own: where they are, how rough, and what they keep of the light."""

from __future__ import annotations

import numpy as np
import pivot_core
import pytest
from numpy.typing import NDArray
from scenes import add_plane, place, render, set_camera

from tests.core.chi_squared import expected_share

Floats = NDArray[np.float64]
WHITE = {"conductor_f0": (1, 1, 1), "conductor_f90": (1, 1, 1)}
ALPHA_X, ALPHA_Y = 0.6, 0.15


def metal(**values: object) -> pivot_core.Material:
    return pivot_core.Material(lobes=[("anisotropic", WHITE | {"alpha_x": ALPHA_X, "alpha_y": ALPHA_Y} | values)])


def random_above(count: int, seed: int) -> Floats:
    wi = np.random.default_rng(seed).normal(size=(count, 3))
    wi[:, 2] = abs(wi[:, 2])
    return wi / np.linalg.norm(wi, axis=1, keepdims=True)


def ggx(wo: Floats, wi: Floats, x: Floats, y: Floats, z: Floats) -> Floats:
    """D G2 / (4 cos_o) about axes. [Heitz14 (85), (86), (99)]"""

    def lambda_of(w: Floats) -> Floats:
        tan2 = ((ALPHA_X * (w @ x)) ** 2 + (ALPHA_Y * (w @ y)) ** 2) / (w @ z) ** 2
        return (np.sqrt(1 + tan2) - 1) / 2

    h = wo + wi
    h /= np.linalg.norm(h, axis=1, keepdims=True)
    slope = (h @ x / ALPHA_X) ** 2 + (h @ y / ALPHA_Y) ** 2 + (h @ z) ** 2
    density = 1 / (np.pi * ALPHA_X * ALPHA_Y * slope**2)
    value = density / (4 * (wo @ z) * (1 + lambda_of(wo) + lambda_of(wi)))
    return np.where((wi @ z > 0) & (wi[:, 2] > 0), value, 0)


@pytest.mark.parametrize("tilt", [0.0, 0.3])
@pytest.mark.parametrize("turns", [0.0, 0.15, 1.4])
def test_axes(tilt: float, turns: float) -> None:
    """The rotation is to the left about the normal, seen from outside; x keeps to the tangent of the surface."""
    z = np.array([np.sin(tilt) * 0.6, np.sin(tilt) * 0.8, np.cos(tilt)])
    x = np.array([1.0, 0, 0]) - z[0] * z
    x /= np.linalg.norm(x)
    y = np.cross(z, x)
    angle = 2 * np.pi * turns
    x, y = np.cos(angle) * x + np.sin(angle) * y, np.cos(angle) * y - np.sin(angle) * x
    material = metal(rotation=turns, **({"normal": tuple(z)} if tilt else {}))
    wo, wi = np.array([0.5, -0.3, np.sqrt(1 - 0.34)]), random_above(500, 1)
    found = material.evaluate(tuple(wo), wi.astype(np.float32))[0].astype(float)
    np.testing.assert_allclose(found[:, 0], ggx(wo, wi, x, y, z), rtol=2e-3, atol=1e-5)


def test_nothing_is_seen_from_below_its_normal() -> None:
    material = metal(normal=(0.9, 0, 0.44))
    assert material.evaluate((-0.8, 0, 0.6), random_above(50, 2).astype(np.float32))[0].max() == 0
    assert max(material.albedo((-0.8, 0, 0.6))) == 0


def test_as_rough_all_around_it_is_a_base() -> None:
    """With what either gives back of the light that is lost between microfacets."""
    values = {"conductor_f0": (0.9, 0.6, 0.3), "conductor_f90": (1, 1, 1), "dielectric_weight": 0.5}
    axes = {"alpha_x": 0.5, "alpha_y": 0.5, "rotation": 0.3, "multiscatter": 1.0}
    base = pivot_core.Material(**values, alpha=0.5, multiscatter=True)
    lobe = pivot_core.Material(lobes=[("anisotropic", values | axes)])
    for wo in ((0.0, 0, 1), (0.6, 0, 0.8), (0, 0.99, 0.14)):
        wi = random_above(200, 3).astype(np.float32)
        np.testing.assert_allclose(lobe.evaluate(wo, wi)[0], base.evaluate(wo, wi)[0], rtol=1e-3, atol=1e-6)


def test_multiscatter_keeps_a_white_conductor_white() -> None:
    """Of n + i k that mirrors nearly all."""
    axes = {"alpha_x": 0.8, "alpha_y": 0.8, "multiscatter": 1.0}
    material = pivot_core.Material(lobes=[("conductor", {"n": (0.001,) * 3, "k": (50.0,) * 3} | axes)])
    wo = (0.6, 0.0, 0.8)
    rings = np.linspace(0, 1, 17)
    for c in range(3):
        kept = expected_share(
            lambda wi, c=c: material.evaluate(wo, wi.reshape(-1, 3).astype(np.float32))[0][:, c].reshape(wi.shape[:-1]),
            np.array([0.0, 0, 1]),
            rings,
            32,
        ).sum()
        assert kept == pytest.approx(1, abs=0.01)


def dark_scene(material: pivot_core.Material) -> pivot_core.Scene:
    scene = pivot_core.Scene()
    scene.add_instances("floor", add_plane(scene, 50.0), place(), [scene.add_material("floor", material)])
    scene.add_light("lamp", pivot_core.SphereLight((0, 3, 2), 0.2, (3, 3, 3)))
    set_camera(scene, (0, -3, 2), size=(16, 16), half_width=0.02)
    return scene


def test_light_samples_follow_it() -> None:
    """Nearly exactly, where nothing else is: a sample of a small light varies by what masks the microfacets."""
    scene = dark_scene(metal())
    few = [render(scene, samples=1, max_bounces=0, seed=seed)[..., 0] for seed in range(8)]
    alone = [render(scene, samples=1, max_bounces=0, seed=seed, light_sampling="BSDF")[..., 0] for seed in range(8)]
    reference = render(scene, samples=1024, max_bounces=0)[..., 0]
    error, error_alone = (np.mean((np.array(pictures) / reference - 1) ** 2) for pictures in (few, alone))
    assert error < 0.002
    assert error_alone > 10
