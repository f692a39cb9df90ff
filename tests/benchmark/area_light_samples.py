"""How much the samples of area lights vary, by half-angle, roughness and view: joint samples, and by MIS.

./run python -m tests.benchmark.area_light_samples [--shape rectangle|ellipse|triangle] [--lights N]

One light of constant radiance over a GGX metal without Fresnel, nothing in the way: relative variance of what one light
sample brings, and one BSDF sample where these share. MIS is the balance heuristic over one sample even by the light's
area and one of the BSDF. Lights are drawn about the mirrored view, beside it, and across the horizon; every third faces
the point, others are tilted, some are four times as long as wide. Prints the median and the worst of each cell, then
quantiles by half-angle, by view and by where the light is, and CPU ns a joint sample.
"""

from __future__ import annotations

import argparse
import itertools
import time
from collections.abc import Iterator

import numpy as np
import pivot_core
from numpy.typing import NDArray

from tests.core.scenes import set_camera

Array = NDArray[np.float64]
HALF_ANGLES_DEG, ALPHAS, VIEWS_DEG = (1, 4, 12, 25, 45), (0.02, 0.05, 0.1, 0.25, 0.5), (30, 60, 75, 85)
WHERE = ("mirrored", "beside", "horizon")
SAMPLES = 1 << 13
WHITE = (1.0, 1.0, 1.0)


def unit(v: Array) -> Array:
    return v / np.linalg.norm(v)


def lights(half_angle: float, alpha: float, view: float, count: int, random: np.random.Generator) -> Iterator[tuple]:
    """(where, center, half_u, half_v) of lights a metre from the origin, angles in radians."""
    mirrored = np.array([-np.sin(view), 0.0, np.cos(view)])
    for where, index in itertools.product(WHERE, range(count)):
        size = np.tan(half_angle)
        if where == "horizon":
            elevation = random.uniform(-0.7, 0.7) * half_angle
            azimuth = np.pi + random.normal() * (0.3 * half_angle + alpha)
            flat = np.cos(elevation)
            center = np.array([flat * np.cos(azimuth), flat * np.sin(azimuth), np.sin(elevation)])
        else:
            away = 0.4 * random.uniform() * size if where == "mirrored" else 1.3 * size + alpha * random.uniform(0, 3)
            center = unit(mirrored + away * unit(random.normal(size=3)))
            if center[2] < -0.5 * np.sin(half_angle):
                center[2] = -center[2]
        tilted = -center + (random.uniform() if index % 3 else 0.0) * unit(random.normal(size=3))
        normal = unit(tilted) if unit(tilted) @ center < -0.15 else -center
        u = unit(np.cross(normal, random.normal(size=3)))
        yield where, center, size * u, size / (1, 1, 4)[index % 3] * np.cross(normal, u)


def make_scene(shape: str, center: Array, half_u: Array, half_v: Array) -> pivot_core.Scene:
    scene = pivot_core.Scene()
    set_camera(scene, (0, 0, 10))
    if shape == "triangle":
        corners = np.array([center - half_u, center + half_u - half_v, center + half_u + half_v], np.float32)
        mesh = scene.add_mesh("triangle", corners, np.arange(3), np.arange(3)[None])
        shines = scene.add_material("emitter", pivot_core.Material(emission=WHITE))
        scene.add_instances("triangle", mesh, np.eye(4, dtype=np.float32)[None], [shines])
    else:
        light = pivot_core.AreaLight(tuple(center), tuple(half_u), tuple(half_v), WHITE, ellipse=shape == "ellipse")
        scene.add_light("light", light)
    return scene


