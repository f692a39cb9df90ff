"""Linearly transformed cosines over caps and polygons above the surface, against sums that know no closed form."""

from collections.abc import Iterator

import numpy as np
import pivot_core.distributions as pd
import pivot_core.tables as tables
import pytest


def lobes(count: int, seed: int) -> Iterator[tuple[np.random.Generator, np.ndarray]]:
    """(a generator, the matrix of a lobe) of all widths, tilts and skews, some of them below the surface in part."""
    for i in range(count):
        rng = np.random.default_rng((seed, i))
        cos_o = rng.uniform(0.02, 1)
        wo = np.array([np.sqrt(1 - cos_o**2), 0, cos_o])
        widths = np.exp(rng.uniform(-1.5, 1, 2))
        yield rng, tables.ggx_ltc_from_node(10 ** rng.uniform(-2, 0), wo, rng.uniform(-2, 2), *widths, rng.normal())


def direction_near(rng: np.random.Generator, axis: np.ndarray, spread: float) -> np.ndarray:
    omega = axis / np.linalg.norm(axis) + spread * rng.normal(size=3)
    return omega / np.linalg.norm(omega)


def rim(axis: np.ndarray, versine: float, count: int) -> np.ndarray:
    """A polygon of that many vertices whose vertices lie as far out as to hold the cap's solid angle to 1 / count^4."""
    across = np.cross(axis, np.eye(3)[np.argmin(np.abs(axis))])
    across /= np.linalg.norm(across)
    phi = np.arange(count) * 2 * np.pi / count
    tangent = np.tan(np.arccos(1 - versine)) * np.sqrt(2 * np.pi / count / np.sin(2 * np.pi / count))
    return axis + tangent * (np.cos(phi)[:, None] * across + np.sin(phi)[:, None] * np.cross(axis, across))


def test_a_cap_is_the_limit_of_its_polygons() -> None:
    crossing = 0
    for rng, m in lobes(300, 1):
        axis, versine = direction_near(rng, m[:, 2], rng.choice([0.05, 0.3, 1.0])), rng.choice([1e-3, 0.03, 0.2, 0.7])
        coarse, fine = (pd.ltc_integrate_polygon(m, rim(axis, versine, n)) for n in (500, 1000))
        crossing += abs(axis[2]) < np.sqrt(versine * (2 - versine))
        exact = pd.ltc_integrate_cap(m, axis, versine)
        assert exact == pytest.approx(fine, rel=3e-4, abs=1e-7)
        # halving the sides quarters the error, so this is nearer still
        assert exact == pytest.approx((4 * fine - coarse) / 3, rel=1e-5, abs=1e-8)
    assert crossing > 50


def test_untransformed_it_is_the_clamped_cosine() -> None:
    rng = np.random.default_rng(2)
    for versine in (1e-8, 1e-3, 0.5, 1.0, 1.7):
        axis = direction_near(rng, np.array([1, 0, 0.3]), 0.2)
        expected = pd.cap_cosine_integral(axis, versine, np.array([0.0, 0.0, 1.0])) / np.pi
        assert pd.ltc_integrate_cap(np.eye(3), axis, versine) == pytest.approx(expected, rel=1e-5)


def test_a_cap_and_the_rest_of_the_sphere_make_the_whole() -> None:
    for rng, m in lobes(100, 3):
        axis, versine = direction_near(rng, m[:, 2], 0.5), rng.uniform(0.3, 1)
        both = pd.ltc_integrate_cap(m, axis, versine) + pd.ltc_integrate_cap(m, -axis, 2 - versine)
        assert both == pytest.approx(pd.ltc_above_horizon(m), abs=1e-12)
        hemispheres = (pd.ltc_integrate_cap(m, side * axis, 1.0) for side in (1, -1))
        assert sum(hemispheres) == pytest.approx(pd.ltc_above_horizon(m), abs=1e-6)


def test_above_the_horizon_by_sampling() -> None:
    u = (np.stack(np.meshgrid(np.arange(400), np.arange(400)), -1).reshape(-1, 2) + 0.5) / 400
    for _, m in lobes(20, 4):
        above = pd.ltsd_sample("clamped_cosine", m, u)[:, 2] > 0
        assert pd.ltc_above_horizon(m) == pytest.approx(above.mean(), abs=2e-3)


def test_a_polygon_is_cut_at_the_horizon() -> None:
    """An upright rectangle half below the surface: its upper half, by Gauss and Legendre's points."""
    x, w = np.polynomial.legendre.leggauss(200)
    for rng, m in lobes(20, 5):
        m = m @ np.diag([3, 3, 1])  # wide enough for the points
        near, wide, high = rng.uniform(0.3, 2), rng.uniform(0.2, 1), rng.uniform(0.2, 1)
        rectangle = np.array([[near, y * wide, z * high] for y, z in ((-1, -1), (1, -1), (1, 1), (-1, 1))])
        y, z = np.meshgrid(x * wide, (x + 1) * high / 2)
        place = np.stack([np.full_like(y, near), y, z], -1)
        distance = np.linalg.norm(place, axis=-1)
        value = pd.ltsd_eval("clamped_cosine", m, place / distance[..., None]) * near / distance**3
        expected = np.einsum("i,j,ij->", w * high / 2, w * wide, value)
        assert pd.ltc_integrate_polygon(m, rectangle) == pytest.approx(expected, rel=2e-3, abs=1e-5)


def test_float32_holds_what_float64_says() -> None:
    """Down to lights of 0.1 mrad and lobes of 1 mrad, at the horizon too."""
    for rng, m in lobes(300, 6):
        axis = direction_near(rng, m[:, 2], rng.choice([1e-3, 0.05, 0.5])).astype(np.float32)
        versine, m = np.float32(10 ** rng.uniform(-8, 0)), m.astype(np.float32)
        exact = pd.ltc_integrate_cap(m.astype(np.float64), axis.astype(np.float64), float(versine))
        assert pd.ltc_integrate_cap(m, axis, versine) == pytest.approx(exact, rel=1e-5, abs=1e-12)
