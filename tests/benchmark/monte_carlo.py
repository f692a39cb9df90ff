"""Monte Carlo efficiency of Pivot, Cycles and Mitsuba on one set of scenes: direct light, no denoiser, box filter.

./run python tests/benchmark/monte_carlo.py [--blender PYTHON ...] [--mitsuba PYTHON] [--scenes NAME ...]

relMSE = mean((I - R)^2 / (R^2 + 0.01)) against a converged reference R of the renderer's own, whose noise is
subtracted; cost = CPU seconds of the render alone, by the difference of two sample counts; efficiency =
1 / (relMSE x cost). Every figure is the mean of several seeds. References are kept in build/monte_carlo, so a run that
was stopped goes on where it was. Writes monte_carlo.csv and monte_carlo.png there; says which renderers it skips.
monte_carlo_rays.py beside it compares with bare Embree.
"""

from __future__ import annotations

import argparse
import csv
import hashlib
import json
import os
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import monte_carlo_scenes as scenes
import numpy as np
from numpy.typing import NDArray

FOLDER = Path(__file__).resolve().parent
sys.path.append(str(FOLDER.parents[1] / "addon" / "chart"))
import pixels  # noqa: E402  of the addon, which needs no Blender for it

OUTPUT = FOLDER.parents[1] / "build" / "monte_carlo"
REFERENCE_PARTS = 4
FIRST_REFERENCE_SEED = 1000


