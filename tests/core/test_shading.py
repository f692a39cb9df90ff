"""pivot_core.shading: the analytic integrator's own path, against the oracles and brute force."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from pivot_core.shading import METHODS, ggx_sphere_light

from tests.core.ggx_reference import LEAST_VALUE, ggx_under_cap, random_case

ORACLES = [
    case
    for case in json.loads((Path(__file__).parent / "oracles.json").read_text())["cases"]
    if case["formula"] == "ggx_sphere_light"
]


def relative_error(value: Any, exact: Any) -> Any:
    return np.abs(value - exact) / np.maximum(exact, LEAST_VALUE)


@pytest.mark.parametrize("budget", [0.5, 1.0, 2.0, 5.0])
def test_oracles_within_the_budget(budget: float) -> None:
    inputs = [case["inputs"] for case in ORACLES]
    value, predicted, _ = ggx_sphere_light(
        [i["alpha"] for i in inputs],
        [i["wo"] for i in inputs],
        [np.divide(i["cap_dir"], np.linalg.norm(i["cap_dir"])) for i in inputs],
        [i["psi"] for i in inputs],
        budget,
    )
    exact = np.array([case["expected"]["Lo_over_L"] for case in ORACLES])
    assert np.all(relative_error(value, exact) < 0.01 * budget)
    assert np.all(predicted <= 0.01 * budget)


def test_random_lights_within_the_budget() -> None:
    rng = np.random.default_rng(5)
    cases = [random_case(rng) for _ in range(150)]
    exact = np.array([ggx_under_cap(*case, resolution=400) for case in cases])
    alpha, wo, axis, half_angle = (np.array(column) for column in zip(*cases, strict=True))
    for budget in (1.0, 2.0, 5.0):
        value, predicted, method = ggx_sphere_light(alpha, wo, axis, half_angle, budget)
        error = relative_error(value, exact)
        assert np.all(error < 0.02 * budget), (budget, np.argmax(error))
        assert np.mean(error) < 0.003 * budget
        assert np.mean(error <= predicted + 2e-4) >= 0.95  # the reference's own error
        assert np.all(predicted <= 0.01 * budget * 1.0001)
        assert {METHODS[i] for i in np.unique(method)} <= {name for name in METHODS if name[:2] in ("NO", "PO", "SL")}


def test_a_smaller_budget_takes_more_points() -> None:
    rng = np.random.default_rng(6)
    alpha, wo, axis, half_angle = (
        np.array(column) for column in zip(*(random_case(rng) for _ in range(2000)), strict=True)
    )
    share_of_one_point = [
        np.mean(ggx_sphere_light(alpha, wo, axis, half_angle, budget)[2] == METHODS.index("POINTS_1"))
        for budget in (10.0, 1.0, 0.1)
    ]
    assert share_of_one_point[0] > share_of_one_point[1] > share_of_one_point[2]


def test_shapes_broadcast_and_lanes_are_independent() -> None:
    rng = np.random.default_rng(7)
    alpha, wo, axis, half_angle = (
        np.array(column) for column in zip(*(random_case(rng) for _ in range(19)), strict=True)
    )
    together = ggx_sphere_light(alpha, wo, axis, half_angle, 1.0)
    for i in range(19):
        alone = ggx_sphere_light(alpha[i], wo[i], axis[i], half_angle[i], 1.0)
        assert [np.shape(a) for a in alone] == [(), (), ()]
        assert [a == t[i] for a, t in zip(alone, together, strict=True)] == [True] * 3
    value, predicted, method = ggx_sphere_light(0.3, [0, 0, 1], axis[:, None], half_angle[None, :5], 1.0)
    assert value.shape == predicted.shape == method.shape == (19, 5)


def test_from_inside_the_light_all_is_albedo() -> None:
    """A light that covers the hemisphere reflects the lobe's albedo, below it nothing."""
    from pivot_core.tables import ggx_albedo

    wo = np.array([0.6, 0.0, 0.8])
    value, _, _ = ggx_sphere_light(0.4, wo, [0, 0, 1], np.pi / 2, 0.5)
    assert value == pytest.approx(ggx_albedo(0.4, 0.8), rel=3e-3)
    value, error, method = ggx_sphere_light(0.4, wo, [0, 0, -1], 1.5, 0.5)
    assert (value, error, METHODS[method]) == (0, 0, "NONE")


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ((0.0, [0, 0, 1], [0, 0, 1], 0.1, 1.0), "alpha"),
        ((0.5, [0, 0, -1], [0, 0, 1], 0.1, 1.0), "wo must be above"),
        ((0.5, [0, 0, 2], [0, 0, 1], 0.1, 1.0), "wo must be of unit length"),
        ((0.5, [0, 0, 1], [0, 0, 1], 2.0, 1.0), "half_angle"),
        ((0.5, [0, 0, 1], [0, 0, 1], 0.1, 0.0), "error_budget"),
        ((0.5, [0, 0, 1], [0, 0, np.nan], 0.1, 1.0), "cap_axis must be finite"),
        ((np.full(3, 0.5), np.tile([0.0, 0, 1], (2, 1)), [0, 0, 1], 0.1, 1.0), "broadcast"),
    ],
)
def test_bad_input_names_the_argument(arguments: tuple[Any, ...], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        ggx_sphere_light(*arguments)
