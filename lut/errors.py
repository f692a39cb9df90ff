"""Prints the error that each table reaches between its nodes, for README.md.

python lut/errors.py [--points N]
"""

import argparse
from collections.abc import Callable

import ggx_ltc
import ggx_sptd
import numpy as np
import pivot_core.tables as tables
from ggx_average_albedo import average_albedo
from ggx_dielectric import weights
from ggx_glass import albedos
from quadrature import Array

ANGLES = (0, 30, 60, 75, 85)
IORS = np.array([1.05, 1.1, 1.33, 1.5, 1.8, 2.4])
ETAS = np.array([1 / 2.4, 1 / 1.5, 1 / 1.33, 1 / 1.1, 1.1, 1.33, 1.5, 2.4])


def random_views(points: int, seed: int) -> tuple[Array, Array]:
    """(alpha, cos_o), even in their square roots as the tables' axes are."""
    u, v = np.random.default_rng(seed).random((2, points))
    low = np.sqrt(1e-3)
    return np.square(low + (1 - low) * u), np.square(v)


def summary(name: str, errors: Array) -> None:
    median, p99, worst = np.quantile(errors, [0.5, 0.99, 1])
    print(f"{name:54s} median {median:8.1e}  99 % {p99:8.1e}  worst {worst:8.1e}")


def fetched(lobe: ggx_sptd.Lobe) -> tuple[Array, float]:
    """The table's pivot and delta."""
    return tables.ggx_sptd(lobe.alpha, lobe.wo_local)[:2]


def fetched_ltc(lobe: ggx_sptd.Lobe) -> Array:
    """The table's matrix."""
    return tables.ggx_ltc(lobe.alpha, lobe.wo_local)[0]


def print_l1(name: str, distance: Callable[[ggx_sptd.Lobe], float]) -> None:
    print(
        f"\n{name}: L1 distance of the lobe to GGX, % of albedo\nalpha \\ theta " + "".join(f"{t:6d}" for t in ANGLES)
    )
    for alpha in (0.01, 0.1, 0.25, 0.5, 0.9):
        lobes = [ggx_sptd.make_lobe(alpha, float(np.cos(np.radians(theta)))) for theta in ANGLES]
        print(f"{alpha:13.2f} " + "".join(f"{100 * distance(lobe):6.0f}" for lobe in lobes))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--points", type=int, default=300)
    points = parser.parse_args().points

    albedo, excess, excess_ltc, average, weight, glass = [], [], [], [], [], []
    for alpha, cos_o in zip(*random_views(points, 1), strict=True):
        lobe = ggx_sptd.make_lobe(alpha, cos_o)
        albedo.append(abs(float(tables.ggx_albedo(alpha, cos_o)) - lobe.albedo))
        best = tables.ggx_sptd_from_node(alpha, lobe.wo_local, *ggx_sptd.fit(lobe, (-0.5, 1.2)))
        excess.append(ggx_sptd.hellinger(lobe, *fetched(lobe)) - ggx_sptd.hellinger(lobe, *best))
        best_ltc = ggx_ltc.matrix(lobe, ggx_ltc.fit(lobe, np.array(ggx_ltc.START)))
        excess_ltc.append(ggx_ltc.hellinger(lobe, fetched_ltc(lobe)) - ggx_ltc.hellinger(lobe, best_ltc))
        average.append(abs(float(tables.ggx_average_albedo(alpha)) - average_albedo(alpha)))
        weight.append(np.abs(tables.ggx_dielectric_weight(alpha, cos_o, IORS) - weights(alpha, cos_o, IORS)))
        kept = np.sum(tables.ggx_glass_albedo(alpha, cos_o, ETAS), 0)
        glass.append(np.abs(kept / albedos(alpha, cos_o, ETAS).sum(-1) - 1))
    summary("ggx_sptd: albedo, absolute", np.array(albedo))
    summary("ggx_sptd: squared Hellinger distance, above the best", np.array(excess))
    summary("ggx_ltc: squared Hellinger distance, above the best", np.array(excess_ltc))
    summary("ggx_average_albedo: absolute", np.array(average))
    for ior, errors in zip(IORS, np.transpose(weight), strict=True):
        summary(f"ggx_dielectric: s at ior {ior}, absolute", errors)
    for eta, errors in zip(ETAS, np.transpose(glass), strict=True):
        summary(f"ggx_glass: reflected and refracted at eta {eta:.3f}, relative", errors)

    print_l1("ggx_sptd", lambda lobe: ggx_sptd.l1_distance(lobe, *fetched(lobe)))
    print_l1("ggx_ltc", lambda lobe: ggx_ltc.l1_distance(lobe, fetched_ltc(lobe)))


if __name__ == "__main__":
    main()
