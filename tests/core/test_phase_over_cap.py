"""Henyey-Greenstein over a cap: its closed forms against quadrature by rings."""

import numpy as np
import pivot_core.distributions as pd
import pytest


def by_rings(g: float, theta: float, psi: float, count: int = 20000) -> float:
    """Over a cap of half-angle psi whose axis is theta from the direction of travel."""
    t = (np.arange(count) + 0.5) / count * np.pi
    low, high = max(theta - psi, 0.0), min(theta + psi, np.pi)
    angle = (low + high) / 2 - (high - low) / 2 * np.cos(t)
    cosine = (np.cos(psi) - np.cos(angle) * np.cos(theta)) / (np.sin(angle) * np.sin(theta))
    within = 2 * np.arccos(np.clip(cosine, -1, 1))
    phase = (1 - g * g) / (4 * np.pi * (1 + g * g - 2 * g * np.cos(angle)) ** 1.5)
    return float((phase * np.sin(angle) * within * (high - low) / 2 * np.sin(t)).sum() * np.pi / count)


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
@pytest.mark.parametrize("g", [0.0, 0.3, 0.8, 0.95, 0.99, 0.999, -0.8])
def test_the_integral_over_a_cap_is_that_of_quadrature(g: float, dtype: type) -> None:
    for psi in np.radians([0.3, 1, 3, 10, 30, 100, 150]):
        for theta in np.radians([0.1, 0.5, 1, 3, 6, 10, 20, 40, 80, 120, 179]):
            axis = np.array([np.sin(theta), 0, np.cos(theta)], dtype)
            versine = dtype(2 * np.sin(psi / 2) ** 2)
            integral = pd.henyey_greenstein_cap_integral(dtype(g), np.array([0, 0, 1], dtype), axis, versine)
            assert float(integral) == pytest.approx(by_rings(g, theta, psi), rel=5.5e-3), (psi, theta)
