"""The sampler: Sobol's points and Owen's scrambling of them."""

import numpy as np
import pivot_core.sampling as ps
import pytest
from scipy.stats import chi2, qmc

RANDOM = np.random.default_rng(1)
SIGNIFICANCE = 1e-4
GRID = 16  # cells a side


def words(count: int) -> np.ndarray:
    return RANDOM.integers(0, 1 << 32, count, dtype=np.uint32)


def sequence(pixel_seed: int, dimension: int, first: int, count: int) -> np.ndarray:
    """Successive points of one pixel, (count, 2)."""
    samples = np.arange(first, first + count, dtype=np.uint32)
    return ps.points(np.full(count, pixel_seed, np.uint32), samples, dimension)


def cell_counts(points: np.ndarray, columns: int, rows: int) -> np.ndarray:
    """How many points each cell of the unit square holds, (columns, rows)."""
    counts, _, _ = np.histogram2d(*points.T, bins=[columns, rows], range=[[0, 1], [0, 1]])
    return counts


def dependence(a: np.ndarray, b: np.ndarray) -> float:
    """chi^2 of pairs of numbers (n,) over a grid of the unit square."""
    expected = len(a) / GRID**2
    counts = cell_counts(np.stack([a, b], 1).astype(np.float64), GRID, GRID)
    return float(((counts - expected) ** 2 / expected).sum())


def independence_p(a: np.ndarray, b: np.ndarray) -> float:
    return float(chi2.sf(dependence(a, b), GRID**2 - 1))


def test_the_second_dimension_is_sobols() -> None:
    count = 1024
    index = np.arange(count, dtype=np.uint32)
    first = np.array([int(f"{i:010b}"[::-1], 2) for i in index]) / count
    ours = np.stack([first, ps.to_unit(ps.sobol_second(index))], 1)
    theirs = qmc.Sobol(2, scramble=False).random(count)  # the same points, in the order of a Gray code
    np.testing.assert_array_equal(ours[np.lexsort(ours.T)], theirs[np.lexsort(theirs.T)])


@pytest.mark.parametrize("log2_count", range(1, 11))
def test_every_elementary_interval_holds_one_point(log2_count: int) -> None:
    """Any 2^m successive points from a multiple of 2^m on: one in each cell of each grid of 2^m equal cells."""
    count = 1 << log2_count
    for pixel_seed, dimension, block in ((0, 0, 0), (1, 0, 3), (12345, 7, 0), (0xFFFFFFFF, 40, 1000)):
        points = sequence(pixel_seed, dimension, block * count, count)
        for log2_columns in range(log2_count + 1):
            counts = cell_counts(points, 1 << log2_columns, 1 << (log2_count - log2_columns))
            np.testing.assert_array_equal(counts, 1)


@pytest.mark.parametrize("kept_bits", [1, 2, 5, 12, 24, 31])
def test_owen_scrambling_is_nested(kept_bits: int) -> None:
    """Two fractions that share their first bits share them after it, and the next bit differs if it did before."""
    a, seed = words(2000), words(2000)
    next_bit = np.uint32(1 << (31 - kept_bits))
    b = (a ^ next_bit) ^ (words(2000) & (next_bit - np.uint32(1)))
    difference = ps.owen_scramble(a, seed) ^ ps.owen_scramble(b, seed)
    assert (difference >> np.uint32(31 - kept_bits) == 1).all()


def test_owen_scrambling_flips_each_bit_half_of_the_time() -> None:
    """Over the seeds; and in the bits below the first, over what stands before them too."""
    count, bits = 20_000, np.arange(32, dtype=np.uint32)

    def flipped_share(fraction: np.ndarray, seed: np.ndarray) -> np.ndarray:
        flips = ps.owen_scramble(fraction, seed) ^ fraction
        return ((flips[:, None] >> bits) & 1).mean(0)

    noise = 5 * np.sqrt(0.25 / count)
    assert np.abs(flipped_share(np.full(count, 0x9E3779B9, np.uint32), words(count)) - 0.5).max() < noise
    over_fractions = flipped_share(words(count), np.full(count, 12345, np.uint32))
    assert np.abs(over_fractions[:20] - 0.5).max() < noise  # a bit with few above it has few fractions to depend on


