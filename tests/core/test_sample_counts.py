"""Adaptive sample counts: known pilots, known counts."""

import numpy as np
import pytest
from numpy.typing import NDArray
from pivot_core.film import pilot_samples, sample_counts

PILOT = 16  # samples that every pixel has when at most 64 are allowed


def even(height: int, width: int, mean: float, spread: float) -> NDArray[np.float32]:
    """A pilot of four blocks a pixel, mean +- spread in turn: the variance of one sample is 4 * 4/3 spread^2."""
    blocks = np.array([-spread, spread, -spread, spread]) + mean
    return np.tile(blocks, (height, width, 1)).astype(np.float32)


@pytest.mark.parametrize(("most", "pilot"), [(1, 1), (15, 15), (16, 16), (64, 16), (80, 20), (100, 24), (1000, 248)])
def test_the_pilot_is_a_quarter_in_whole_blocks_or_sixteen(most: int, pilot: int) -> None:
    assert pilot_samples(most) == pilot


def test_counts_bring_the_standard_error_to_the_budget() -> None:
    # 16/3 0.1^2 / (0.01 * 1)^2 = 533.3; twice the error, a quarter of the samples
    np.testing.assert_array_equal(sample_counts(even(3, 4, 1.0, 0.1), 0.01, 1000), 534)
    np.testing.assert_array_equal(sample_counts(even(3, 4, 1.0, 0.1), 0.01, 500), 500)
    np.testing.assert_array_equal(sample_counts(even(3, 4, 1.0, 0.1), 0.02, 500), 134)
    np.testing.assert_array_equal(sample_counts(even(3, 4, 2.0, 0.2), 0.01, 1000), 534)


def test_darkness_is_measured_against_a_tenth() -> None:
    np.testing.assert_array_equal(sample_counts(even(3, 3, 0.02, 0.01), 0.01, 1000), 534)


def test_a_smooth_picture_keeps_the_pilot() -> None:
    np.testing.assert_array_equal(sample_counts(even(3, 3, 1.0, 0.0), 0.01, 64), PILOT)


def test_a_pixel_follows_its_neighbours_and_not_itself() -> None:
    blocks = even(5, 5, 1.0, 0.0)
    blocks[2, 2] = even(1, 1, 1.0, 1.0)[0, 0]
    counts = sample_counts(blocks, 0.1, 64)
    # a neighbour has it among 8: 16/3 / 8 / 0.1^2 = 66.7; its own neighbours are smooth, and so are those of the rim
    expected = np.full((5, 5), PILOT)
    expected[1:4, 1:4] = 64
    expected[2, 2] = PILOT
    np.testing.assert_array_equal(counts, expected)
    corner = even(2, 2, 1.0, 0.0)
    corner[0, 0] = even(1, 1, 1.0, 0.1)[0, 0]
    # one of three neighbours: 16/3 0.1^2 / 3 / 0.02^2 = 44.4
    np.testing.assert_array_equal(sample_counts(corner, 0.02, 64), [[PILOT, 45], [45, 45]])


def test_pixels_without_a_pilot_say_nothing() -> None:
    blocks = even(1, 3, 1.0, 0.1)
    blocks[0, 0] = np.nan
    blocks[0, 1, 1:] = np.nan  # one block has no spread
    np.testing.assert_array_equal(sample_counts(blocks, 0.02, 1000), [[1000, 248, 1000]])
    np.testing.assert_array_equal(sample_counts(even(1, 1, 1.0, 0.0), 0.01, 64), [[64]])
