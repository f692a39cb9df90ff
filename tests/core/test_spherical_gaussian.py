"""Closed forms of spherical Gaussians against quadrature, and where floats end."""

import numpy as np
import pivot_core.distributions as pd
import pytest

COSINES = np.linspace(-1.0, 1.0, 41)


@pytest.mark.parametrize("sharpness", [0.01, 0.3, 0.6, 1.0, 3.0, 10.0, 100.0, 1e4, 1e7])
def test_the_irradiance_estimate_is_near_the_integral(sharpness: float) -> None:
    estimate = pd.sg_irradiance_estimate(sharpness, COSINES)
    error = np.abs(estimate - pd.sg_irradiance(sharpness, COSINES)) / pd.sg_integral(sharpness)
    assert error.max() < 0.02


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_the_irradiance_estimate_is_finite_and_not_negative(dtype: type) -> None:
    sharpness = np.concatenate([[0.0], np.logspace(-30, 12, 400)]).astype(dtype)[:, None]
    estimate = pd.sg_irradiance_estimate(sharpness, COSINES.astype(dtype))
    assert np.isfinite(estimate).all()
    assert (estimate >= -1e-6 * pd.sg_integral(sharpness)).all()


def test_the_estimate_at_the_zenith_and_the_nadir_is_exact() -> None:
    for sharpness in (1e-3, 0.1, 0.49, 0.51, 2.0, 30.0):
        for cosine in (-1.0, 1.0):
            exact = pd.sg_irradiance(sharpness, cosine)
            np.testing.assert_allclose(pd.sg_irradiance_estimate(sharpness, cosine), exact, rtol=2e-3, atol=1e-6)


def test_a_mean_direction_tells_its_gaussian() -> None:
    """The mean vector of exp(k (z - 1)) is coth k - 1 / k long."""
    sharpness = np.array([0.5, 1.0, 2.0, 5.0, 10.0, 100.0, 1000.0])
    length = 1 / np.tanh(sharpness) - 1 / sharpness
    error = pd.sg_sharpness_of_mean(length) / sharpness - 1
    assert np.abs(error).max() < 0.08
    assert np.abs(error[length > 0.9]).max() < 0.04


def test_a_mean_direction_may_be_of_any_length() -> None:
    length = np.linspace(0.0, 1.0, 101, dtype=np.float32)
    sharpness = pd.sg_sharpness_of_mean(length)
    assert np.isfinite(sharpness).all()
    assert (np.diff(sharpness) >= 0).all()