@pytest.mark.parametrize(("one", "other"), [(0, 1), (1, 2), (3, 14), (0, 64)])
@pytest.mark.parametrize("axes", [(0, 0), (0, 1), (1, 0), (1, 1)])
def test_dimensions_are_independent(one: int, other: int, axes: tuple[int, int]) -> None:
    """Over the pixels; and within one, but that 16 successive points stand in 16 columns and 16 rows. So of a cell's
    count, expected n / 256, the variance is n 15/256^2 * 16 instead of n 255/256^2: chi^2 is 240 in the mean."""
    pixels, sample = np.arange(40_000, dtype=np.uint32), np.full(40_000, 17, np.uint32)
    a, b = (ps.points(pixels, sample, d)[:, axis] for d, axis in zip((one, other), axes, strict=True))
    assert independence_p(a, b) > SIGNIFICANCE
    within = [
        dependence(sequence(pixel, one, 0, 1024)[:, axes[0]], sequence(pixel, other, 0, 1024)[:, axes[1]])
        for pixel in range(200)
    ]
    assert np.mean(within) == pytest.approx(240, rel=0.06)


def test_pixels_are_independent() -> None:
    even, sample = np.arange(0, 80_000, 2, dtype=np.uint32), np.full(40_000, 17, np.uint32)
    a, b = ps.points(even, sample, 3), ps.points(even + np.uint32(1), sample, 3)
    for axis in range(2):
        assert independence_p(a[:, axis], b[:, axis]) > SIGNIFICANCE


def test_first_samples_of_many_pixels_fill_the_square() -> None:
    points = ps.points(np.arange(20_000, dtype=np.uint32), np.zeros(20_000, np.uint32), 5)
    assert independence_p(*points.T) > SIGNIFICANCE


def test_batches_are_the_single_points() -> None:
    for count in (1, 7, 8, 9, 1001):
        pixel_seed, sample = words(count), words(count)
        for dimension in (0, 5, 1 << 20):
            one_by_one = ps.points(pixel_seed, sample, dimension, batches=False)
            np.testing.assert_array_equal(ps.points(pixel_seed, sample, dimension), one_by_one)


def test_numbers_are_below_one() -> None:
    largest = ps.to_unit(np.uint32(0xFFFFFFFF))
    assert np.float32(largest) < np.float32(1)
    np.testing.assert_array_equal(ps.to_unit(np.array([0, 1 << 31, 3 << 30], np.uint32)), [0, 0.5, 0.75])


def test_unequal_shapes_are_refused() -> None:
    with pytest.raises(ValueError, match="pixel_seed and sample must have one shape"):
        ps.points(np.zeros(3, np.uint32), np.zeros(4, np.uint32), 0)


@pytest.mark.parametrize(("log2_samples", "log2_side"), [(0, 3), (2, 2), (5, 1), (16, 0)])
def test_neighbouring_pixels_complete_each_other(log2_samples: int, log2_side: int) -> None:
    """A square's samples fill every grid of as many equal cells, wherever the square is."""
    side, samples = 1 << log2_side, 1 << log2_samples
    log2_count = log2_samples + 2 * log2_side
    for corner_x, corner_y, seed, dimension in ((0, 0, 1, 0), (13, 250, 2, 5), (70, 1000, 3, 8)):
        y, x, sample = np.indices((side, side, samples), dtype=np.uint32).reshape(3, -1)
        x, y = x + np.uint32(corner_x * side), y + np.uint32(corner_y * side)
        points = ps.points(*ps.pixel_samplers(x, y, seed, log2_samples, sample), dimension)
        for log2_columns in range(log2_count + 1):
            counts = cell_counts(points, 1 << log2_columns, 1 << (log2_count - log2_columns))
            np.testing.assert_array_equal(counts, 1)


def test_no_two_pixels_of_a_frame_have_the_same_sample() -> None:
    y, x, sample = np.indices((600, 600, 2), dtype=np.uint32).reshape(3, -1)
    pairs = np.stack(ps.pixel_samplers(x, y, 7, 1, sample), 1)
    assert len(np.unique(pairs, axis=0)) == len(pairs)
