"""Makes sheen_ltc.f32: linearly transformed cosines of a layer of upright fibres [Zeltner22].

python lut/sheen_ltc.py [--out FOLDER]

[Zeltner22]  Practical Multiple-Scattering Sheen Using Linearly Transformed Cosines
[Heitz15]  The SGGX Microflake Distribution
"""

import argparse
from pathlib import Path
from typing import NamedTuple

import numpy as np
import numpy.typing as npt

Array = npt.NDArray[np.float64]

ROUGHNESS_NODES, COS_NODES = 32, 32
SMALLEST_COS = 1e-3  # stands for the view along the surface
WALKS = 100_000
FEWEST = 200  # reflected walks that are worth a fit: else next to none of the light comes back


class Reflected(NamedTuple):
    """Directions (n, 3) in which walks leave the layer on the side that they came from, and what share they are."""

    wi: Array
    albedo: float


def scattered(wo: Array, sigma: float, random: np.random.Generator) -> Array:
    """Mirror images of directions (n, 3) at fibres' normals that they see: those of a sphere of which the height is
    sigma times its width [Heitz15]."""
    squeeze = np.array([1.0, 1.0, sigma])
    seen = wo * squeeze
    seen /= np.linalg.norm(seen, axis=-1, keepdims=True)
    radius, phi = np.sqrt(random.random(len(wo))), 2 * np.pi * random.random(len(wo))
    helper = np.where(np.abs(seen[:, 2:]) < 0.9, [[0.0, 0.0, 1.0]], [[1.0, 0.0, 0.0]])
    across = np.cross(helper, seen)
    across /= np.linalg.norm(across, axis=-1, keepdims=True)
    along = np.cross(seen, across)
    disk = (radius * np.cos(phi))[:, None] * across + (radius * np.sin(phi))[:, None] * along
    normal = (disk + np.sqrt(np.maximum(1 - radius**2, 0))[:, None] * seen) * squeeze
    normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
    wi = 2 * (wo * normal).sum(-1, keepdims=True) * normal - wo
    return wi / np.linalg.norm(wi, axis=-1, keepdims=True)


def reflected(roughness: float, cos_o: float, random: np.random.Generator) -> Reflected:
    """Walks through a layer of thickness and density 1 that absorbs nothing. A direction w meets fibres by
    sqrt(w_x^2 + w_y^2 + sigma^2 w_z^2), sigma = roughness^2. The first meeting is certain, and weighs what it is."""
    sigma = roughness**2

    def met(w: Array) -> Array:
        return np.sqrt(np.maximum(1 - w[:, 2] ** 2, 1e-12) + (sigma * w[:, 2]) ** 2)

    start = np.array([[np.sqrt(1 - cos_o**2), 0.0, cos_o]])
    share = -np.expm1(-met(start)[0] / cos_o)
    depth = -np.log1p(-share * random.random(WALKS)) * cos_o / met(start)[0]
    back = np.repeat(start, WALKS, 0)  # against the walk's direction
    found: list[Array] = []
    while len(depth):
        away = scattered(back, sigma, random)
        depth = depth - away[:, 2] * random.exponential(size=len(away)) / met(away)
        found.append(away[depth < 0])
        inside = (depth >= 0) & (depth <= 1)
        back, depth = -away[inside], depth[inside]
    wi = np.concatenate(found)
    return Reflected(wi, share * len(wi) / WALKS)


def fit(wi: Array) -> tuple[float, float]:
    """(a, b) by which (a x + b z, a y, z) are the most likely to be cosine-distributed: slopes x / z, y / z then have a
    density of location -b / a and width 1 / a, and both are means by weights 1 / (1 + distance^2 a^2)."""
    slopes = wi[:, :2] / np.maximum(wi[:, 2:], 1e-6)
    centre, width2 = float(np.median(slopes[:, 0])), 1.0
    for _ in range(100):
        distance2 = (slopes[:, 0] - centre) ** 2 + slopes[:, 1] ** 2
        weight = 1 / (1 + distance2 / width2)
        centre = float((weight * slopes[:, 0]).sum() / weight.sum())
        width2 = float(2 * (weight * distance2).mean())
    return 1 / np.sqrt(width2), -centre / np.sqrt(width2)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=Path, default=Path(__file__).parent / "data")
    out = parser.parse_args().out
    random = np.random.default_rng(1)
    table = np.zeros((ROUGHNESS_NODES, COS_NODES, 3))
    for i in range(ROUGHNESS_NODES):
        for j in range(COS_NODES):
            walks = reflected(i / (ROUGHNESS_NODES - 1), max(j / (COS_NODES - 1), SMALLEST_COS), random)
            table[i, j] = (walks.albedo, *fit(walks.wi)) if len(walks.wi) >= FEWEST else (0, *table[i, j - 1, 1:])
    table.astype("<f4").tofile(out / "sheen_ltc.f32")


if __name__ == "__main__":
    main()
