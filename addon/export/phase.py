"""Blender's phase functions as the Henyey-Greenstein function that is nearest to them.

[Dupuy17] Dupuy, Heitz, Belcour, "A Spherical Cap Preserving Parameterization for Spherical Distributions", 2017.
[Jendersie23] Jendersie and d'Eon, "An Approximate Mie Scattering Function for Fog and Cloud Particles", 2023.
"""

from __future__ import annotations

import math

import numpy as np

_MOST = 1 - 1e-3  # of |g|, as in Cycles


def bounded(g: float) -> float:
    return min(max(g, -_MOST), _MOST)


def draine_mean_cosine(g: float, alpha: float) -> float:
    """[Jendersie23], the mean of the cosine over Draine's phase function."""
    return g * (1 + alpha * (3 + 2 * g * g) / 5) / (1 + alpha * (1 + 2 * g * g) / 3)


def pivot_of_mean_cosine(g: float) -> float:
    """g_p of the pivot phase function [Dupuy17, 6.2] of this mean cosine, found by halving."""
    low, high = 0.0, 1.0
    while high - low > 1e-9:
        g_p = (low + high) / 2
        squared = g_p * g_p
        mean = (1 + squared) / (2 * g_p) - (1 - squared) ** 2 / (2 * squared) * math.atanh(g_p)
        low, high = (g_p, high) if mean < abs(g) else (low, g_p)
    return math.copysign(low, g)


def henyey_greenstein_of_backscatter(share: float) -> float:
    """g of the function that scatters this share of the light backwards."""
    g = np.linspace(1e-4, _MOST, 4096)
    backward = (1 - g) / (2 * g) * ((1 + g) / np.sqrt(1 + g * g) - 1)
    return float(np.interp(-share, -backward, g))


def mie_lobes(diameter_um: float) -> tuple[tuple[float, float], tuple[float, float]]:
    """(weight, mean cosine) of the two lobes that water droplets of this diameter have. [Jendersie23 (7-18)]"""
    d = max(diameter_um, 1e-6)
    log_d = math.log(d)
    if d <= 0.1:
        narrow, g, alpha = 13.8 * d * d, 1.1456 * d * math.sin(9.29044 * d), 250.0
        share = 0.252977 - 312.983 * d**4.3
    elif d < 1.5:
        narrow, alpha = 0.862 - 0.143 * log_d**2, 250.0
        inner = (log_d - 0.238604) * (log_d + 1.00667) / (0.507522 - 0.15677 * log_d)
        g = 0.379685 * math.cos(1.19692 * math.cos(inner) + 1.37932 * log_d + 0.0625835) + 0.344213
        share = 0.146209 * math.cos(3.38707 * log_d + 2.11193) + 0.316072 + 0.0778917 * log_d
    elif d < 5:
        narrow = 0.0604931 * math.log(log_d) + 0.940256
        g = 0.500411 - 0.081287 / (-2 * log_d + math.tan(log_d) + 1.27551)
        alpha = 7.30354 * log_d + 6.31675
        share = 0.026914 * (log_d - math.cos(5.68947 * (math.log(log_d) - 0.0292149))) + 0.3764
    else:
        narrow = math.exp(-0.0990567 / (d - 1.67154))
        g = math.exp(-2.20679 / (d + 3.91029) - 0.428934)
        alpha = math.exp(3.62489 - 8.29288 / (d + 5.52825))
        share = math.exp(-0.599085 / (d - 0.641583) - 0.665888)
    return (1 - share, narrow), (share, draine_mean_cosine(g, alpha))