@dataclass(frozen=True)
class Renderer:
    """One row of the table. family: those that share a reference."""

    label: str
    family: str
    python: str
    worker: str
    name: str  # in the worker
    settings: dict[str, Any]

    def counts(self, samples: int) -> tuple[int, int]:
        """The sample counts whose cost is compared; adaptive sampling has a ceiling and no second count."""
        return (0, 4 * samples) if "adaptive" in self.settings else (samples // 4, samples)

    def renders(self, scene: str) -> bool:
        return self.name == "pivot" or self.name in scenes.SCENES[scene].peers


def probe(python: str, code: str) -> str | None:
    """What a Python prints for the code, or None where it fails."""
    done = subprocess.run([python, "-c", code], capture_output=True, text=True)
    return done.stdout.strip().splitlines()[-1] if done.returncode == 0 and done.stdout.strip() else None


def find_renderers(blenders: list[str], mitsuba: str) -> list[Renderer]:
    found = []
    for index, python in enumerate(blenders):
        version = probe(python, "import bpy; print('.'.join(map(str, bpy.app.version[:2])))")
        if version is None:
            print(f"skipped: Cycles of {python}, which has no bpy")
            continue
        if index == 0 and probe(python, "import pivot_core; print(1)"):
            for label, settings in {
                "pivot": {},
                "pivot adaptive": {"adaptive": True, "error_budget_percent": 2.0},
                "pivot MIS": {"light_sampling": "MIS"},
                "pivot SPTD": {"light_sampling": "SPTD"},
            }.items():
                found.append(Renderer(label, "pivot", python, "monte_carlo_blender.py", "pivot", settings))
        elif index == 0:
            print(f"skipped: Pivot, which {python} cannot import")
        for tree in (True, False):
            label = f"cycles {version} {'tree' if tree else 'no tree'}"
            settings = {"light_tree": tree}
            found.append(Renderer(label, f"cycles {version}", python, "monte_carlo_blender.py", "cycles", settings))
    version = probe(mitsuba, "import mitsuba; print(mitsuba.__version__)")
    if version is None:
        print(f"skipped: Mitsuba, which {mitsuba} cannot import")
    else:
        label = f"mitsuba {version}"
        found.append(Renderer(label, label, mitsuba, "monte_carlo_mitsuba.py", "mitsuba", {}))
    return found


def picture_file(scene: str, owner: str, samples: int, seed: int) -> Path:
    key = hashlib.sha256(repr(scenes.SCENES[scene]).encode()).hexdigest()[:8]
    return OUTPUT / f"{scene}-{key}" / f"{owner.replace(' ', '_')}-{samples}-{seed}.npz"


def render(renderer: Renderer, wanted: list[tuple[str, str, int, int]]) -> None:
    """The pictures (scene, owner, samples, seed), in one process."""
    if not wanted:
        return
    jobs = []
    for scene, owner, samples, seed in wanted:
        file = picture_file(scene, owner, samples, seed)
        file.parent.mkdir(parents=True, exist_ok=True)
        common = {"scene": scene, "renderer": renderer.name, "settings": renderer.settings}
        jobs.append(common | {"samples": samples, "seed": seed, "file": str(file)})
    (OUTPUT / "jobs.json").write_text(json.dumps(jobs))
    worker = [renderer.python, str(FOLDER / renderer.worker), str(OUTPUT)]
    subprocess.run(worker, check=True, stdout=subprocess.DEVNULL, env=os.environ | {"PYTHONPATH": str(FOLDER)})


def load(file: Path) -> tuple[NDArray[np.float64], float]:
    with np.load(file) as data:
        return data["image"].astype(np.float64), float(data["cpu_s"])


def reference(scene: str, family: str, samples: int) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Mean of the parts, and the variance of that mean."""
    seeds = range(FIRST_REFERENCE_SEED, FIRST_REFERENCE_SEED + REFERENCE_PARTS)
    parts = [load(picture_file(scene, family + "-reference", samples // REFERENCE_PARTS, seed))[0] for seed in seeds]
    return np.mean(parts, 0), np.var(parts, 0, ddof=1) / len(parts)


def rel_mse(image: NDArray[np.float64], mean: NDArray[np.float64], variance: NDArray[np.float64]) -> float:
    return float((((image - mean) ** 2 - variance) / (mean**2 + 0.01)).mean())


def measure(renderer: Renderer, scene: str, arguments: argparse.Namespace) -> dict[str, Any]:
    """A row of the table, of pictures that are there."""
    low, samples = renderer.counts(arguments.samples)
    few, many = (
        [load(picture_file(scene, renderer.label, count, seed)) for seed in range(arguments.seeds)] if count else []
        for count in (low, samples)
    )
    mean, variance = reference(scene, renderer.family, arguments.reference)
    errors = [rel_mse(image, mean, variance) for image, _ in many]
    cpu_s = [np.median([cpu for _, cpu in images]) if images else 0.0 for images in (few, many)]
    cost_s = float(cpu_s[1] - cpu_s[0]) / (1 - low / samples)
    error = float(np.mean(errors))
    return {
        "scene": scene,
        "renderer": renderer.label,
        "samples": samples,
        "relMSE": error,
        "relMSE of seeds": " ".join(f"{e:.3g}" for e in errors),
        "relMSE of the reference": float((variance / (mean**2 + 0.01)).mean()),
        "CPU s": cost_s,
        "Msamples per CPU s": samples * scenes.WIDTH * scenes.HEIGHT / cost_s / 1e6,
        "efficiency": 1 / (error * cost_s),
        "mean": float(mean.mean()),
    }


def write_pictures(renderers: list[Renderer], names: list[str], samples: int) -> None:
    """A row a scene, a column a renderer: one seed of each, sRGB."""
    black = np.zeros((scenes.HEIGHT, scenes.WIDTH, 3))
    files = [[picture_file(scene, r.label, r.counts(samples)[1], 0) for r in renderers] for scene in names]
    rows = [np.concatenate([load(f)[0] if f.exists() else black for f in row], 1) for row in files]
    pixels.write_png(OUTPUT / "monte_carlo.png", pixels.to_bytes(np.concatenate(rows[::-1], 0)))


def print_table(rows: list[dict[str, Any]]) -> None:
    """Each renderer's figures, and how many times Pivot's efficiency is its own."""
    by_scene: dict[str, dict[str, dict[str, Any]]] = {}
    for row in rows:
        by_scene.setdefault(row["scene"], {})[row["renderer"]] = row
    print(f"{'scene':20} {'renderer':22} {'relMSE':>9} {'CPU s':>8} {'Ms/s':>6} {'pivot x':>8} {'mean':>8}")
    ratios: dict[str, list[float]] = {}
    for scene, found in by_scene.items():
        for label, row in found.items():
            ratio = found["pivot"]["efficiency"] / row["efficiency"] if "pivot" in found else float("nan")
            ratios.setdefault(label, []).append(ratio)
            speed = row["Msamples per CPU s"]
            figures = f"{row['relMSE']:9.2e} {row['CPU s']:8.2f} {speed:6.2f} {ratio:8.2f} {row['mean']:8.5f}"
            print(f"{scene:20} {label:22} {figures}")
        cycles = [row["efficiency"] for label, row in found.items() if label.startswith("cycles")]
        if cycles and "pivot" in found:
            ratios.setdefault("cycles, best", []).append(found["pivot"]["efficiency"] / max(cycles))
    print("Pivot's efficiency over each, geometric mean of the scenes (and the least):")
    for label, values in ratios.items():
        if label != "pivot":
            print(f"  {label:22} {np.exp(np.mean(np.log(values))):8.2f} ({min(values):.2f})")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--blender", nargs="+", default=[sys.executable], help="Pythons with bpy; the first has Pivot")
    parser.add_argument("--mitsuba", default=sys.executable, help="a Python with mitsuba")
    parser.add_argument("--scenes", nargs="+", default=list(scenes.SCENES), choices=list(scenes.SCENES))
    parser.add_argument("--samples", type=int, default=64)
    parser.add_argument("--reference", type=int, default=2048, help="samples of a reference")
    parser.add_argument("--seeds", type=int, default=3)
    parser.add_argument("--only", nargs="+", help="measure these renderers; of others, the last pictures")
    arguments = parser.parse_args()
    OUTPUT.mkdir(parents=True, exist_ok=True)
    renderers = find_renderers(arguments.blender, arguments.mitsuba)
    parts = arguments.reference // REFERENCE_PARTS
    rows = []
    for scene in arguments.scenes:
        for renderer in renderers:
            if not renderer.renders(scene):
                print(f"skipped: {renderer.label} on {scene}, which it has no equal of")
                continue
            seeds = range(FIRST_REFERENCE_SEED, FIRST_REFERENCE_SEED + REFERENCE_PARTS)
            references = [(scene, renderer.family + "-reference", parts, seed) for seed in seeds]
            pictures = [
                (scene, renderer.label, samples, seed)
                for samples in renderer.counts(arguments.samples)
                for seed in range(arguments.seeds)
                if samples
            ]
            chosen = not arguments.only or renderer.label in arguments.only
            missing = [wanted for wanted in references if not picture_file(*wanted).exists()]
            if chosen:
                render(renderer, missing + pictures)
            elif missing or not all(picture_file(*wanted).exists() for wanted in pictures):
                continue
            rows.append(measure(renderer, scene, arguments))
            print(
                "  ".join(f"{k} {v:.4g}" if isinstance(v, float) else str(v) for k, v in rows[-1].items()), flush=True
            )
    with (OUTPUT / "monte_carlo.csv").open("w", newline="") as file:
        writer = csv.DictWriter(file, rows[0].keys())
        writer.writeheader()
        writer.writerows(rows)
    print_table(rows)
    write_pictures(renderers, arguments.scenes, arguments.samples)


if __name__ == "__main__":
    main()
