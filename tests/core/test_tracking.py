"""Light through grids: what passes and where it collides has the mean that quadrature says, and always ends."""

from __future__ import annotations

import time
from itertools import pairwise

import numpy as np
import pytest

from tests.core.voxels import grid, integral, interpolated, smoke

SIZE = (20, 17, 33)
VALUES = smoke(SIZE)
ORIGIN, DIRECTION = (-7.0, 2.0, 3.0), (2.0, 0.55, 0.6)  # through most of it
FAR = 30.0
DEPTH = integral(VALUES, np.array(ORIGIN), np.array(DIRECTION), 0, FAR)
COUNT = 40_000
SIGMA = 4.0  # of means' errors, with fixed seeds

# Optical depths, by channel. Small ones go by null collisions, great ones cell by cell, those between by both.
DEPTHS = [(0.1, 0.1, 0.1), (2.0, 2.0, 2.0), (9.0, 9.0, 9.0), (0.0, 0.5, 2.0), (3.0, 1.0, 0.0), (1.0, 4.0, 9.0)]


def means_are(samples: np.ndarray, expected: np.ndarray, floor: float = 1e-6) -> None:
    """Within so many standard errors, and the room for rounding that `floor` is."""
    samples = samples.astype(float)
    error = samples.std(axis=0) / np.sqrt(len(samples))
    assert np.all(np.abs(samples.mean(axis=0) - expected) <= SIGMA * error + floor + 1e-5 * np.abs(expected))


def sigma_of(depths: tuple[float, ...]) -> tuple[float, ...]:
    return tuple(depth / DEPTH for depth in depths)


@pytest.mark.parametrize("depths", DEPTHS)
def test_transmittance_is_that_of_quadrature(depths: tuple[float, ...]) -> None:
    found = grid(VALUES).transmittances(ORIGIN, DIRECTION, 0, FAR, sigma_of(depths), 1, COUNT)
    assert found.min() >= 0
    means_are(found, np.exp(-np.array(depths)))


def test_transmittance_has_little_noise() -> None:
    """Ratio tracking without a control would have exp(extra depth) - 1, some 300 % at depth 2."""
    found = grid(VALUES).transmittances(ORIGIN, DIRECTION, 0, FAR, sigma_of((2, 2, 2)), 1, COUNT)[:, 0]
    assert found.std() < 0.15 * found.mean()


def test_dense_media_have_no_noise() -> None:
    found = grid(VALUES).transmittances(ORIGIN, DIRECTION, 12, 12.5, (40.0, 30.0, 20.0), 1, 100)
    depth = integral(VALUES, np.array(ORIGIN), np.array(DIRECTION), 12, 12.5)
    assert depth * 20 > 1
    np.testing.assert_allclose(found, np.tile(np.exp(-depth * np.array([40, 30, 20])), (100, 1)), rtol=2e-3)


@pytest.mark.parametrize("throughput", [(1.0, 1.0, 1.0), (0.2, 1.0, 0.0)])
@pytest.mark.parametrize("depths", DEPTHS)
def test_collisions_are_where_quadrature_says(depths: tuple[float, ...], throughput: tuple[float, ...]) -> None:
    sigma = np.array(sigma_of(depths))
    found = grid(VALUES).sample_collisions(ORIGIN, DIRECTION, 0, FAR, tuple(sigma), throughput, 2, COUNT)
    distances, carried = found[:, 0], found[:, 1:]
    np.testing.assert_allclose(carried.sum(axis=1), sum(throughput), rtol=1e-3)
    assert carried.min() >= -1e-6
    through = np.isinf(distances)
    means_are(carried * through[:, None], np.exp(-np.array(depths)) * throughput)
    t = (np.arange(60_000) + 0.5) * FAR / 60_000
    density = interpolated(VALUES, np.array(ORIGIN) + t[:, None] * np.array(DIRECTION))
    passed = np.exp(-np.cumsum(density)[:, None] * (FAR / 60_000) * sigma)
    edges = np.linspace(0, FAR, 21)
    for low, high in pairwise(edges):
        here = (t >= low) & (t < high)
        expected = (sigma * density[here, None] * passed[here]).sum(axis=0) * (FAR / 60_000) * throughput
        means_are(carried * ((distances >= low) & (distances < high))[:, None], expected, floor=2e-4)


