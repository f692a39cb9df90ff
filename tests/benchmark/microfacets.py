"""What a picture of microfacets costs beside GGX: its load time and memory by size, then a ball of GGX drawn into 512
pixels beside the same ball of GGX: their means, their variance and their CPU.

    ./run python -m tests.benchmark.microfacets
"""

from __future__ import annotations

import time

import numpy as np
import pivot_core
from numpy.typing import NDArray

from tests.core.ndf_pictures import draw, sharp
from tests.core.scenes import add_sphere, place, render, set_camera

SIDE_PX, SAMPLES, SEEDS = 128, 16, 4
METAL = {"conductor_f0": (0.9, 0.8, 0.6), "conductor_f90": (1.0, 1.0, 1.0)}


def loads() -> None:
    print("picture        CPU s  wall s    MiB  lobes  what they leave")
    pictures = {f"GGX, {size} px": draw(size, 0.1, across=2) for size in (64, 256, 512, 1024, 2048, 4096)}
    pictures |= {f"{kind}, 512 px": sharp(kind, 512) for kind in ("pixel", "ring", "grid")}
    pictures["weave, 512 px"] = draw(512, 0.1, 0.3, 0.4)
    for name, picture in pictures.items():
        wall, cpu = time.perf_counter(), time.process_time()
        ndf = pivot_core.TabulatedNdf(picture)
        wall, cpu = time.perf_counter() - wall, time.process_time() - cpu
        size = f"{ndf.memory_bytes / 2**20:6.1f}  {len(ndf.fit):5d}  {ndf.fit_error:.3f}"
        print(f"{name:14s} {cpu:5.2f}  {wall:6.2f} {size}", flush=True)


def ball(material: pivot_core.Material) -> pivot_core.Scene:
    scene = pivot_core.Scene()
    scene.add_instances("ball", add_sphere(scene), place(), [scene.add_material("metal", material)])
    scene.add_light("warm", pivot_core.SphereLight((2, -2, 3), 0.5, (20, 20, 20)))
    scene.add_light("cold", pivot_core.SphereLight((-3, -1, 1), 0.3, (10, 12, 20)))
    set_camera(scene, (0, -4, 1), size=(SIDE_PX, SIDE_PX), half_width=0.35)
    return scene


def picture(scene: pivot_core.Scene, **settings: object) -> tuple[NDArray[np.float64], float]:
    """And the CPU seconds that it took."""
    cpu = time.process_time()
    image = render(scene, max_bounces=0, **settings)[..., :3].astype(float)
    return image, time.process_time() - cpu


def beside_ggx() -> None:
    print("\nroughness  mean  variance  CPU, Monte Carlo  CPU, analytic at 2 %: times those of GGX")
    for roughness in (0.1, 0.2, 0.4, 0.7, 1.0):
        alpha = roughness**2
        tabulated = pivot_core.Material(
            lobes=[("tabulated", {"ndf": pivot_core.TabulatedNdf(draw(512, alpha)), **METAL})]
        )
        rows = []
        for material in (tabulated, pivot_core.Material(alpha=alpha, **METAL)):
            scene = ball(material)
            converged, _ = picture(scene, samples=512, seed=SEEDS)
            weight = 1 / (converged.mean(-1, keepdims=True) ** 2 + 1e-2)
            taken = [picture(scene, samples=SAMPLES, seed=seed) for seed in range(SEEDS)]
            error = np.mean([weight * (image - converged) ** 2 for image, _ in taken])
            analytic = picture(scene, samples=4, integrator="ANALYTIC")[1]
            rows.append((converged.mean(), error, sum(cpu for _, cpu in taken), analytic))
        mean, error, cpu, analytic = (ours / ggx for ours, ggx in zip(*rows, strict=True))
        print(f"{roughness:9.1f}  {mean:.3f}  {error:8.2f}  {cpu:16.1f}  {analytic:13.1f}", flush=True)


if __name__ == "__main__":
    loads()
    beside_ggx()
