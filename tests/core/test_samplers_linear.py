"""chi^2 tests of the samplers of LTSDs and phase functions against their pdfs."""

from collections.abc import Callable

import numpy as np
import pivot_core.distributions as pd
import pytest

from tests.core.chi_squared import chi_squared_p, random_squares

COUNT = 60_000
SIGNIFICANCE = 1e-4
Z = np.array([0.0, 0.0, 1.0])
EVEN_RINGS = np.linspace(0, 2, 33)
BASES = ("uniform_sphere", "uniform_hemisphere", "clamped_cosine", "squared_clamped_cosine")
MATRICES = {
    "identity": np.eye(3),
    "narrow": np.array([[0.3, 0.0, 0.2], [0.0, 0.25, 0.0], [-0.1, 0.0, 1.0]]),
    "general": np.array([[1.2, 0.1, -0.4], [0.05, 0.7, 0.2], [0.3, -0.2, 0.9]]),
    "mirrored": np.array([[1.2, 0.1, -0.4], [0.05, -0.7, 0.2], [0.3, -0.2, 0.9]]),
}


@pytest.mark.parametrize("base", BASES)
@pytest.mark.parametrize("matrix", MATRICES)
def test_ltsd(base: str, matrix: str) -> None:
    m = MATRICES[matrix]
    # rings around what M makes of the horizon's pole, so that the edge of a hemisphere runs along a cell
    axis = np.linalg.inv(m).T @ Z
    samples = pd.ltsd_sample(base, m, random_squares(COUNT))
    p = chi_squared_p(samples, lambda omega: pd.ltsd_eval(base, m, omega), axis / np.linalg.norm(axis), EVEN_RINGS)
    assert p > SIGNIFICANCE


PHASES: dict[str, tuple[Callable, Callable]] = {
    "henyey_greenstein": (pd.henyey_greenstein_sample_cosine, pd.henyey_greenstein_eval),
    "pivot_phase": (pd.pivot_phase_sample_cosine, pd.pivot_phase_eval),
}


@pytest.mark.parametrize("phase", PHASES)
@pytest.mark.parametrize("g", [-0.9, -0.3, 0.0, 1e-6, 0.5, 0.95])
def test_phase_function(phase: str, g: float) -> None:
    sample, density = PHASES[phase]
    u = random_squares(COUNT)
    mu, sine = sample(g, u[:, 0])
    phi = 2 * np.pi * u[:, 1]
    samples = np.stack([sine * np.cos(phi), sine * np.sin(phi), mu], -1)
    rings = 2 * np.linspace(0, 1, 33) ** 2
    axis = Z if g >= 0 else -Z
    assert chi_squared_p(samples, lambda omega: density(g, omega[..., 2].clip(-1, 1)), axis, rings) > SIGNIFICANCE


@pytest.mark.parametrize("g_p", [-0.8, 0.0, 0.6, 0.9])
@pytest.mark.parametrize("versine", [0.02, 0.5, 1.4])
def test_pivot_phase_in_a_light(g_p: float, versine: float) -> None:
    omega_o = np.array([0.48, 0.6, 0.64])
    light = np.array([0.6, 0.0, 0.8])
    samples = pd.pivot_phase_cap_sample(g_p, omega_o, light, versine, random_squares(COUNT))

    def density(omega: np.ndarray) -> np.ndarray:
        return pd.pivot_phase_cap_pdf(g_p, omega_o, light, versine, omega)

    rings = np.append(np.linspace(0, versine, 25), 2.0)
    assert chi_squared_p(samples, density, light, rings) > SIGNIFICANCE
    outside = ((samples @ light) < 1 - versine * (1 + 1e-9)).sum()
    assert outside == 0


@pytest.mark.parametrize("g_p", [-0.8, 0.6, 0.97])
def test_pivot_phase_pdf_is_the_phase_function_over_its_integral(g_p: float) -> None:
    omega_o, light, versine = np.array([0.0, 0.6, 0.8]), np.array([0.6, 0.0, 0.8]), 0.7
    samples = pd.pivot_phase_cap_sample(g_p, omega_o, light, versine, random_squares(100))
    phase = pd.pivot_phase_eval(g_p, np.clip(samples @ omega_o, -1, 1))
    total = pd.pivot_phase_cap_integral(g_p, omega_o, light, versine)
    pdf = pd.pivot_phase_cap_pdf(g_p, omega_o, light, versine, samples)
    np.testing.assert_allclose(pdf, phase / total, rtol=1e-9)