def test_grey_collisions_keep_their_throughput() -> None:
    found = grid(VALUES).sample_collisions(ORIGIN, DIRECTION, 0, FAR, (0.1, 0.1, 0.1), (0.5, 0.3, 0.1), 3, 1000)
    np.testing.assert_allclose(found[:, 1:], np.tile([0.5, 0.3, 0.1], (1000, 1)), rtol=1e-4)


def test_collisions_of_one_density_are_exponential() -> None:
    voxels = grid(np.full((64, 8, 8), 2.0))
    for sigma in (0.05, 2.0):
        found = voxels.sample_collisions((4, 4, 0), (0, 0, 1), 0, 60, (sigma,) * 3, (1, 1, 1), 4, COUNT)[:, 0]
        passed = np.exp(-2 * sigma * np.array([0.1, 0.7, 3.0, 20.0]))
        measured = np.array([(found > t).mean() for t in (0.1, 0.7, 3.0, 20.0)])
        assert np.all(np.abs(measured - passed) <= SIGMA * np.sqrt(passed * (1 - passed) / COUNT))


def test_empty_space_is_free() -> None:
    values = np.zeros((40, 40, 40), np.float32)
    values[30:] = 1
    ray = ((5, 5, 0), (1, 1, 0.4), 0, 40)
    assert np.all(grid(values).transmittances(*ray, (1e5, 1e5, 1e5), 1, 100) == 1)
    assert np.all(np.isinf(grid(values).sample_collisions(*ray, (1e5,) * 3, (1, 1, 1), 1, 100)[:, 0]))
    assert np.all(grid(values).transmittances(*ray[:3], np.inf, (0, 0, 0), 1, 10) == 1)


@pytest.mark.parametrize("density", [1e5, 1e12, 1e30])
def test_dense_media_end_in_time(density: float) -> None:
    """Where a ray passes what is empty beside what is dense, and meets that only at its end."""
    values = np.zeros((33, 33, 33), np.float32)
    values[:, 3::8], values[:, :, 30:] = density, density
    voxels, started = grid(values), time.process_time()
    ray = ((-5, 0.5, 3), (1, 0, 0.1), 0, np.inf)
    passed = voxels.transmittances(*ray, (1.0, 1.0, 0.5), 1, 1000)
    found = voxels.sample_collisions(*ray, (1.0, 1.0, 0.5), (1, 1, 1), 1, 1000)
    assert time.process_time() - started < 0.5
    assert np.all(passed == 0)
    assert np.all(np.isfinite(found))
    np.testing.assert_allclose(found[:, 0], 34, atol=0.1)


@pytest.mark.parametrize(
    "ray",
    [
        ((3, 3, 3), (0, 0, 0), 0, np.inf),
        ((3, 3, 3), (0, 0, 0), 0, 2),
        ((3, 3, 3), (1e-30, 0, 1e-38), 0, np.inf),
        ((3, 3, 3), (1e30, 1e30, 1), 0, np.inf),
        ((1e30, 3, 3), (-1e30, 0, 0), 0, 1e30),
        ((3, 3, 3), (np.nan, 0, 0), 0, 1),
    ],
)
def test_odd_rays_end_in_numbers(ray: tuple[object, ...]) -> None:
    voxels = grid(VALUES)
    passed = voxels.transmittances(*ray, (1, 2, 3), 1, 10)
    assert np.all((passed >= 0) & (passed <= 4))
    found = voxels.sample_collisions(*ray, (1, 2, 3), (1, 1, 1), 1, 10)
    assert np.all(found[:, 0] >= 0)
    assert np.all(np.isfinite(found[:, 1:]))
