"""Grids are looked up as NumPy interpolates, and rays walk through them brick by brick."""

from __future__ import annotations

import numpy as np
import pivot_core
import pytest

from tests.core.voxels import grid, integral, interpolated, smoke

HALF_STEP = 0.5 / 65535  # of a voxel's 16 bits
SIZES = [(1, 1, 1), (1, 5, 30), (7, 8, 9), (20, 17, 33)]


def points_around(size: tuple[int, int, int], count: int = 5000) -> np.ndarray:
    """(count, 3), some on voxels and some outside."""
    rng = np.random.default_rng(2)
    points = rng.uniform(-3, np.array(size[::-1]) + 2, (count, 3))
    points[: count // 5] = np.round(points[: count // 5])
    return points.astype(np.float32)


@pytest.mark.parametrize("size", SIZES)
def test_a_lookup_is_linear_between_voxels(size: tuple[int, int, int]) -> None:
    values, points = smoke(size) + np.float32(0.1), points_around(size)
    expected = interpolated(values, points.astype(float))
    assert expected.max() > 0
    for found in (grid(values).at(points), grid(values).at_each(points)):
        np.testing.assert_allclose(found, np.repeat(expected[:, None], 3, 1), atol=(HALF_STEP + 1e-6) * values.max())


def test_colours_are_looked_up_by_channel() -> None:
    values = np.stack([smoke((9, 12, 10), seed) for seed in range(3)], -1)
    points = points_around((9, 12, 10))
    expected = np.stack([interpolated(values[..., channel], points.astype(float)) for channel in range(3)], -1)
    for found in (grid(values).at(points), grid(values).at_each(points)):
        np.testing.assert_allclose(found, expected, atol=(HALF_STEP + 1e-6) * values.max())


def test_what_is_faint_keeps_its_digits_beside_what_is_strong() -> None:
    values = np.zeros((20, 20, 20), np.float32)
    values[:4], values[16:] = 1e-6, 1e6
    found = grid(values).at(np.array([[9, 9, 2], [9, 9, 18]], np.float32))[:, 0]
    np.testing.assert_allclose(found, [1e-6, 1e6], rtol=1e-6)


def test_places_that_are_no_number_are_outside() -> None:
    points = np.array([[np.nan, 1, 1], [np.inf, 1, 1], [1, -np.inf, 1], [3e38, 1, -3e38]], np.float32)
    for found in (grid(np.ones((3, 3, 3))).at(points), grid(np.ones((3, 3, 3))).at_each(points)):
        np.testing.assert_array_equal(found, 0)


@pytest.mark.parametrize(
    ("values", "message"),
    [
        (np.full((2, 2, 2), -1.0), "finite and not negative"),
        (np.array([[[1.0, np.nan]]]), "finite and not negative"),
        (np.array([[[1.0, np.inf]]]), "finite and not negative"),
        (np.zeros((0, 2, 2)), "must not be empty"),
        (np.zeros((2, 2, 2, 2)), "shape"),
    ],
)
def test_what_is_no_grid_is_refused(values: np.ndarray, message: str) -> None:
    with pytest.raises(ValueError, match=message):
        grid(values)


def test_empty_space_takes_no_memory() -> None:
    values = np.zeros((128, 128, 128), np.float32)
    assert grid(values).memory_bytes < values.nbytes / 200
    values[40:60, 40:60, 40:60] = 1
    assert grid(values).memory_bytes < values.nbytes / 50
    assert grid(np.ones_like(values)).memory_bytes < 0.9 * values.nbytes


def rays(size: tuple[int, int, int], count: int) -> list[tuple[tuple[float, ...], tuple[float, ...], float, float]]:
    """Rays towards the grid of all scales, along axes and diagonals, from within and from outside."""
    rng = np.random.default_rng(3)
    result = []
    high = np.array(size[::-1])
    for i in range(count):
        through = rng.uniform(-1, high)
        direction = rng.normal(size=3)
        direction[rng.uniform(size=3) < (0.0, 0.4)[i % 2]] = 0
        if i % 3 == 0:  # along the borders of bricks and cells
            through = np.round(through / 4) * 4 - 1
            direction = np.sign(direction)
        direction *= 10.0 ** rng.uniform(-3, 3)
        speed = np.abs(direction).max() or 1.0
        before = rng.uniform(0, 60) / speed if i % 5 else 0.0
        near = rng.uniform(0, 10) / speed if i % 4 == 0 else 0.0
        far = near + rng.uniform(0, 90) / speed if i % 2 else np.inf
        result.append((tuple(through - before * direction), tuple(direction), near, far))
    return result


@pytest.mark.parametrize("size", SIZES)
def test_a_walk_covers_the_grid_once(size: tuple[int, int, int]) -> None:
    """Without empty bricks: from where the ray enters the box, or starts, to where it leaves, or ends."""
    voxels, hits = grid(np.ones(size)), 0
    high = np.array(size[::-1], float)
    for origin, direction, near, far in rays(size, 400):
        cells = np.array(voxels.cells(origin, direction, near, far)).reshape(-1, 3)
        o, d = np.array(origin, np.float32).astype(float), np.array(direction, np.float32).astype(float)
        with np.errstate(divide="ignore", invalid="ignore"):
            slabs = np.where(
                d == 0, np.where((o >= -1) & (o <= high), [[-np.inf], [np.inf]], np.nan), [(-1 - o) / d, (high - o) / d]
            )
        enter, leave = max(near, np.nan_to_num(slabs.min(0), nan=np.inf).max()), min(far, slabs.max(0).min())
        scale = np.abs(o).max() / max(np.abs(d).max(), 1e-30)
        if not leave - enter > 1e-5 * scale:  # a miss, but for rounding
            assert len(cells) == 0 or cells[-1, 1] - cells[0, 0] <= 1e-4 * scale
            continue
        hits += 1
        np.testing.assert_allclose([cells[0, 0], cells[-1, 1]], [enter, leave], rtol=1e-5, atol=1e-5 * scale)
        np.testing.assert_array_equal(cells[1:, 0], cells[:-1, 1])
        assert np.all(cells[:, 1] > cells[:, 0])
        assert len(cells) <= sum((n + 8) // 8 for n in size)
    assert hits > 100


@pytest.mark.parametrize("size", [(20, 17, 33), (40, 40, 40)])
def test_no_value_is_above_its_majorant(size: tuple[int, int, int]) -> None:
    values = smoke(size) ** 4
    values[:, :, 16:26] = 0
    voxels = grid(values)
    rng = np.random.default_rng(4)
    for origin, direction, near, far in rays(size, 200):
        far = min(far, 1e3 / max(np.abs(direction).max(), 1e-3))
        t = np.sort(rng.uniform(near, far, 2000)) if far > near else np.array([near])
        found = voxels.at((np.array(origin) + t[:, None] * direction).astype(np.float32))[:, 0]
        bound = np.zeros_like(t)
        for low, high, majorant in voxels.cells(origin, direction, near, far):
            # Rounding of places: a little beside, the next brick's holds.
            beside = 1e-5 * (high - low) + 1e-5 * abs(high)
            here = (t >= low - beside) & (t <= high + beside)
            bound[here] = np.maximum(bound[here], majorant)
        assert np.all(found <= np.maximum(bound, 1e-4 * voxels.most))
    assert voxels.most == pytest.approx(values.max(), rel=1e-5)


def test_a_majorant_is_the_largest_voxel_of_its_brick() -> None:
    values = smoke((20, 17, 33)) ** 4
    padded = np.pad(values, 1)
    for origin, direction, near, far in rays(values.shape, 100):
        for low, high, majorant in grid(values).cells(origin, direction, near, min(far, 1e6)):
            middle = np.array(origin) + 0.5 * (low + high) * np.array(direction) + 1
            x, y, z = (middle // 8 * 8).astype(int)
            if high - low > 1e-3 * high and np.all(np.abs(middle - np.round(middle / 8) * 8) > 1e-2):
                assert majorant == pytest.approx(padded[z : z + 9, y : y + 9, x : x + 9].max(), rel=1e-5)


def test_bricks_of_nothing_are_left_out() -> None:
    values = np.zeros((8, 8, 64), np.float32)
    values[:, :, 40:44] = 2
    cells = grid(values).cells((-10, 3, 3), (2, 0, 0), 0, np.inf)
    assert len(cells) == 1
    np.testing.assert_allclose(cells[0], [(39 + 10) / 2, (47 + 10) / 2, 2], rtol=1e-5)


@pytest.mark.parametrize(
    ("origin", "direction", "near", "far"),
    [
        ((3, 3, 3), (0, 0, 0), 0, np.inf),
        ((3, 3, 3), (np.nan, 1, 0), 0, np.inf),
        ((3, np.nan, 3), (1, 0, 0), 0, np.inf),
        ((3, 3, 3), (1, 0, 0), np.nan, np.inf),
        ((3, 3, 3), (1, 0, 0), 5, 4),
        ((3, 3, 3), (np.inf, 0, 0), 0, 1),
        ((3, 3, 3), (1e-44, 0, 0), 0, np.inf),
        ((3, 30, 3), (1, 0, 0), 0, np.inf),
        ((-30, 3, 3), (-1, 0, 0), 0, np.inf),
    ],
)
def test_a_ray_without_a_way_through_visits_nothing(
    origin: tuple[float, ...], direction: tuple[float, ...], near: float, far: float
) -> None:
    assert grid(np.ones((7, 7, 7))).cells(origin, direction, near, far) == []


def test_a_ray_that_stands_still_stays_in_its_brick() -> None:
    cells = grid(np.ones((20, 20, 20))).cells((3, 3, 3), (0, 0, 0), 1, 4)
    np.testing.assert_allclose(cells, [(1, 4, 1)], rtol=1e-5)


def test_the_integral_of_the_density_is_exact() -> None:
    values = smoke((20, 17, 33))
    voxels: pivot_core.VoxelGrid = grid(values)
    for origin, direction, near, far in rays(values.shape, 30):
        far = min(far, 1e3 / max(np.abs(direction).max(), 1e-3))
        expected = integral(values, np.array(origin), np.array(direction), near, far)
        found = voxels.density_integral(origin, direction, near, far)
        width = 30 * float(values.max()) / max(np.linalg.norm(direction), 1e-3)
        assert found == pytest.approx(expected, rel=2e-4, abs=1e-4 * width)
