"""The analytic integrator's errors and costs: build/benchmark/analytic.csv and .png.

    python -m tests.benchmark.analytic [cases]

Errors of random lights against brute force, in cells of alpha, view and light size; FLOP slots a point and light (see
flop_slots.cpp, compiled here); the time of 64 lights against one of the same power. matplotlib draws the picture.
"""

from __future__ import annotations

import csv
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pivot_core
import pivot_core.bsdf as bsdf
from numpy.typing import NDArray
from pivot_core.shading import ggx_area_light, ggx_sphere_light

from tests.core.ggx_reference import LEAST_VALUE, ggx_under_cap, random_case
from tests.core.scenes import add_plane, add_sphere, place, set_camera

ROOT = Path(__file__).resolve().parents[2]
OUT = ROOT / "build" / "benchmark"
BUDGETS = (0.5, 1.0, 2.0, 5.0)
Floats = NDArray[np.float64]
Row = tuple[str, str, float]


def summary(
    name: str, cell_of: NDArray[np.int64], exact: Floats, run: Callable[[float], tuple[Floats, Floats]]
) -> list[Row]:
    """Rows of one kind of light: the worst and mean over cells of their mean errors, the worst case, the coverage."""
    rows = []
    for budget in BUDGETS:
        value, predicted = run(budget)
        error = np.abs(value - exact) / np.maximum(exact, LEAST_VALUE)
        cells = [error[cell_of == c].mean() for c in np.unique(cell_of)]
        covered = error <= predicted + 2e-4
        for what, figure in (
            ("mean error, %", 100 * error.mean()),
            ("worst cell's mean error, %", 100 * max(cells)),
            ("99th percentile, %", 100 * np.quantile(error, 0.99)),
            ("worst case, %", 100 * error.max()),
            ("cases within the predicted error, %", 100 * covered.mean()),
        ):
            rows.append((f"{name}, budget {budget:g} %", what, float(figure)))
    return rows


def sphere_errors(count: int) -> list[Row]:
    rng = np.random.default_rng(1)
    cases = [random_case(rng) for _ in range(count)]
    exact = np.array([ggx_under_cap(*case, resolution=500) for case in cases])
    alpha, wo, axis, half_angle = (np.array(column) for column in zip(*cases, strict=True))
    cell = (
        np.log10(alpha) * 1.999 // 1 * 100 + np.degrees(np.arccos(wo[:, 2])) // 30 * 10 + np.log10(half_angle) // 1
    ).astype(int)

    def run(budget: float) -> tuple[Floats, Floats]:
        value, predicted, _ = ggx_sphere_light(alpha, wo, axis, half_angle, budget)
        return value, predicted

    return summary("sphere lights", cell, exact, run)


def area_reference(
    alpha: float, wo: Floats, center: Floats, u: Floats, v: Floats, ellipse: bool, n: int = 700
) -> float:
    """Two grids, one on the light and one of the lobe's own directions, joined by the balance heuristic."""
    normal = np.cross(u, v)
    area = np.linalg.norm(normal)
    normal /= area
    area *= np.pi if ellipse else 4.0
    grid = (np.arange(n) + 0.5) / n
    a, b = (g.ravel() for g in np.meshgrid(grid, grid))
    if ellipse:
        x, y = np.sqrt(a) * np.cos(2 * np.pi * b), np.sqrt(a) * np.sin(2 * np.pi * b)
    else:
        x, y = 2 * a - 1, 2 * b - 1
    p = center + x[:, None] * u + y[:, None] * v
    distance = np.linalg.norm(p, axis=1)
    wi = p / distance[:, None]
    light_pdf = distance**3 / (np.abs(p @ normal) * area)
    up = wi[:, 2] > 0
    total = np.sum(bsdf.ggx_eval(alpha, wo, wi[up]) / (light_pdf[up] + bsdf.ggx_pdf(alpha, wo, wi[up])))
    wi = bsdf.ggx_sample(alpha, wo, np.stack([a, b], -1))
    wi = wi[(wi[:, 2] > 0)]
    wi /= np.linalg.norm(wi, axis=1, keepdims=True)
    t = (center @ normal) / (wi @ normal)
    p = t[:, None] * wi - center
    x, y = p @ np.cross(v, normal) / (u @ np.cross(v, normal)), p @ np.cross(normal, u) / (v @ np.cross(normal, u))
    hit = (t > 0) & ((x * x + y * y <= 1) if ellipse else (np.maximum(np.abs(x), np.abs(y)) <= 1))
    light_pdf = t[hit] ** 2 / (np.abs(wi[hit] @ normal) * area)
    total += np.sum(bsdf.ggx_eval(alpha, wo, wi[hit]) / (light_pdf + bsdf.ggx_pdf(alpha, wo, wi[hit])))
    return float(total / n**2)


