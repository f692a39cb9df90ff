"""Fits ggx_ltc.f32: per alpha and view, the linearly transformed cosine nearest to the GGX lobe.

    python lut/ggx_ltc.py [--out FILE]

Nearest in Hellinger distance, as ggx_sptd.py has it: f = BRDF * cos, g the LTC scaled to the same albedo over the
hemisphere. Each fit starts from its neighbour's.
"""

import argparse
from pathlib import Path

import numpy as np
import pivot_core.distributions as distributions
import pivot_core.tables as tables
from ggx_sptd import NODES, Lobe, make_lobe
from quadrature import Array
from scipy.optimize import least_squares

START = (0.0, 1.0, 1.0, 0.0)  # shift, width_x, width_y, skew: of the roughest lobe along the normal


def matrix(lobe: Lobe, values: Array) -> Array:
    return tables.ggx_ltc_from_node(lobe.alpha, lobe.wo_local, *values)


def ltc(lobe: Lobe, m: Array) -> Array:
    """The LTC at the lobe's nodes, scaled to the lobe's albedo over the hemisphere."""
    above = distributions.ltc_above_horizon(m)
    return distributions.ltsd_eval("clamped_cosine", m, lobe.nodes.wi_local) * (lobe.albedo / above)


def l1_distance(lobe: Lobe, m: Array) -> float:
    """Over the albedo, 0 to 2."""
    return float(np.abs(lobe.value - ltc(lobe, m)) @ lobe.nodes.weight_sr) / lobe.albedo


def hellinger(lobe: Lobe, m: Array) -> float:
    """Squared Hellinger distance over the albedo, 0 to 2."""
    return 2 - 2 * float(np.sqrt(lobe.value * ltc(lobe, m)) @ lobe.nodes.weight_sr) / lobe.albedo


def fit(lobe: Lobe, start: Array) -> Array:
    """(shift, width_x, width_y, skew) nearest to the lobe. Along the normal shift and skew are without effect: they
    stay, and both widths are one."""
    root_f = np.sqrt(lobe.value)
    root_weight = np.sqrt(lobe.nodes.weight_sr / lobe.albedo)
    round_lobe = lobe.wo_local[2] == 1

    def values(x: Array) -> Array:
        if round_lobe:
            return np.array([start[0], np.exp(x[0]), np.exp(x[0]), start[3]])
        return np.array([x[0], np.exp(x[1]), np.exp(x[2]), x[3]])

    def residuals(x: Array) -> Array:
        return (root_f - np.sqrt(ltc(lobe, matrix(lobe, values(x))))) * root_weight

    first = np.array([start[0], np.log(start[1]), np.log(start[2]), start[3]])
    found = least_squares(residuals, first[1:2] if round_lobe else first, xtol=1e-7, ftol=1e-12, gtol=1e-12)
    return values(found.x)


def fit_rows(alphas: Array) -> Array:
    """[alpha][cos][values], from the roughest to the smoothest, from the normal to the horizon."""
    cosines = tables.cos_nodes(NODES).astype(np.float64)
    table = np.empty((len(alphas), NODES, 4))
    for row in reversed(range(len(alphas))):
        start = np.array(START) if row + 1 == len(alphas) else table[row + 1, -1]
        for column in reversed(range(NODES)):
            start = fit(make_lobe(float(alphas[row]), float(cosines[column])), start)
            table[row, column] = start
        # what has no effect along the normal continues its neighbours, for the cells between them
        table[row, -1, [0, 3]] = 2 * table[row, -2, [0, 3]] - table[row, -3, [0, 3]]
    return table


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=Path, default=Path(__file__).parent / "data" / "ggx_ltc.f32")
    arguments = parser.parse_args()
    table = fit_rows(tables.alpha_nodes(NODES).astype(np.float64))
    table.astype("<f4").tofile(arguments.out)


if __name__ == "__main__":
    main()
