"""Adaptive sample counts: known pilots, known counts."""

import numpy as np
import pytest
from numpy.typing import NDArray
from pivot_core.film import sample_counts

HALF = 8  # samples of half a pilot
Counts = tuple[NDArray[np.uint32], NDArray[np.float32]]


def even(height: int, width: int, mean: float, spread: float) -> NDArray[np.float32]:
    """A pilot's halves (2, height, width, HALF): blocks of two samples are mean +- spread in turn, so that the variance
    of a sample is 2 * 4/3 spread^2."""
    blocks = np.array([-spread, spread, -spread, spread]) + mean
    return np.tile(np.repeat(blocks, 2), (2, height, width, 1)).astype(np.float32)


def counts_of(
    samples: NDArray[np.float32], relative_error: float, max_samples: int = 1000, kept: float = 1.0
) -> Counts:
    """kept: what pictures of half the pilot have of the variance that their samples tell."""
    count = samples.shape[-1]
    blocks = samples.reshape(*samples.shape[:-1], count // 2, 2).mean(-1)
    variance = 2 * blocks.var(-1, ddof=1) / max(np.median(samples), 0.1) ** 2
    return sample_counts(samples, 1, kept * variance.mean() / count, relative_error, max_samples)


def test_counts_make_the_error_of_the_picture() -> None:
    # 8/3 0.1^2 / 0.01^2 = 266.7
    further, half_weight = counts_of(even(3, 4, 1.0, 0.1), 0.01)
    np.testing.assert_allclose(further, 266.7 - 2 * HALF, atol=1.5)
    np.testing.assert_allclose(half_weight, HALF / 266.7, rtol=1e-2)
    # where it is as bright again, and differs as much more
    np.testing.assert_array_equal(counts_of(even(3, 4, 2.0, 0.2), 0.01)[0], further)
    np.testing.assert_allclose(counts_of(even(3, 4, 1.0, 0.1), 0.02)[0], 266.7 / 4 - 2 * HALF, atol=1.5)
    np.testing.assert_array_equal(counts_of(even(3, 4, 1.0, 0.1), 0.01, 100)[0], 100 - 2 * HALF)


def test_what_a_picture_has_of_the_samples_variance_counts() -> None:
    further, _ = counts_of(even(3, 4, 1.0, 0.1), 0.02, kept=0.5)
    np.testing.assert_allclose(further, 266.7 / 8 - 2 * HALF, atol=1.5)


def test_darkness_is_measured_against_a_tenth() -> None:
    np.testing.assert_allclose(counts_of(even(3, 3, 0.02, 0.01), 0.01)[0], 266.7 - 2 * HALF, atol=1.5)


def test_a_smooth_picture_keeps_the_pilot() -> None:
    further, half_weight = counts_of(even(3, 3, 1.0, 0.0), 0.01)
    np.testing.assert_array_equal(further, 0)
    np.testing.assert_array_equal(half_weight, 0.5)


def test_samples_are_in_proportion_to_the_deviation() -> None:
    """Two halves of a picture, one three times as noisy, and what lies between them."""
    samples = np.concatenate([even(12, 12, 1.0, 0.3), even(12, 12, 1.0, 0.1)], 2)
    further, _ = counts_of(samples, 0.04, 10_000)
    total = further + 2 * HALF
    np.testing.assert_allclose(total[:, :10] / total[:, 14:], 3.0, rtol=0.05)
    error = np.mean(np.where(np.arange(24) < 12, 0.3**2, 0.1**2) * 8 / 3 / total)
    assert 0.25 * 0.04**2 < error < 1.05 * 0.04**2


def test_a_pixel_has_a_quarter_of_its_neighbours_samples() -> None:
    samples = even(16, 16, 1.0, 0.0)
    samples[:, 4, 4] = even(1, 1, 1.0, 0.5)[:, 0, 0]
    further, _ = counts_of(samples, 0.005)
    assert further[3:6, 3:6].min() > 4 * further[12:, 12:].max()  # those that see it beside them, and those far away
    np.testing.assert_array_equal(further[2, 2:7], (further[4, 4] + 3) // 4)


@pytest.mark.parametrize("half", [0, 1])
def test_no_half_decides_its_own_weight(half: int) -> None:
    """But by one number that is the whole picture's."""
    rng = np.random.default_rng(3)
    samples = rng.uniform(0.5, 1.5, (2, 48, 48, HALF)).astype(np.float32)
    other = samples.copy()
    other[half, 20:24, 20:24] = 3 * other[half, 20:24, 20:24] - 2
    before, after = counts_of(samples, 0.03)[1], counts_of(other, 0.03)[1]
    np.testing.assert_allclose(after[half], before[half], rtol=5e-2)
    assert (np.abs(after[1 - half] / before[1 - half] - 1) > 0.1).any()


def test_no_pixel_stops_because_its_pilot_saw_nothing() -> None:
    """A bright event in one pixel of a thousand, anywhere: what most pixels have not met is theirs all the same."""
    rng = np.random.default_rng(5)
    samples = np.full((2, 64, 64, HALF), 0.2, np.float32)
    samples[rng.uniform(size=samples.shape) < 1e-3] = 15.0
    further, half_weight = counts_of(samples, 0.01)
    saw_nothing = (samples == np.float32(0.2)).all((0, 3))
    assert saw_nothing.mean() > 0.98
    # The events' variance is 15^2 / 1000, five times the radiance squared: every pixel gets all there are.
    np.testing.assert_array_equal(further, 1000 - 2 * HALF)
    assert np.mean(half_weight < 0.02) > 0.98
