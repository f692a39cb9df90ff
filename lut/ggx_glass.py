"""Makes ggx_glass.f32 and ggx_glass_average.f32: albedo of a rough dielectric boundary, by single scattering.

python lut/ggx_glass.py [--out FOLDER]
"""

import argparse
from pathlib import Path

import numpy as np
import pivot_core.bsdf as bsdf
import pivot_core.tables as tables
from quadrature import Array, gauss, view

ALPHA_NODES, COS_NODES, ETA_NODES = 32, 32, 33
SMALLEST_COS = 1e-5  # stands for the view along the surface, where the BSDF has no limit
AROUND, ACROSS = 48, 96  # points of the square that microfacets are sampled by


def smith_lambda(alpha: float, cos: Array) -> Array:
    """Of directions at this cosine to the normal. [Heitz14 (72)]"""
    tan2 = alpha**2 * (1 / np.square(np.maximum(np.abs(cos), 1e-12)) - 1)
    return 0.5 * (np.sqrt(1 + np.maximum(tan2, 0)) - 1)


def visible_facets(alpha: float, cos_o: float) -> tuple[Array, Array]:
    """Microfacet normals (n, 3) that the view sees, and the share of each. The second number is of a square's edges
    the closer the nearer: there the normals are the most tilted."""
    across, weight = gauss(0.0, 1.0, ACROSS)
    smooth, slope = across**2 * (3 - 2 * across), 6 * across * (1 - across)
    around = (np.arange(AROUND) + 0.5) / AROUND
    u = np.stack(np.broadcast_arrays(around[:, None], np.minimum(smooth, 1 - 2**-25)), -1).reshape(-1, 2)
    share = np.tile(weight * slope, AROUND) / AROUND
    mirrored = bsdf.ggx_sample(alpha, view(cos_o), u)
    h = mirrored + view(cos_o)
    return h / np.linalg.norm(h, axis=-1, keepdims=True), share


def albedos(alpha: float, cos_o: float, etas: Array) -> Array:
    """(etas, 2): what is reflected and what is refracted to the view where all light around is 1."""
    cos_o = max(cos_o, SMALLEST_COS)
    h, share = visible_facets(alpha, cos_o)
    cos_oh = np.clip(h @ view(cos_o), 0, 1)
    lambda_o = smith_lambda(alpha, np.array(cos_o))

    def kept(cos_i: Array) -> Array:
        return share * (1 + lambda_o) / (1 + lambda_o + smith_lambda(alpha, cos_i))

    cos_mirrored = 2 * cos_oh * h[:, 2] - cos_o
    mirrored = np.where(cos_mirrored > 0, kept(cos_mirrored), 0)
    result = []
    for eta in etas:
        fresnel = bsdf.fresnel_dielectric(np.maximum(cos_oh, 1e-9), eta)
        cos2_ih = 1 - (1 - cos_oh**2) / eta**2
        cos_refracted = (cos_oh / eta - np.sqrt(np.maximum(cos2_ih, 0))) * h[:, 2] - cos_o / eta
        refracted = np.where((cos2_ih > 0) & (cos_refracted < 0), kept(cos_refracted), 0)
        result.append(((fresnel * mirrored).sum(), ((1 - fresnel) * refracted).sum()))
    return np.array(result)


def averages(table: Array, cosines: Array) -> Array:
    """2 int E cos dcos of the very E that the core interpolates, (alphas, etas): linear in x = sqrt(cos)."""
    ends = np.sqrt(cosines)
    x, weight = gauss(ends[:-1], ends[1:], 3)
    step = (x - ends[:-1, None]) / np.diff(ends)[:, None]
    both = table.sum(-1)
    along = both[:, :-1, None] * (1 - step)[..., None] + both[:, 1:, None] * step[..., None]
    return (4 * along * (x**3 * weight)[..., None]).sum((1, 2))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=Path, default=Path(__file__).parent / "data")
    out = parser.parse_args().out
    etas = tables.eta_nodes(ETA_NODES).astype(np.float64)
    etas[ETA_NODES // 2] = 1 + 1e-6  # the limit
    alphas = tables.alpha_nodes(ALPHA_NODES).astype(np.float64)
    cosines = tables.cos_nodes(COS_NODES).astype(np.float64)
    table = np.array([[albedos(alpha, cos_o, etas) for cos_o in cosines] for alpha in alphas])
    table.astype("<f4").tofile(out / "ggx_glass.f32")
    averages(table, cosines).astype("<f4").tofile(out / "ggx_glass_average.f32")


if __name__ == "__main__":
    main()