def variances(scene: pivot_core.Scene, material: pivot_core.Material, wo: tuple[float, ...]) -> dict[str, float]:
    """Relative, of joint samples and of MIS, estimated from both kinds of samples together. Empty if it is dark."""
    vertex = (material, (0.0, 0.0, 0.0), wo)
    wi = np.concatenate([scene.sample_lights(*vertex, mode, 1, SAMPLES, seed)[0] for seed, mode in enumerate(MODES)])
    densities = {mode: scene.light_densities(*vertex, mode, 1, wi) for mode in MODES}
    pdf = {mode: found[0][:, 0].astype(float) for mode, found in densities.items()}
    reflected, of_bsdf = (densities["JOINT"][k].astype(float) for k in (1, 2))
    brought = reflected[:, 0, 0]
    lit = brought > 0
    per_sample = np.where(lit, 1 / np.maximum(sum(pdf.values()) * SAMPLES, 1e-30), 0)

    def integral(values: Array) -> float:
        return float((values * per_sample)[lit].sum())

    mean = integral(brought)
    if not mean > 0:
        return {}
    result = {}
    for mode in MODES:
        shares = mode == "MIS" or bool(densities["JOINT"][3][0])
        both = pdf[mode] + (of_bsdf if shares else 0)
        both[~lit] = 1
        by_light, by_bsdf = pdf[mode] / both, (of_bsdf if shares else 0 * of_bsdf) / both
        squares = integral(brought**2 * by_light / both) + integral(brought**2 * by_bsdf / both)
        result[mode] = (squares - integral(brought * by_light) ** 2 - integral(brought * by_bsdf) ** 2) / mean**2
    return result


MODES = ("JOINT", "MIS")


def sample_time_ns(shape: str, alpha: float, repeats: int = 5) -> float:
    """Least CPU time of a joint sample, what calls cost included."""
    scene = make_scene(shape, np.array([-0.8, 0.1, 0.6]), np.array([0.0, 0.2, 0.0]), np.array([0.12, 0.0, 0.16]))
    material = pivot_core.Material(alpha=alpha, conductor_f0=WHITE, conductor_f90=WHITE)
    times = []
    for seed in range(repeats):
        start = time.process_time()
        scene.sample_lights(material, (0.0, 0.0, 0.0), (0.8, 0.0, 0.6), "JOINT", 1, 1 << 17, seed)
        times.append((time.process_time() - start) / (1 << 17))
    return 1e9 * min(times)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--shape", choices=("rectangle", "ellipse", "triangle"), default="rectangle")
    parser.add_argument("--lights", type=int, default=3, help="at each of the three places, of each cell")
    arguments = parser.parse_args()
    random = np.random.default_rng(1)
    found = []  # (half-angle, alpha, view, where, joint, mis)
    print(f"{'half-angle, alpha':>18}  view {'joint: median, worst':>22} {'MIS: median, worst':>22}")
    for half_angle, alpha, view in itertools.product(HALF_ANGLES_DEG, ALPHAS, VIEWS_DEG):
        material = pivot_core.Material(alpha=alpha, conductor_f0=WHITE, conductor_f90=WHITE)
        wo = (float(np.sin(np.radians(view))), 0.0, float(np.cos(np.radians(view))))
        first = len(found)
        angles = np.radians(half_angle), alpha, np.radians(view)
        for where, *light in lights(*angles, arguments.lights, random):
            varies = variances(make_scene(arguments.shape, *light), material, wo)
            if varies:
                found.append((half_angle, alpha, view, where, *varies.values()))
        cell = np.array([row[4:] for row in found[first:]])
        columns = (f"{np.median(cell[:, k]):14.4f} {cell[:, k].max():7.3f}" for k in range(2))
        print(f"{half_angle:11} {alpha:6.2f}  {view:4}", *columns, flush=True)
    values = np.array([row[4:] for row in found])
    print(f"\n{'':24} {'joint: median, 90 %, worst':>28} {'MIS':>28} {'above MIS':>10} {'cases':>6}")

    def show(name: str, chosen: list[bool]) -> None:
        of = values[chosen]
        quantiles = (" ".join(f"{x:9.4f}" for x in np.quantile(of[:, k], (0.5, 0.9, 1.0))) for k in range(2))
        print(f"{name:24}", *quantiles, f"{(of[:, 0] > 1.001 * of[:, 1]).mean():9.1%} {len(of):6}")

    for column, names in enumerate((HALF_ANGLES_DEG, ALPHAS, VIEWS_DEG, WHERE)):
        for name in names:
            show(f"{('half-angle', 'alpha', 'view', 'light')[column]} {name}", [row[column] == name for row in found])
    for view in VIEWS_DEG:
        near = [row[0] <= 12 and row[1] >= 0.1 and row[2] == view for row in found]
        show(f"to 12 deg, 0.1 on, at {view}", near)
    times = (f"{alpha}: {sample_time_ns(arguments.shape, alpha):.0f}" for alpha in (0.02, 0.1, 0.5))
    print("CPU ns a joint sample at alpha", ", ".join(times))


if __name__ == "__main__":
    main()
