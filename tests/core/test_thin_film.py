"""A dielectric beneath a thin film: where the film is none, where it is thick, and where it is a quarter of a wave."""

from __future__ import annotations

import numpy as np
import pivot_core
import pytest
from numpy.typing import NDArray

Array = NDArray[np.float64]
COSINES = (1.0, 0.8, 0.5, 0.2)
ALPHA = 0.2
IOR = 1.5


def mirrored(kind: str, cosine: float, **curve: object) -> Array:
    """What microfacets that mirror wo to its mirror image reflect, (3,)."""
    sine = np.sqrt(1 - cosine**2)
    lobes = [
        (kind, {"alpha_x": ALPHA, "alpha_y": ALPHA} | curve),
        ("anisotropic", {"alpha_x": ALPHA, "alpha_y": ALPHA, "conductor_f0": (1, 1, 1), "conductor_f90": (1, 1, 1)}),
    ]
    ours, white = (
        pivot_core.Material(lobes=[lobe]).evaluate((sine, 0, cosine), np.array([[-sine, 0, cosine]], np.float32))[0][0]
        for lobe in lobes
    )
    return ours.astype(float) / white


def bare(cosine: float, ior: float = IOR) -> Array:
    return mirrored("anisotropic", cosine, dielectric_weight=1.0, dielectric_ior=ior)


def incoherent(cosine: float, film: float) -> float:
    """The sum over reflections within a film of what each brings, without interference."""
    inside = np.sqrt(1 - (1 - cosine**2) / film**2)
    below = np.sqrt(1 - (1 - cosine**2) / IOR**2)
    share = 0.0
    for one, two, three in ((1.0, film, IOR), (1.0, 1 / film, 1 / IOR)):
        r12 = ((one * cosine - two * inside) / (one * cosine + two * inside)) ** 2
        r23 = ((two * inside - three * below) / (two * inside + three * below)) ** 2
        share += 0.5 * (r12 + (1 - r12) ** 2 * r23 / (1 - r12 * r23))
    return share


@pytest.mark.parametrize("cosine", COSINES)
def test_no_film_leaves_the_dielectric(cosine: float) -> None:
    for film in ({"film_nm": 0.0, "film_ior": 1.8}, {"film_nm": 500.0, "film_ior": IOR}):
        np.testing.assert_allclose(mirrored("thin_film", cosine, ior=IOR, **film), bare(cosine), rtol=2e-3, atol=1e-5)


@pytest.mark.parametrize("cosine", COSINES)
def test_a_thick_film_has_no_colour(cosine: float) -> None:
    seen = mirrored("thin_film", cosine, ior=IOR, film_ior=1.8, film_nm=20_000.0)
    np.testing.assert_allclose(seen, incoherent(cosine, 1.8), rtol=2e-3)


def test_a_quarter_wave_mirrors_least() -> None:
    """Of an index that is the root of the glass's, next to nothing of the green that it is made for."""
    film = float(np.sqrt(IOR))
    seen = mirrored("thin_film", 1.0, ior=IOR, film_ior=film, film_nm=550 / 4 / film)
    assert seen[1] < 0.05 * bare(1.0)[1]
    assert seen[2] > seen[1]


@pytest.mark.parametrize("film_nm", [0.0, 200.0, 700.0])
@pytest.mark.parametrize("ior", [1.5, 0.7])
def test_glass_beneath_a_film_keeps_all_light(ior: float, film_nm: float) -> None:
    glass = {"alpha": 0.01, "ior": ior, "film_ior": 1.7, "film_nm": film_nm}
    for cosine in COSINES[:3]:
        albedo = pivot_core.Material(lobes=[("dielectric", glass)]).albedo((np.sqrt(1 - cosine**2), 0, cosine))
        np.testing.assert_allclose(albedo, 1, rtol=0.01)
