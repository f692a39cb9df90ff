"""Ops of arithmetic where it has no answer, or none that is plain."""

from typing import Any

import numpy as np
import pivot_core
import pytest

INFINITY, NAN = np.inf, np.nan


def run(name: str, *columns: Any, settings: Any = ()) -> np.ndarray:
    """What an op makes of its inputs, each (N,) or a number."""
    inputs = np.stack(np.broadcast_arrays(*(np.atleast_1d(np.asarray(c, np.float32)) for c in columns)), axis=-1)
    return pivot_core.run_op(name, np.ascontiguousarray(inputs), list(settings))


def test_modulo_is_exact() -> None:
    random = np.random.default_rng(7)
    a = np.concatenate([random.uniform(-1e4, 1e4, 4000), np.arange(-500, 500) * np.float32(0.1)]).astype(np.float32)
    b = np.concatenate([random.uniform(-3, 3, 4000), np.full(1000, 0.1)]).astype(np.float32)
    np.testing.assert_array_equal(run("math_modulo", a, b)[:, 0], np.fmod(a, b))


@pytest.mark.parametrize(
    ("name", "inputs", "expected"),
    [
        ("math_modulo", (7, 0), 0),
        ("math_modulo", (-7, INFINITY), -7),
        ("math_power", (0, 0), 1),
        ("math_power", (0, -1), INFINITY),
        ("math_power", (0, 2), 0),
        ("math_power", (-2, 3), -8),
        ("math_power", (-2, -2), 0.25),
        ("math_power", (-2, 0.5), 0),
        ("math_divide", (3, 0), 0),
        ("math_logarithm", (-1, 2), 0),
        ("math_logarithm", (2, 1), 0),
        ("math_compare", (INFINITY, INFINITY, 0), 1),
        ("math_compare", (1, 1 + 1e-6, 0), 0),
        ("math_arctan2", (0, 0), 0),
        ("math_sign", (NAN,), 1),
        ("math_sqrt", (-4,), 0),
        ("math_inverse_sqrt", (0,), 0),
        ("math_wrap", (5, 2, 2), 2),
        ("math_pingpong", (5, 0), 0),
        ("math_arccosine", (3,), 0),
    ],
)
def test_special_inputs(name: str, inputs: tuple[float, ...], expected: float) -> None:
    assert run(name, *inputs)[0, 0] == pytest.approx(expected, rel=1e-6)
