"""The fixed rules of GGX under a cap against quadrature of D G2 / (4 cos_o) over the cap."""

import numpy as np
import pivot_core.distributions as pd
import pytest
from pivot_core.bsdf import ggx_eval

from tests.core.oracle_formulas_ggx import integrate_above

Array = np.ndarray
COUNTS = (1, 4, 8, 16)


def lights(wo: Array, alpha: float, versine: float, count: int) -> list[Array]:
    """Axes of caps around the highlight of which GGX's closed form holds."""
    rng = np.random.default_rng(1)
    axes: list[Array] = []
    while len(axes) < count:
        slope, phi = alpha * np.sqrt(rng.random() / (1 - rng.uniform(0, 0.9))), rng.uniform(0, 2 * np.pi)
        half = np.array([slope * np.cos(phi), slope * np.sin(phi), 1]) / np.hypot(1, slope)
        axis = 2 * (wo @ half) * half - wo
        if axis[2] > 0 and pd.ggx_cap_integral(wo, axis, versine, alpha, alpha)[1]:
            axes.append(axis)
    return axes


def smooth_factor(wo: Array, omega_i: Array, alpha: float) -> Array:
    """Masking-shadowing G2: 0 below the horizon."""
    half = (wo + omega_i) / np.linalg.norm(wo + omega_i, axis=-1, keepdims=True)
    ndf = 1 / (np.pi * alpha**2 * ((half / [alpha, alpha, 1]) ** 2).sum(-1) ** 2)
    return np.where(omega_i[..., 2] > 0, ggx_eval(alpha, wo, omega_i) * 4 * wo[2] / ndf, 0)


# per cent of the light reflected, L1 over the caps; about twice what was measured
@pytest.mark.parametrize(
    ("half_angle", "alpha", "theta", "bounds"),
    [
        (2, 0.02, 85, (0.5, 0.2, 0.1, 0.05)),
        (2, 0.1, 75, (0.3, 0.02, 0.01, 0.005)),
        (10, 0.1, 75, (3, 1, 0.7, 0.2)),
        (10, 0.25, 75, (5, 1, 0.7, 0.2)),
        (10, 0.5, 60, (5, 0.5, 0.3, 0.1)),
        (30, 0.25, 75, (10, 2.5, 2, 0.4)),
        (30, 1.0, 30, (20, 4, 1.5, 1)),
    ],
)
def test_rules_converge(half_angle: float, alpha: float, theta: float, bounds: tuple[float, ...]) -> None:
    psi = np.radians(half_angle)
    versine = 2 * np.sin(psi / 2) ** 2
    wo = np.array([np.sin(np.radians(theta)), 0, np.cos(np.radians(theta))])
    errors, total = np.zeros(len(COUNTS)), 0.0
    for axis in lights(wo, alpha, versine, 12):
        exact = integrate_above(axis, psi, max(alpha * wo[2], 0.02), lambda w: ggx_eval(alpha, wo, w), np.float64)
        total += exact
        for k, count in enumerate(COUNTS):
            omega_i, weight = pd.ggx_cap_points(wo, axis, versine, alpha, alpha, count)
            errors[k] += abs((weight * smooth_factor(wo, omega_i, alpha)).sum() - exact)
    assert (100 * errors / total < bounds).all(), 100 * errors / total


@pytest.mark.parametrize("count", COUNTS)
@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_weights_sum_to_the_integral(count: int, dtype: type) -> None:
    wo = np.array([[0.6, 0, 0.8], [0, 0, 1]], dtype)
    axis = np.array([-0.48, 0.6, 0.64], dtype)
    arguments = wo, axis, dtype(0.05), dtype(0.2), dtype(0.3)
    omega_i, weight = pd.ggx_cap_points(*arguments, count)
    assert omega_i.shape == (2, count, 3)
    np.testing.assert_allclose(weight.sum(-1), pd.ggx_cap_integral(*arguments)[0], rtol=8 * np.finfo(dtype).eps)
    assert (np.linalg.norm(omega_i - axis, axis=-1) ** 2 / 2 < 0.05).all()


def test_other_counts_are_refused() -> None:
    with pytest.raises(ValueError, match=r"^count "):
        pd.ggx_cap_points([0.0, 0, 1], [0.0, 0, 1], 0.1, 0.5, 0.5, 3)
