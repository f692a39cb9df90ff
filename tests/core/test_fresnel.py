"""What microfacets of metal reflect: Schlick's curve, F82's and that of an index of refraction."""

from __future__ import annotations

import numpy as np
import pivot_core
import pytest
from numpy.typing import NDArray
from scenes import add_plane, place, render, set_camera

Floats = NDArray[np.float64]
F0, TINT = np.array([0.9, 0.5, 0.1]), np.array([0.2, 0.6, 1.0])
N, K = np.array([0.14, 0.9, 2.5]), np.array([4.0, 2.4, 0.0])
ALPHA = 0.3
COSINES = np.linspace(0.02, 1, 25)


def reflectance(material: pivot_core.Material, mirror: pivot_core.Material) -> Floats:
    """(n, 3): over what a white mirror of the same microfacets reflects, light and viewer across the normal from
    each other."""
    sine = np.sqrt(1 - COSINES**2)
    values = []
    for c, s in zip(COSINES, sine, strict=True):
        wi = np.array([[-s, 0, c]], np.float32)
        values.append(material.evaluate((s, 0, c), wi)[0][0] / mirror.evaluate((s, 0, c), wi)[0][0])
    return np.array(values, float)


def schlick(cosine: Floats) -> Floats:
    return F0 + (1 - F0) * (1 - cosine[:, None]) ** 5


def f82(cosine: Floats) -> Floats:
    """[Kutz21]: Schlick's times the tint where the cosine is 1/7."""
    weight = cosine * (1 - cosine) ** 6
    at_82 = schlick(np.array([1 / 7]))[0] * (1 - TINT) / (1 / 7 * (6 / 7) ** 6)
    return np.maximum(schlick(cosine) - at_82 * weight[:, None], 0)


def conductor(cosine: Floats) -> Floats:
    """By complex amplitudes."""
    c = cosine[:, None].astype(complex)
    index = N + 1j * K
    inner = np.sqrt(index**2 - 1 + c**2)
    s = (c - inner) / (c + inner)
    p = (index**2 * c - inner) / (index**2 * c + inner)
    return (abs(s) ** 2 + abs(p) ** 2) / 2


@pytest.mark.parametrize("kind", ["base", "lobe"])
def test_f82(kind: str) -> None:
    dip = schlick(np.array([1 / 7]))[0] * (1 - TINT) / (1 / 7 * (6 / 7) ** 6)
    tinted = {"conductor_f0": tuple(F0), "conductor_f90": (1, 1, 1), "conductor_dip": tuple(dip)}
    white = {"conductor_f0": (1, 1, 1), "conductor_f90": (1, 1, 1)}

    def metal(values: dict[str, object]) -> pivot_core.Material:
        if kind == "base":
            return pivot_core.Material(alpha=ALPHA, **values)
        return pivot_core.Material(lobes=[("anisotropic", values | {"alpha_x": ALPHA, "alpha_y": ALPHA})])

    np.testing.assert_allclose(reflectance(metal(tinted), metal(white)), f82(COSINES), rtol=1e-4, atol=1e-5)
    at_82 = reflectance(metal(tinted), metal(white))[np.argmin(abs(COSINES - 1 / 7))]
    assert at_82[0] < 0.5 * F0[0]  # and so a dark edge


def test_conductors() -> None:
    """Cycles' formula leaves out what |n + i k|^2 - sin^2 is more than |n + i k|^2, which of metals is little."""
    axes = {"alpha_x": ALPHA, "alpha_y": ALPHA}
    metal = pivot_core.Material(lobes=[("conductor", {"n": tuple(N), "k": tuple(K)} | axes)])
    white = {"conductor_f0": (1, 1, 1), "conductor_f90": (1, 1, 1)}
    found = reflectance(metal, pivot_core.Material(lobes=[("anisotropic", white | axes)]))
    c, size2 = COSINES[:, None], N**2 + K**2
    parallel = (size2 * c**2 - 2 * N * c + 1) / (size2 * c**2 + 2 * N * c + 1)
    perpendicular = (size2 - 2 * N * c + c**2) / (size2 + 2 * N * c + c**2)
    np.testing.assert_allclose(found, (parallel + perpendicular) / 2, rtol=1e-4)
    np.testing.assert_allclose(found, conductor(COSINES), atol=0.04)


@pytest.mark.parametrize("alpha", [0.05, 0.2, 0.5])
def test_the_analytic_integrator_knows_f82(alpha: float) -> None:
    """At grazing view, where F82 takes most: within the error that it predicts."""
    dip = tuple(schlick(np.array([1 / 7]))[0] * (1 - TINT) / (1 / 7 * (6 / 7) ** 6))
    metal = pivot_core.Material(alpha=alpha, conductor_f0=tuple(F0), conductor_f90=(1, 1, 1), conductor_dip=dip)
    scene = pivot_core.Scene()
    scene.add_instances("floor", add_plane(scene, 50.0), place(), [scene.add_material("floor", metal)])
    scene.add_light("lamp", pivot_core.SphereLight((0, 4, 1.3), 0.6, (3, 3, 3)))
    set_camera(scene, (0, -3, 0.8), size=(6, 6), half_width=0.1)
    ours = render(scene, integrator="ANALYTIC", samples=4)[..., :3].astype(float).mean((0, 1))
    error = render(scene, "Error", integrator="ANALYTIC", samples=4).mean()
    random = render(scene, samples=1024, max_bounces=0)[..., :3].astype(float).mean((0, 1))
    assert abs(ours.mean() / random.mean() - 1) < error + 0.003
    np.testing.assert_allclose(ours, random, rtol=max(2 * error, 0.01))
