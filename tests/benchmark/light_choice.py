"""How well the light tree chooses one of many lights: the relative variance of that choice alone, nothing in the way.

./run python tests/benchmark/light_choice.py [--lights 1000] [--places 200]

Sphere lights of many sizes and powers, on a ceiling and all over a room, over metal and chalk. Of a place, where light
i adds f_i in closed form and is chosen with probability p_i: sum(f_i^2 / p_i) / sum(f_i)^2 - 1, the mean over random
places and views, by how many nodes of the tree their cut has.
"""

from __future__ import annotations

import argparse

import numpy as np
import pivot_core
from numpy.typing import NDArray

Floats = NDArray[np.float64]
METALS = (0.02, 0.05, 0.1, 0.25, 0.5)  # GGX alpha
CUTS = (1, 16, 32, 64)


class Spheres:
    """Lights around the origin, above z = 0."""

    def __init__(self, layout: str, count: int, random: np.random.Generator) -> None:
        self.center = random.uniform((-11, -11, 1), (11, 11, 9), (count, 3)).astype(np.float32)
        if layout == "ceiling":
            self.center[:, 2] = 9.0
        self.radius_m = np.exp(random.uniform(np.log(0.02), np.log(0.3), count)).astype(np.float32)
        self.intensity = np.exp(random.normal(0.0, 1.0, count)).astype(np.float32)
        self.scene = pivot_core.Scene()
        self.scene.set_camera(np.eye(4), (-1, 1, -1, 1), 8, 8)
        for i in range(count):
            light = pivot_core.SphereLight(
                self.center[i].tolist(), float(self.radius_m[i]), [float(self.intensity[i])] * 3
            )
            self.scene.add_light(f"light {i}", light)

    def reflected(self, alpha: float | None, position: Floats, wo: Floats) -> Floats:
        """Of each light: by GGX, F = 1, or, without an alpha, by white chalk."""
        to_center = self.center - position
        distance = np.linalg.norm(to_center, axis=1)
        sine = self.radius_m / distance
        radiance = self.intensity / (np.pi * self.radius_m**2)
        axis = (to_center / distance[:, None]).astype(np.float32)
        if alpha is None:  # all of them above the horizon
            return radiance * sine**2 * axis[:, 2]
        value, _, _ = pivot_core.shading.ggx_sphere_light(alpha, wo.astype(np.float32), axis, np.arcsin(sine), 1.0)
        return radiance * value


def relative_variance(
    spheres: Spheres, alpha: float | None, random: np.random.Generator, places: int, options: dict[str, int]
) -> float:
    white = {"conductor_f0": (1, 1, 1), "conductor_f90": (1, 1, 1)}
    material = pivot_core.Material(diffuse=(1, 1, 1)) if alpha is None else pivot_core.Material(alpha=alpha, **white)
    variances = []
    while len(variances) < places:
        position = np.append(random.uniform(-8, 8, 2), 0.0)
        cosine, turn = random.uniform(0.1, 1.0), random.uniform(0, 2 * np.pi)
        wo = np.array([np.cos(turn), np.sin(turn), 0.0]) * np.sqrt(1 - cosine**2) + (0, 0, cosine)
        reflected = spheres.reflected(alpha, position, wo)
        probability = spheres.scene.choice_probabilities(material, position.tolist(), wo.tolist(), **options)
        if not reflected.sum() > 0:
            continue
        lit = reflected > 0
        assert (probability[lit] > 0).all(), "a light that is seen is never chosen"
        variances.append(float((reflected[lit] ** 2 / probability[lit]).sum() / reflected.sum() ** 2 - 1))
    return float(np.mean(variances))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--lights", type=int, default=1000)
    parser.add_argument("--places", type=int, default=200)
    arguments = parser.parse_args()
    for layout in ("ceiling", "room"):
        spheres = Spheres(layout, arguments.lights, np.random.default_rng(5))
        print(
            f"{layout + ', cut':16}", *(f"{name:>9}" for name in ["chalk", *(f"metal {a}" for a in METALS)]), sep="  "
        )
        for cut in CUTS:
            cells = [
                relative_variance(spheres, alpha, np.random.default_rng(7), arguments.places, {"cut_nodes": cut})
                for alpha in (None, *METALS)
            ]
            print(f"{cut:16}", *(f"{cell:10.3f}" for cell in cells), sep="  ", flush=True)


if __name__ == "__main__":
    main()
