"""Monte Carlo efficiency of Pivot, Cycles and Mitsuba on one set of scenes: direct light, no denoiser, box filter.

./run python tests/benchmark/monte_carlo.py [--blender PYTHON ...] [--mitsuba PYTHON] [--scenes NAME ...]

relMSE = mean((I - R)^2 / (R^2 + 0.01)) against a converged reference R of the renderer's own, whose noise is
subtracted; cost = CPU seconds of the render alone, by the difference of two sample counts; efficiency =
1 / (relMSE x cost). Every figure is the mean of several seeds. Then the same for 10, 100 and 1000 lights of one total
power. References are kept in build/monte_carlo and used again; --seeds 0 makes those alone. Writes monte_carlo.csv and
monte_carlo.png there; says which renderers it skips. monte_carlo_rays.py beside it compares with bare Embree.
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
import monte_carlo_table as table
import numpy as np
from numpy.typing import NDArray

FOLDER = Path(__file__).resolve().parent
OUTPUT = FOLDER.parents[1] / "build" / "monte_carlo"
REFERENCE_SAMPLES = {"pivot": 512, "cycles": 256, "mitsuba": 512}
REFERENCE_PARTS = 4


@dataclass(frozen=True)
class Renderer:
    """One row of the table. Those of one name share a reference: Cycles 4.5 and 5.0 make the same picture."""

    label: str
    name: str  # in the worker, and of the reference
    python: str
    worker: str
    settings: dict[str, Any]

    def counts(self, samples: int) -> tuple[int, int]:
        """The sample counts whose cost is compared; adaptive sampling has a ceiling and no second count."""
        return (0, 4 * samples) if "adaptive" in self.settings else (samples // 4, samples)

    def renders(self, scene: str) -> bool:
        """Under many lamps the best alone: joint sampling and light trees."""
        if scene in scenes.LAMPS and not (self.settings == {} or self.settings.get("light_tree")):
            return False
        return self.name == "pivot" or self.name in scenes.SCENES[scene].peers

    def references(self, scene: str) -> list[tuple[str, str, int, int]]:
        samples = REFERENCE_SAMPLES[self.name] // REFERENCE_PARTS
        return [(scene, f"{self.name} reference", samples, 1000 + part) for part in range(REFERENCE_PARTS)]

    def pictures(self, scene: str, samples: int, seeds: int) -> list[tuple[str, str, int, int]]:
        return [(scene, self.label, count, s) for count in self.counts(samples) if count for s in range(seeds)]


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
                found.append(Renderer(label, "pivot", python, "monte_carlo_blender.py", settings))
        elif index == 0:
            print(f"skipped: Pivot, which {python} cannot import")
        for tree in (True, False):
            label = f"cycles {version} {'tree' if tree else 'no tree'}"
            settings = {"light_tree": tree}
            found.append(Renderer(label, "cycles", python, "monte_carlo_blender.py", settings))
    version = probe(mitsuba, "import mitsuba; print(mitsuba.__version__)")
    if version is None:
        print(f"skipped: Mitsuba, which {mitsuba} cannot import")
    else:
        label = f"mitsuba {version}"
        found.append(Renderer(label, "mitsuba", mitsuba, "monte_carlo_mitsuba.py", {}))
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
    worker = [renderer.python, str(FOLDER / renderer.worker)]
    environment = os.environ | {"PYTHONPATH": str(FOLDER)}
    subprocess.run(worker, check=True, input=json.dumps(jobs), text=True, stdout=subprocess.DEVNULL, env=environment)


def load(file: Path) -> tuple[NDArray[np.float64], float]:
    with np.load(file) as data:
        return data["image"].astype(np.float64), float(data["cpu_s"])


def reference(renderer: Renderer, scene: str) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Mean of the parts, and the variance of that mean."""
    parts = [load(picture_file(*wanted))[0] for wanted in renderer.references(scene)]
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
    mean, variance = reference(renderer, scene)
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


def write_picture(renderers: list[Renderer], rows: list[dict[str, Any]], samples: int) -> None:
    """One seed of every picture measured."""
    images: dict[str, dict[str, NDArray[np.float64]]] = {}
    counts = {renderer.label: renderer.counts(samples)[1] for renderer in renderers}
    for row in rows:
        scene, label = row["scene"], row["renderer"]
        images.setdefault(label, {})[scene] = load(picture_file(scene, label, counts[label], 0))[0]
    table.write_picture(OUTPUT / "monte_carlo.png", list(dict.fromkeys(row["scene"] for row in rows)), images)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--blender", nargs="+", default=[sys.executable], help="Pythons with bpy; the first has Pivot")
    parser.add_argument("--mitsuba", default=sys.executable, help="a Python with mitsuba")
    parser.add_argument("--scenes", nargs="+", default=list(scenes.SCENES), choices=list(scenes.SCENES))
    parser.add_argument("--samples", type=int, default=32)
    parser.add_argument("--seeds", type=int, default=3)
    parser.add_argument("--only", nargs="+", help="measure these renderers; of others, the last pictures")
    arguments = parser.parse_args()
    renderers = find_renderers(arguments.blender, arguments.mitsuba)
    rows = []
    for scene in arguments.scenes:
        for renderer in renderers:
            if not renderer.renders(scene):
                continue
            pictures = renderer.pictures(scene, arguments.samples, arguments.seeds)
            missing = [wanted for wanted in renderer.references(scene) if not picture_file(*wanted).exists()]
            if not arguments.only or renderer.label in arguments.only:
                render(renderer, missing + pictures)
            elif missing or not all(picture_file(*wanted).exists() for wanted in pictures):
                continue
            if not arguments.seeds:
                continue
            rows.append(measure(renderer, scene, arguments))
            print(
                "  ".join(f"{k} {v:.4g}" if isinstance(v, float) else str(v) for k, v in rows[-1].items()), flush=True
            )
    if not rows:
        return
    with (OUTPUT / "monte_carlo.csv").open("w", newline="") as file:
        writer = csv.DictWriter(file, rows[0].keys())
        writer.writeheader()
        writer.writerows(rows)
    table.print_table(rows)
    under_lamps = [row for row in rows if row["scene"] in scenes.LAMPS]
    others = [row for row in rows if row not in under_lamps]
    if others:
        table.print_ratios(others)
        write_picture(renderers, others, arguments.samples)
    if under_lamps:
        table.print_growth(under_lamps)


if __name__ == "__main__":
    main()