def area_errors(count: int, ellipse: bool) -> list[Row]:
    rng = np.random.default_rng(2)
    cases = []
    while len(cases) < count:
        alpha, wo, axis, _ = random_case(rng)
        u, v = rng.normal(size=(2, 3))
        v -= u * (u @ v) / (u @ u)
        extents = 10 ** rng.uniform(np.log10(0.02), np.log10(2), 2)
        u, v = u / np.linalg.norm(u) * extents[0], v / np.linalg.norm(v) * extents[1]
        distance = 10 ** rng.uniform(-1, 1)
        center = distance * axis
        facing = abs(np.cross(u, v) @ axis) / (extents[0] * extents[1])
        if facing > 0.15:
            cases.append((alpha, wo, center, u, v))
    exact = np.array([area_reference(*case, ellipse) for case in cases])
    alpha, wo, center, u, v = (np.array(column) for column in zip(*cases, strict=True))
    cell = (np.log10(alpha) * 1.999 // 1 * 100 + np.degrees(np.arccos(wo[:, 2])) // 30).astype(int)

    def run(budget: float) -> tuple[Floats, Floats]:
        value, predicted, _ = ggx_area_light(alpha, wo, center, u, v, ellipse, budget)
        return value, predicted

    return summary("disk lights" if ellipse else "rectangle lights", cell, exact, run)


def slots() -> list[Row]:
    program = OUT / "flop_slots"
    flags = ["-std=c++20", "-O3", "-DNDEBUG", "-march=x86-64-v3", "-fno-math-errno", "-fno-trapping-math", "-w"]
    source = Path(__file__).parent / "flop_slots.cpp"
    subprocess.run(["g++", *flags, f"-I{ROOT}", str(source), "-o", str(program)], check=True)
    lines = subprocess.run([str(program)], check=True, capture_output=True, text=True).stdout.splitlines()
    return [
        (name, "GFLOP/s" if name.startswith("peak") else "FLOP slots a point and light", float(figure))
        for name, figure, _ in (line.split(",") for line in lines)
    ]


def many_lights() -> list[Row]:
    def seconds(count: int, occlusion: str) -> float:
        rng = np.random.default_rng(3)
        scene = pivot_core.Scene()
        glossy = pivot_core.Material(diffuse=(0.4,) * 3, alpha=0.1, conductor_f0=(0.4,) * 3, conductor_f90=(1,) * 3)
        material = scene.add_material("glossy", glossy)
        scene.add_instances("floor", add_plane(scene), place(), [material])
        ball = add_sphere(scene)
        for x in range(-2, 3):
            scene.add_instances(f"ball {x}", ball, place(x, 0, 0.5, 0.45), [material])
        for i in range(count):
            position = (*rng.uniform(-3, 3, 2), rng.uniform(2, 4))
            scene.add_light(f"light {i}", pivot_core.SphereLight(position, 0.15, (60 / count,) * 3))
        set_camera(scene, (0, -6, 3), size=(320, 180))
        settings = pivot_core.RenderSettings(integrator="ANALYTIC", samples=2, occlusion=occlusion)
        session = pivot_core.Session(scene, settings)
        start = time.process_time()
        session.start()
        session.wait(600)
        return time.process_time() - start

    return [
        (
            f"64 lights over one of the same power, occlusion {occlusion}",
            "times the CPU",
            seconds(64, occlusion) / seconds(1, occlusion),
        )
        for occlusion in ("RAY_TRACED", "NONE")
    ]


def draw(rows: list[Row], path: Path) -> None:
    try:
        from matplotlib.figure import Figure
    except ImportError:
        print(f"no {path.name}: matplotlib is not installed")
        return
    figure = Figure(figsize=(9, 3.6), layout="constrained")
    errors, costs = figure.subplots(1, 2, width_ratios=(1, 1.1))
    for light in ("sphere lights", "rectangle lights", "disk lights"):
        for what, style in (("mean error, %", "-"), ("99th percentile, %", "--")):
            line = [next(r[2] for r in rows if r[0] == f"{light}, budget {b:g} %" and r[1] == what) for b in BUDGETS]
            errors.loglog(BUDGETS, np.maximum(line, 1e-4), style, marker="o", label=f"{light}: {what[:-3]}")
    errors.loglog(BUDGETS, BUDGETS, "k:", label="budget")
    errors.set(xlabel="error budget, %", ylabel="error, %")
    errors.set_xticks(BUDGETS, [f"{b:g}" for b in BUDGETS])
    errors.minorticks_off()
    errors.legend(fontsize=6)
    bars = [r for r in rows if r[1].startswith("FLOP")]
    costs.barh([r[0].replace(" and ", " and\n", 1) for r in bars][::-1], [r[2] for r in bars][::-1], log=True)
    costs.tick_params(axis="y", labelsize=6)
    costs.set(xlabel="FLOP slots a point and light")
    figure.savefig(path, dpi=130)


def main() -> None:
    OUT.mkdir(parents=True, exist_ok=True)
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 400
    rows = (
        slots() + many_lights() + sphere_errors(count) + area_errors(count // 2, False) + area_errors(count // 2, True)
    )
    with (OUT / "analytic.csv").open("w", newline="") as file:
        csv.writer(file).writerows([("case", "figure", "value"), *rows])
    for name, what, figure in rows:
        print(f"{name:64} {what:38} {figure:12.4g}")
    draw(rows, OUT / "analytic.png")


if __name__ == "__main__":
    main()
