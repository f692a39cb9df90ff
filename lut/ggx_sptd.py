"""Fits ggx_sptd.f32: per alpha and view, the pivot of the uniform SPTD nearest to the GGX lobe, and the lobe's albedo.

    python lut/ggx_sptd.py [--out FILE] [--rows FIRST LAST]

Nearest in Hellinger distance, the integral of (sqrt f - sqrt g)^2 with f = BRDF * cos and g the SPTD scaled to the same
albedo over the hemisphere: smooth in the parameters, so neighbours join without seams, and as mindful of the tails,
where a sampler loses most, as of the peak. Each fit starts from its neighbour's.
"""

import argparse
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pivot_core.bsdf as bsdf
import pivot_core.distributions as distributions
import pivot_core.tables as tables
from quadrature import Array, Nodes, reflection_lobe, view
from scipy.optimize import minimize

NODES = 64
SMALLEST_COS = 1e-5  # stands for the view along the surface, where the BRDF has no limit
ALBEDO_COUNT = 96
NORMAL = np.array([0.0, 0.0, 1.0])


class Lobe(NamedTuple):
    """The BRDF * cos at the nodes of a quadrature that suits it."""

    alpha: float
    wo_local: Array
    nodes: Nodes
    value: Array
    albedo: float


def fit_count(alpha: float, cos_o: float) -> int:
    """A sharp lobe seen along the surface is an arc far longer than the SPTD is wide, which its nodes must resolve."""
    return 160 if max(alpha, cos_o) < 0.03 else 48


def make_lobe(alpha: float, cos_o: float) -> Lobe:
    cos_o = max(cos_o, SMALLEST_COS)
    wo = view(cos_o)
    fine = reflection_lobe(alpha, cos_o, ALBEDO_COUNT)
    nodes = reflection_lobe(alpha, cos_o, fit_count(alpha, cos_o))
    albedo = bsdf.ggx_eval(alpha, wo, fine.wi_local) @ fine.weight_sr
    return Lobe(alpha, wo, nodes, bsdf.ggx_eval(alpha, wo, nodes.wi_local), float(albedo))


def sptd(lobe: Lobe, pivot: Array, delta: float) -> Array:
    """The SPTD at the lobe's nodes, scaled to the lobe's albedo over the hemisphere."""
    above = distributions.sptd_uniform_integral(NORMAL, 1.0, pivot, delta)
    return distributions.sptd_uniform_eval(lobe.nodes.wi_local, pivot, delta) * (lobe.albedo / above)


def hellinger(lobe: Lobe, pivot: Array, delta: float) -> float:
    """Squared Hellinger distance over the albedo, 0 to 2."""
    return 2 - 2 * float(np.sqrt(lobe.value * sptd(lobe, pivot, delta)) @ lobe.nodes.weight_sr) / lobe.albedo


def l1_distance(lobe: Lobe, pivot: Array, delta: float) -> float:
    """The integral of |f - g| over the albedo: twice where f is above g, since both integrate to the same."""
    return 2 * float(np.maximum(lobe.value - sptd(lobe, pivot, delta), 0) @ lobe.nodes.weight_sr) / lobe.albedo


def fit(lobe: Lobe, start: tuple[float, float]) -> tuple[float, float]:
    """(shift, width) nearest to the lobe. Along the normal the lobe is round and the shift without effect: it stays."""

    def distance(shift: float, log_width: float) -> float:
        pivot, delta = tables.ggx_sptd_from_node(lobe.alpha, lobe.wo_local, shift, float(np.exp(log_width)))
        return hellinger(lobe, pivot, delta)

    first = np.array([start[0], np.log(start[1])])
    options = {"xatol": 1e-5, "fatol": 1e-11}
    if lobe.wo_local[2] == 1:
        log_width = minimize(lambda x: distance(start[0], x[0]), first[1:], method="Nelder-Mead", options=options).x[0]
        return start[0], float(np.exp(log_width))
    options["initial_simplex"] = first + np.array([[0, 0], [0.1, 0], [0, 0.05]])
    shift, log_width = minimize(lambda x: distance(*x), first, method="Nelder-Mead", options=options).x
    return float(shift), float(np.exp(log_width))


def fit_rows(alphas: Array) -> Array:
    """[alpha][cos][shift, width, albedo], from the roughest to the smoothest, from the normal to the horizon."""
    cosines = tables.cos_nodes(NODES).astype(np.float64)
    table = np.empty((len(alphas), NODES, 3))
    for row in reversed(range(len(alphas))):
        start = (-1.0, 0.8) if row + 1 == len(alphas) else tuple(table[row + 1, -1, :2])
        for column in reversed(range(NODES)):
            lobe = make_lobe(float(alphas[row]), float(cosines[column]))
            start = fit(lobe, start)
            table[row, column] = *start, lobe.albedo
        # the shift that has no effect along the normal continues its neighbours, for the cells between them
        table[row, -1, 0] = 2 * table[row, -2, 0] - table[row, -3, 0]
    return table


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=Path, default=Path(__file__).parent / "data" / "ggx_sptd.f32")
    arguments = parser.parse_args()
    table = fit_rows(tables.alpha_nodes(NODES).astype(np.float64))
    table.astype("<f4").tofile(arguments.out)


if __name__ == "__main__":
    main()
