"""GGX over caps and polygons, for test_oracles.py."""

from typing import Any

import numpy as np
import pivot_core.distributions as pd
from pivot_core.bsdf import ggx_eval

from tests.core.oracle_formulas_caps import Values, rings_across_rim, versine


def ggx_cap_closed(inputs: Values, dtype: type) -> Values:
    light = inputs["cap_dir"], versine(inputs["psi"])
    integral, valid = pd.ggx_cap_integral(inputs["wo"], *light, inputs["alpha_x"], inputs["alpha_y"])
    assert valid
    return {"integral": integral}


def ggx_polygon_closed(inputs: Values, dtype: type) -> Values:
    lobe = inputs["wo"], inputs["alpha_x"], inputs["alpha_y"]
    return {"integral": pd.ggx_polygon_integral(*lobe, inputs["P"])[0]}


def panels(begin: float, end: float, width: float, order: int = 10) -> tuple[np.ndarray, np.ndarray]:
    """Gauss-Legendre nodes and weights on [begin, end], in panels no wider than `width`."""
    edges = np.linspace(begin, end, int(np.ceil((end - begin) / width)) + 1)
    half = np.diff(edges)[:, None] / 2
    nodes, weights = np.polynomial.legendre.leggauss(order)
    return (edges[:-1, None] + half * (1 + nodes)).ravel(), (half * weights).ravel()


def integrate_above(axis: np.ndarray, psi: float, width: float, f: Any, dtype: type) -> Any:
    """The integral of f over what of a cap, psi <= pi / 2, lies above z = 0, in circles about z."""
    theta, azimuth = np.arctan2(np.hypot(axis[0], axis[1]), axis[2]), np.arctan2(axis[1], axis[0])
    first_cut, horizon = abs(theta - psi), np.pi / 2
    pieces = []  # beta, half the azimuth inside, weight
    if psi > theta:  # circles about the pole that are all inside
        beta, weight = panels(0, min(first_cut, horizon), min(width, np.pi / 4))
        pieces.append((beta, np.full_like(beta, np.pi), weight))
    half = min(theta, psi, np.pi - theta, np.pi - psi)
    if half > 0 and first_cut < horizon:
        t_horizon = np.arccos(np.clip(1 - (horizon - first_cut) / half, -1, 1))
        t, weight = panels(0, t_horizon, min(width / half, np.pi / 4))
        beta, slope, reach = rings_across_rim(theta, psi, t)
        pieces.append((beta, reach, weight * slope))
    total = 0.0
    for beta, reach, weight in pieces:
        unit, unit_weight = panels(-1, 1, min(width / (np.sin(beta) * reach).max(), 1.0))
        for ring in range(len(beta)):
            phi = azimuth + reach[ring] * unit
            sine, cosine = np.sin(beta[ring]), np.cos(beta[ring])
            omega = np.stack([sine * np.cos(phi), sine * np.sin(phi), np.full_like(phi, cosine)], -1)
            total += weight[ring] * sine * reach[ring] * (f(omega.astype(dtype)) @ unit_weight)
    return dtype(total)


def reflected(inputs: Values, wo: Any, axis: Any, psi: float, dtype: type) -> Any:
    """Light reflected from a cap of radiance 1 by GGX with height-correlated Smith masking.

    Panels as wide as alpha, narrower at grazing views, have nothing in them that ten points a side do not see.
    """
    alpha = inputs["alpha"]
    axis = np.asarray(axis, np.float64) / np.linalg.norm(axis)
    width = float(alpha) * min(1.0, float(wo[2]) * 2)
    return integrate_above(axis, float(psi), width, lambda omega: ggx_eval(alpha, wo, omega), dtype)


def ggx_albedo(inputs: Values, dtype: type) -> Values:
    theta = inputs["theta_o"]
    wo = np.asarray([np.sin(theta), 0, np.cos(theta)], dtype)
    return {"albedo": reflected(inputs, wo, [0, 0, 1], np.pi / 2, dtype)}


def ggx_sphere_light(inputs: Values, dtype: type) -> Values:
    return {"Lo_over_L": reflected(inputs, inputs["wo"], inputs["cap_dir"], inputs["psi"], dtype)}


FORMULAS: dict[str, Any] = {
    function.__name__: function for function in (ggx_cap_closed, ggx_polygon_closed, ggx_albedo, ggx_sphere_light)
}
