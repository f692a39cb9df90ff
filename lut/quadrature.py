"""Quadrature of the GGX reflection lobe over the hemisphere of incoming directions.

Directions are mirror images of wo at microfacet normals h, whose slopes are alpha tan(chi) in azimuth phi: where the
NDF is, there are the nodes, and the horizon is a closed limit of chi for each phi. Gauss-Legendre in both, phi split
where a grazing view bends the limit; the lobe is even in phi.
"""

from typing import NamedTuple

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[np.float64]


class Nodes(NamedTuple):
    """Incoming directions (n, 3) and their weights (n) in steradians."""

    wi_local: Array
    weight_sr: Array


def gauss(low: npt.ArrayLike, high: npt.ArrayLike, count: int) -> tuple[Array, Array]:
    """Nodes and weights (..., count) on [low, high]."""
    x, w = np.polynomial.legendre.leggauss(count)
    half = (np.asarray(high) - np.asarray(low))[..., None] / 2
    return np.asarray(low)[..., None] + half * (1 + x), half * w


def view(cos_o: float) -> Array:
    """The outgoing direction at this cosine to the normal, towards +x."""
    return np.array([np.sqrt((1 - cos_o) * (1 + cos_o)), 0.0, cos_o])


def reflection_lobe(alpha: float, cos_o: float, count: int) -> Nodes:
    """2 count^2 nodes over the directions above the surface that face `view(cos_o)`'s lobe."""
    sin_o = np.sqrt((1 - cos_o) * (1 + cos_o))
    phi, phi_weight = gauss([0, np.pi / 2], [np.pi / 2, np.pi], count)
    phi, phi_weight = phi.reshape(-1, 1), phi_weight.reshape(-1, 1)
    # c tan^2 - 2 s cos(phi) tan - c = 0, of both roots the one that does not cancel
    bend = sin_o * np.abs(np.cos(phi))
    root = bend + np.sqrt(bend**2 + cos_o**2)
    tan_limit = np.where(np.cos(phi) > 0, root / cos_o, cos_o / root)
    chi, chi_weight = gauss(0, np.arctan(tan_limit[:, 0] / alpha), count)
    radius = np.tan(chi)
    slope = alpha * radius
    cos_h = 1 / np.sqrt(1 + slope**2)
    h = np.stack([slope * np.cos(phi), slope * np.sin(phi), np.ones_like(slope)], -1) * cos_h[..., None]
    wo = view(cos_o)
    o_dot_h = h @ wo
    wi = 2 * o_dot_h[..., None] * h - wo
    solid_angle_h = cos_h**3 * alpha**2 * radius * (1 + radius**2)
    weight = 2 * phi_weight * chi_weight * solid_angle_h * 4 * o_dot_h
    wi /= np.linalg.norm(wi, axis=-1, keepdims=True)
    keep = (wi[..., 2] > 0) & (weight > 0)
    return Nodes(wi[keep], weight[keep])
