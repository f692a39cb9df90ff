"""Ranges and tables of values."""

import numpy as np
import pivot_core
import pytest

VALUES = np.array((0.5, -1.0, 3.0, 2.0, 2.5), np.float32)
FIRST, LAST = -1.0, 3.0  # where the values are: at -1, 0, 1, 2, 3
PLACES = np.linspace(-4, 6, 401, dtype=np.float32)


def table(places: np.ndarray, interpolates: bool, extrapolates: bool) -> np.ndarray:
    settings = [FIRST, LAST, float(interpolates), float(extrapolates), *VALUES.tolist()]
    return pivot_core.run_op("table", places.astype(np.float32)[:, None], settings)[:, 0]


def test_a_table_is_linear_between_its_values() -> None:
    knots = np.linspace(FIRST, LAST, len(VALUES))
    np.testing.assert_allclose(table(PLACES, True, False), np.interp(PLACES, knots, VALUES), atol=1e-5)


def test_a_table_has_the_value_before() -> None:
    places = PLACES + np.float32(0.001)  # none where it jumps
    before = np.clip(np.floor(places - FIRST), 0, len(VALUES) - 1).astype(int)
    np.testing.assert_array_equal(table(places, False, False), VALUES[before])


def test_a_table_goes_on_in_a_straight_line() -> None:
    got = table(np.array((-3, 5)), True, True)
    np.testing.assert_allclose(got, (0.5 + 2 * 1.5, 2.5 + 2 * 0.5), rtol=1e-6)


def test_a_table_has_its_first_value_for_no_number() -> None:
    np.testing.assert_array_equal(table(np.array((np.nan,)), True, True), VALUES[:1])


@pytest.mark.parametrize(("kind", "expected"), [("map_range", 0), ("map_range_vector", 5)])
def test_a_range_of_no_width(kind: str, expected: float) -> None:
    inputs = np.array([[2, 1, 1, 5, 7, 4]], np.float32)
    for shape in ("linear", "stepped", "smoothstep", "smootherstep"):
        assert pivot_core.run_op(f"{kind}_{shape}", inputs)[0, 0] == expected
