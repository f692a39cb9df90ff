"""Makes ggx_dielectric.f32: how much of the step from F0 to 1 the dielectric Fresnel curve makes, over a GGX lobe.

python lut/ggx_dielectric.py [--out FILE]
"""

import argparse
from pathlib import Path

import numpy as np
import pivot_core.bsdf as bsdf
import pivot_core.tables as tables
from quadrature import Array, reflection_lobe, view

ALPHA_NODES, COS_NODES, IOR_NODES = 32, 32, 16
SMALLEST_COS = 1e-5  # stands for the view along the surface, where the BRDF has no limit
COUNT = 48


def weights(alpha: float, cos_o: float, iors: Array) -> Array:
    """s for each ior, the mean over the lobe of (F - F0) / (1 - F0)."""
    cos_o = max(cos_o, SMALLEST_COS)
    wo = view(cos_o)
    nodes = reflection_lobe(alpha, cos_o, COUNT)
    lobe = bsdf.ggx_eval(alpha, wo, nodes.wi_local) * nodes.weight_sr
    cos_half = np.sqrt(np.clip((1 + nodes.wi_local @ wo) / 2, 0, 1))  # between wo and h
    f0 = bsdf.f0_from_ior(iors)
    step = (bsdf.fresnel_dielectric(cos_half[:, None], iors) - f0) / (1 - f0)
    return lobe @ step / lobe.sum()


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=Path, default=Path(__file__).parent / "data" / "ggx_dielectric.f32")
    arguments = parser.parse_args()
    iors = tables.ior_nodes(IOR_NODES).astype(np.float64)
    alphas = tables.alpha_nodes(ALPHA_NODES).astype(np.float64)
    cosines = tables.cos_nodes(COS_NODES).astype(np.float64)
    table = np.array([[weights(alpha, cos_o, iors) for cos_o in cosines] for alpha in alphas])
    table.astype("<f4").tofile(arguments.out)


if __name__ == "__main__":
    main()
