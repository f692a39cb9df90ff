"""Samples in the pixel follow its filter's window."""

import numpy as np
import pytest
from numpy.typing import NDArray
from pivot_core.film import filter_offsets
from scipy.stats import chi2

from tests.core.chi_squared import random_squares

# Blackman-Harris: sums of cosines, as in [Harris78, table I]
TERMS = np.array([0.35875, -0.48829, 0.14128, -0.01168])


def blackman_harris_cdf(x: NDArray[np.float64]) -> NDArray[np.float64]:
    """The share of the window over [0, 1] that lies below x."""
    k = 2 * np.pi * np.arange(1, 4)
    return x + (np.sin(np.multiply.outer(x, k)) * TERMS[1:] / k).sum(-1) / TERMS[0]


@pytest.mark.parametrize("width_px", [0.7, 1.5, 3.0])
def test_offsets_follow_the_window(width_px: float) -> None:
    u = random_squares(40_000)
    edges = np.linspace(0, 1, 33)
    expected = len(u) * np.diff(blackman_harris_cdf(edges))
    for offsets in filter_offsets("BLACKMAN_HARRIS", width_px, u).T:
        counts, _ = np.histogram(offsets / width_px + 0.5, edges)
        used = expected > 5
        statistic = ((counts - expected)[used] ** 2 / expected[used]).sum()
        assert chi2.sf(statistic, used.sum() - 1) > 1e-4
        assert counts[~used].sum() <= 5 * len(u) ** 0.5


def test_the_table_is_exact_at_its_nodes() -> None:
    u = np.arange(1024) / 1024
    places = filter_offsets("BLACKMAN_HARRIS", 1.0, np.stack([u, u], 1))[:, 0].astype(np.float64) + 0.5
    np.testing.assert_allclose(blackman_harris_cdf(places), u, atol=1e-5)


@pytest.mark.parametrize("shape", ["BLACKMAN_HARRIS", "BOX"])
def test_offsets_stay_within_the_width_and_each_axis_has_its_own_number(shape: str) -> None:
    last = np.nextafter(np.float32(1), np.float32(0))
    u = np.array([[0, last], [last, 0], [0.5, 0.5], [0.25, 0.75]], np.float32)
    offsets = filter_offsets(shape, 2.0, u)
    assert np.abs(offsets).max() <= 1
    np.testing.assert_allclose(offsets[:2], [[-1, 1], [1, -1]], atol=0.03)
    np.testing.assert_allclose(offsets[2], 0, atol=1e-6)
    np.testing.assert_allclose(offsets[3, 0], -offsets[3, 1], rtol=1e-4)


def test_the_box_is_even() -> None:
    u = random_squares(1000)
    np.testing.assert_allclose(filter_offsets("BOX", 1.5, u), 1.5 * (u - 0.5), atol=1e-6)


def test_no_width_is_the_centre() -> None:
    np.testing.assert_array_equal(filter_offsets("BLACKMAN_HARRIS", 0.0, random_squares(100)), 0)
