"""Samples in a pixel, weighed for the pixels around, follow each pixel's window."""

import numpy as np
import pivot_core
import pytest
from numpy.typing import NDArray
from pivot_core.film import filter_samples
from scipy.stats import chi2

from tests.core.chi_squared import random_squares
from tests.core.scenes import add_plane, place, render, set_camera

# Blackman-Harris: sums of cosines, as in [Harris78, table I]
TERMS = np.array([0.35875, -0.48829, 0.14128, -0.01168])
WIDTHS_PX = [0.7, 1.0, 1.5, 3.0, 5.2]


def blackman_harris_cdf(x: NDArray[np.float64]) -> NDArray[np.float64]:
    """The share of the window over [0, 1] that lies below x."""
    k = 2 * np.pi * np.arange(1, 4)
    return x + (np.sin(np.multiply.outer(x, k)) * TERMS[1:] / k).sum(-1) / TERMS[0]


def box_cdf(x: NDArray[np.float64]) -> NDArray[np.float64]:
    return x


CDFS = {"BLACKMAN_HARRIS": blackman_harris_cdf, "BOX": box_cdf}


@pytest.mark.parametrize("width_px", WIDTHS_PX)
@pytest.mark.parametrize("shape", CDFS)
def test_what_a_pixel_is_given_follows_its_window(shape: str, width_px: float) -> None:
    """The weights that one pixel gets from its own samples and those around, over bins of where these lie from it."""
    u = random_squares(40_000)
    offsets, weights = filter_samples(shape, width_px, u)
    reach = weights.shape[-1] // 2
    edges = np.linspace(0, 1, 33)
    expected = np.diff(CDFS[shape](edges))
    for axis in (0, 1):
        # A sample of the pixel `off` away lies that much further.
        places = offsets[:, axis, None] - np.arange(-reach, reach + 1)
        bins = [
            ((places >= low) & (places < high)) * weights[:, axis]
            for low, high in zip((edges[:-1] - 0.5) * width_px, (edges[1:] - 0.5) * width_px, strict=True)
        ]
        per_sample = np.array([b.sum(-1) for b in bins])  # (bins, samples)
        deviation = per_sample.std(-1) / len(u) ** 0.5
        seen = expected * len(u) > 20
        z = (per_sample.mean(-1) - expected)[seen] / deviation[seen]
        assert chi2.sf((z**2).sum(), seen.sum()) > 1e-4
        assert per_sample[~seen].mean(-1).sum() < 0.01


@pytest.mark.parametrize("width_px", WIDTHS_PX)
@pytest.mark.parametrize("shape", CDFS)
def test_a_sample_is_worth_one_in_all_and_lies_in_its_pixel(shape: str, width_px: float) -> None:
    offsets, weights = filter_samples(shape, width_px, random_squares(1000))
    np.testing.assert_allclose(weights.sum(-1), 1.0, rtol=1e-6)
    assert (weights >= 0).all()
    assert np.abs(offsets).max() <= 0.5 * min(width_px, 1.0)
    assert weights.shape[-1] == 1 + 2 * max(int(np.ceil(width_px / 2 - 0.5)), 0)


def test_blenders_default_filter_leaves_less_than_half_of_the_variance() -> None:
    """Of samples of even noise: each pixel's estimate has the sum of the squared weights that it gives to all."""
    _, weights = filter_samples("BLACKMAN_HARRIS", 3.0, random_squares(40_000))
    assert (weights**2).sum(-1).prod(-1).mean() < 0.46


def test_each_axis_has_its_own_number() -> None:
    last = np.nextafter(np.float32(1), np.float32(0))
    u = np.array([[0, last], [last, 0], [0.5, 0.5], [0.25, 0.75]], np.float32)
    offsets, _ = filter_samples("BLACKMAN_HARRIS", 3.0, u)
    np.testing.assert_allclose(offsets[:2], [[-0.5, 0.5], [0.5, -0.5]], atol=1e-4)
    np.testing.assert_allclose(offsets[2], 0, atol=1e-6)
    np.testing.assert_allclose(offsets[3, 0], -offsets[3, 1], rtol=1e-4)


def test_a_box_of_one_pixel_is_even_and_its_own() -> None:
    u = random_squares(1000)
    offsets, weights = filter_samples("BOX", 1.0, u)
    np.testing.assert_allclose(offsets, u - 0.5, atol=1e-6)
    np.testing.assert_array_equal(weights, 1)


def test_no_width_is_the_centre() -> None:
    offsets, weights = filter_samples("BLACKMAN_HARRIS", 0.0, random_squares(100))
    np.testing.assert_array_equal(offsets, 0)
    np.testing.assert_array_equal(weights, 1)


def test_box_filter_is_as_wide_as_it_says() -> None:
    """The edge between black and emission, where a box of two pixels makes a ramp of two pixels."""
    scene = pivot_core.Scene()
    lamp = scene.add_material("lamp", pivot_core.Material(emission=(1, 1, 1)))
    scene.add_instances("half", add_plane(scene, 1.0), place(1.0), [lamp])
    set_camera(scene, (0, 0, 10), size=(8, 1), half_width=0.08)
    row = render(scene, samples=4096, max_bounces=0, pixel_filter="BOX", filter_width_px=2.0)[0, :, 0]
    np.testing.assert_allclose(row, [0, 0, 0, 0.25, 0.75, 1, 1, 1], atol=1e-3)


@pytest.mark.parametrize("width_px", [6.0, 40.0])
def test_a_wide_filter_blurs_as_it_says(width_px: float) -> None:
    """Also where samples are not even, and for tiles that reach far into each other: an edge of light, blurred."""
    scene = pivot_core.Scene()
    lamp = scene.add_material("lamp", pivot_core.Material(emission=(1, 1, 1)))
    scene.add_instances("half", add_plane(scene, 50.0), place(50.0), [lamp])
    set_camera(scene, (0, 0, 10), size=(96, 96), half_width=0.5)
    edge = 0.5 + np.clip((np.arange(96) + 0.5 - 48) / width_px, -0.5, 0.5)
    settings = {"max_bounces": 0, "pixel_filter": "BOX", "filter_width_px": width_px}
    for sampling in ({"samples": 16, "threads": 4}, {"samples": 256, "adaptive": True, "error_budget_percent": 0.5}):
        picture = render(scene, **settings, **sampling)[..., 0]
        np.testing.assert_allclose(picture, np.tile(edge, (96, 1)), atol=0.02)
    even = {"samples": 4, **settings}
    np.testing.assert_array_equal(render(scene, threads=1, **even), render(scene, threads=4, **even))
