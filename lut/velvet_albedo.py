"""Makes velvet_albedo.f32: sigma^2 times the logarithm of the velvet lobe's albedo, by the core's own lobe.

python lut/velvet_albedo.py [--out FOLDER]
"""

import argparse
from pathlib import Path

import numpy as np
import pivot_core
from quadrature import gauss, view

SIGMA_NODES, ANGLE_NODES = 32, 32
SMALLEST_SIGMA = 0.01
SMALLEST_COS = 1e-3  # stands for the view along the surface
SMALLEST_ALBEDO = 1e-30
ALONG, AROUND = 256, 256


def albedo(sigma: float, cos_o: float) -> float:
    """What comes to the view where all light around is 1. Cosines are dense at the horizon, where narrow lobes are."""
    root, weight = gauss(0.0, 1.0, ALONG)
    cos_i, weight = root**3, weight * 3 * root**2
    around, around_weight = gauss(0.0, np.pi, AROUND)
    sin_i = np.sqrt(1 - cos_i**2)
    wi = np.stack(np.broadcast_arrays(sin_i * np.cos(around)[:, None], sin_i * np.sin(around)[:, None], cos_i), -1)
    material = pivot_core.Material(lobes=[("velvet", {"sigma": sigma})])
    lobe = material.evaluate(tuple(view(cos_o)), wi.reshape(-1, 3).astype(np.float32))[0][:, 0].reshape(wi.shape[:-1])
    return float((2 * around_weight[:, None] * weight * lobe).sum())


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=Path, default=Path(__file__).parent / "data")
    out = parser.parse_args().out
    cosines = np.maximum(np.cos(np.linspace(0, np.pi / 2, ANGLE_NODES)), SMALLEST_COS)
    sigmas = np.linspace(SMALLEST_SIGMA, 1, SIGMA_NODES)
    table = [[albedo(float(sigma), float(cos_o)) for cos_o in cosines] for sigma in sigmas]
    logarithm = np.log(np.maximum(table, SMALLEST_ALBEDO))
    (sigmas[:, None] ** 2 * logarithm).astype("<f4").tofile(out / "velvet_albedo.f32")


if __name__ == "__main__":
    main()
