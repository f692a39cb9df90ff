"""Phase functions, for test_oracles.py."""

from typing import Any

import numpy as np
import pivot_core.distributions as pd

from tests.core.oracle_formulas_caps import rings_across_rim, versine


def pivot_phase(inputs: dict[str, Any], dtype: type) -> dict[str, Any]:
    return {
        "value": pd.pivot_phase_eval(inputs["g_p"], inputs["mu"]),
        "cdf": pd.pivot_phase_cdf(inputs["g_p"], inputs["mu"]),
        "mean_cosine": pd.pivot_phase_mean_cosine(inputs["g_p"]),
    }


def hg_phase(inputs: dict[str, Any], dtype: type) -> dict[str, Any]:
    return {
        "value": pd.henyey_greenstein_eval(inputs["g"], inputs["mu"]),
        "cdf": pd.henyey_greenstein_cdf(inputs["g"], inputs["mu"]),
        "mean_cosine": pd.henyey_greenstein_mean_cosine(inputs["g"]),
    }


def hg_fit_Q(inputs: dict[str, Any], dtype: type) -> dict[str, Any]:
    return {
        "Q": pd.pivot_phase_like(inputs["g"]),
        "mean_cosine_matched_gp": pd.pivot_phase_of_mean_cosine(inputs["g"]),
    }


def henyey_greenstein_over_cap(g: Any, omega_o: Any, axis: Any, psi: Any) -> Any:
    """By rings around omega_o: those that the cap's rim cuts and the whole ones ahead by Gauss-Legendre, for the cdf
    has none of a tiny cap's bits there, and the whole ones behind by the cdf."""
    axis, omega_o = np.asarray(axis, np.float64), np.asarray(omega_o, np.float64)
    distance, psi = np.arctan2(np.linalg.norm(np.cross(omega_o, axis)), omega_o @ axis), float(psi)
    t, weight = np.polynomial.legendre.leggauss(200)
    t, weight = np.pi / 2 * (1 + t), np.pi / 2 * weight
    theta, slope, reach = rings_across_rim(distance, psi, t)
    arcs = 2 * reach * np.sin(theta)
    integral = pd.henyey_greenstein_eval(g, np.cos(theta).astype(g.dtype)) @ (arcs * weight * slope)
    if psi > distance:
        theta, slope = (psi - distance) * np.sin(t / 2) ** 2, (psi - distance) / 2 * np.sin(t)
        rings = 2 * np.pi * np.sin(theta)
        integral += pd.henyey_greenstein_eval(g, np.cos(theta).astype(g.dtype)) @ (rings * weight * slope)
    if psi > np.pi - distance:
        integral += pd.henyey_greenstein_cdf(g, np.cos(2 * np.pi - distance - psi).astype(g.dtype))
    return integral


def phase_sphere_light(inputs: dict[str, Any], dtype: type) -> dict[str, Any]:
    g, omega_o, axis, psi = (inputs[name] for name in ("g", "omega_o", "cap_dir", "psi"))
    return {
        "pivot_integral_gp_equals_g": pd.pivot_phase_cap_integral(g, omega_o, axis, versine(psi)),
        "hg_integral": dtype(henyey_greenstein_over_cap(g, omega_o, axis, psi)),
    }


FORMULAS = {
    "pivot_phase": pivot_phase,
    "hg_phase": hg_phase,
    "hg_fit_Q": hg_fit_Q,
    "phase_sphere_light": phase_sphere_light,
}
