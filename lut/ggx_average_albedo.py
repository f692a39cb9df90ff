"""Makes ggx_average_albedo.f32 from ggx_sptd.f32: E_avg = 2 int E cos dcos of the very E that the core interpolates.

    python lut/ggx_average_albedo.py [--out FILE]

pivot_core must be built with the ggx_sptd.f32 it is to match.
"""

import argparse
from pathlib import Path

import numpy as np
import pivot_core.tables as tables
from quadrature import gauss

NODES, COS_NODES = 64, 64


def average_albedo(alpha: float) -> float:
    """Exact: between nodes E is linear in x = sqrt(cos), and the integral is 4 int E x^3 dx."""
    ends = np.sqrt(tables.cos_nodes(COS_NODES).astype(np.float64))
    x, weight = gauss(ends[:-1], ends[1:], 3)
    return float((4 * tables.ggx_albedo(alpha, x**2) * x**3 * weight).sum())


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=Path, default=Path(__file__).parent / "data" / "ggx_average_albedo.f32")
    arguments = parser.parse_args()
    averages = [average_albedo(alpha) for alpha in tables.alpha_nodes(NODES).astype(np.float64)]
    np.array(averages, "<f4").tofile(arguments.out)


if __name__ == "__main__":
    main()
