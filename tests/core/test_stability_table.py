"""The stability table's own rows: finite, within their bound, and by a method that keeps the budget.

The sweeps behind its functions are asserted one by one in test_stability.py and test_stability_linear.py.
"""

from __future__ import annotations

import numpy as np
import pivot_core.distributions as pd
import pytest
from pivot_core.shading import METHODS

from tests.core import printed_forms
from tests.core.stability_table import BUDGET_PERCENT, Row, function_rows, gaussian_rows, light_rows, render_rows

AXIS, UP, SIDE = np.array([0.48, 0.6, 0.64]), np.array([0.0, 0.0, 1.0]), np.array([0.6, -0.8, 0.0])


@pytest.fixture(scope="module")
def functions() -> list[Row]:
    return list(function_rows())


def test_where_a_printed_form_fails_ours_holds(functions: list[Row]) -> None:
    assert len(functions) > 240
    failing = [row for row in functions if row.printed_error is not None and not row.printed_error < 1e-2]
    assert len({row.name.split(",")[0] for row in failing}) >= 10
    assert all(row.error <= row.bound for row in failing)
    assert sum(row.printed_error == np.inf for row in failing) > 10


@pytest.mark.parametrize(
    ("function", "arguments"),
    [
        (pd.cap_solid_angle, (0.3,)),
        (pd.pivot_transform, (UP, AXIS, 0.4)),
        (pd.pivot_jacobian, (UP, AXIS, 0.4)),
        (pd.pivot_transform_cap, (UP, 0.1, AXIS, 0.6)),
        (pd.sptd_uniform_eval, (UP, AXIS, 0.4)),
        (pd.sptd_uniform_integral, (UP, 0.1, AXIS, 0.6)),
        (pd.sptd_uniform_integral2, (AXIS, 0.3, UP, 0.2, SIDE, 0.6)),
        (pd.cap_intersection, (AXIS, 0.3, UP, 0.3)),
        (pd.cap_intersection_at, (0.3, 0.4, 1.0)),
        (pd.henyey_greenstein_eval, (0.5, 0.3)),
        (pd.pivot_phase_eval, (0.5, 0.3)),
        (pd.pivot_phase_like, (1e-4,)),
        (pd.ltsd_eval, ("clamped_cosine", np.diag([0.5, 0.7, 1.0]), AXIS)),
        (pd.sg_ggx_lobe, (0.3, AXIS)),
        (pd.orthographic_pixel_solid_angle, (0.1, 0.5, 0.2, 0.6)),
        (pd.projected_cap_density_bound, (np.array([0.8, 0.0, -0.6]), 0.5, UP)),
    ],
    ids=lambda value: getattr(value, "__name__", ""),
)
def test_printed_forms_are_right_where_nothing_is_hard(function: object, arguments: tuple) -> None:
    """What the table shows of them is rounding and gaps, not a slip of ours."""
    form = printed_forms.printed_form(function)
    for printed, ours in zip(np.ravel(flat(form(*arguments))), np.ravel(flat(function(*arguments))), strict=True):
        assert printed == pytest.approx(ours, rel=2e-5, abs=1e-6)


def flat(value: object) -> np.ndarray:
    return np.concatenate([np.ravel(part) for part in value]) if isinstance(value, tuple) else np.ravel(value)


def test_ggx_under_lights_keeps_the_budget() -> None:
    rows = list(light_rows())
    assert all(row.error <= 0.01 * BUDGET_PERCENT for row in rows), rows
    assert {row.method for row in rows} <= set(METHODS)
    assert all(row.method[:2] in ("PO", "SL") for row in rows)


def test_ggx_under_gaussians_is_within_what_is_stated() -> None:
    rows = list(gaussian_rows())
    assert [f"{row.limit}: {row.error:.2g}" for row in rows if not row.error <= row.bound] == []
    assert {row.method for row in rows} == {"CAPS", "POINTS"}
    assert np.mean([row.error for row in rows]) < 0.1


def test_whole_renders_hold_in_all_integrators() -> None:
    rows = list(render_rows())
    assert {row.name for row in rows} == {"analytic", "Monte Carlo", "virtual lights"}
    assert [f"{row.name}, {row.limit}: {row.error:.2g}" for row in rows if not row.error <= row.bound] == []
