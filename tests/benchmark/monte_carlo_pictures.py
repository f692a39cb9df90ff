"""Pictures that renderers make in their own Pythons, kept in files, and what they cost and how far off they are.

relMSE = mean((I - R)^2 / (R^2 + 0.01)) against a converged reference R of the renderer's own, whose noise is
subtracted; cost = CPU seconds of the render alone, by the difference of two sample counts; efficiency =
1 / (relMSE x cost). Every figure is the mean of several seeds.
"""

from __future__ import annotations

import json
import os
import subprocess
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

FOLDER = Path(__file__).resolve().parent
REFERENCE_PARTS = 4
WORST = 0.01  # the share of the pixels that the trimmed error leaves out

Floats = NDArray[np.float64]
Picture = tuple[str, str, int, int]  # scene, owner, samples, seed


@dataclass(frozen=True)
class Renderer:
    """One row of a table. Those of one name share a reference: Cycles 4.5 and 5.0 make the same picture."""

    label: str
    name: str  # in the worker, and of the reference
    python: str
    worker: str
    settings: dict[str, Any]
    ceiling: int = 4  # of adaptive sampling, times the samples of plain sampling

    @property
    def adaptive(self) -> bool:
        return bool(self.settings.get("adaptive") or self.settings.get("use_adaptive_sampling"))

    def counts(self, samples: int) -> tuple[int, int]:
        """The sample counts whose cost is compared; adaptive sampling has a ceiling and no second count."""
        return (0, self.ceiling * samples) if self.adaptive else (samples // 4, samples)

    def pictures(self, scene: str, samples: int, seeds: Iterable[int]) -> list[Picture]:
        return [(scene, self.label, count, s) for count in self.counts(samples) if count for s in seeds]


@dataclass(frozen=True)
class Gallery:
    """The pictures of a benchmark, each a file below folder."""

    folder: Path
    scene_key: Callable[[str], str]  # of a scene's name: other when the scene is
    reference_samples: Mapping[str, int]  # by the renderer's name

    def file(self, picture: Picture) -> Path:
        scene, owner, samples, seed = picture
        return self.folder / f"{scene}-{self.scene_key(scene)}" / f"{owner.replace(' ', '_')}-{samples}-{seed}.npz"

    def load(self, picture: Picture) -> tuple[Floats, float]:
        """The image and its CPU seconds."""
        with np.load(self.file(picture)) as data:
            return data["image"].astype(np.float64), float(data["cpu_s"])

    def render(self, renderer: Renderer, pictures: list[Picture]) -> None:
        """In one process, also those that are there."""
        jobs = []
        for picture in pictures:
            file = self.file(picture)
            file.parent.mkdir(parents=True, exist_ok=True)
            scene, _, samples, seed = picture
            common = {"scene": scene, "renderer": renderer.name, "settings": renderer.settings}
            jobs.append(common | {"samples": samples, "seed": seed, "file": str(file)})
        worker = [renderer.python, str(FOLDER / renderer.worker)]
        paths = [str(FOLDER), *filter(None, [os.environ.get("PYTHONPATH")])]
        environment = os.environ | {"PYTHONPATH": os.pathsep.join(paths)}
        subprocess.run(
            worker, check=True, input=json.dumps(jobs), text=True, stdout=subprocess.DEVNULL, env=environment
        )

    def make(self, renderer: Renderer, scene: str, samples: int, seeds: Iterable[int], again: bool) -> bool:
        """Render the pictures and what is missing of the reference, or, unless again, find the last ones: whether
        they are all there."""
        missing = [picture for picture in self.reference_pictures(renderer, scene) if not self.file(picture).exists()]
        pictures = renderer.pictures(scene, samples, seeds)
        if not again:
            return not missing and all(self.file(picture).exists() for picture in pictures)
        if missing or pictures:
            self.render(renderer, missing + pictures)
        return True

    def make_reference(self, renderer: Renderer, scene: str) -> None:
        """Render what is missing of it."""
        missing = [picture for picture in self.reference_pictures(renderer, scene) if not self.file(picture).exists()]
        if missing:
            self.render(renderer, missing)

    def reference(self, renderer: Renderer, scene: str) -> tuple[Floats, Floats]:
        """Mean of the parts, and the variance of that mean."""
        parts = [self.load(picture)[0] for picture in self.reference_pictures(renderer, scene)]
        return np.mean(parts, 0), np.var(parts, 0, ddof=1) / len(parts)

    def measure(self, renderer: Renderer, scene: str, samples: int, seeds: Iterable[int]) -> dict[str, Any]:
        """A row of the table, of pictures that are there."""
        low, samples = renderer.counts(samples)
        few, many = (
            [self.load((scene, renderer.label, count, seed)) for seed in seeds] if count else []
            for count in (low, samples)
        )
        mean, variance = self.reference(renderer, scene)
        scale = 1 / (mean**2 + 0.01)
        noise = float((variance * scale).mean())
        by_pixel = [((image - mean) ** 2 * scale).mean(-1) for image, _ in many]
        errors = [float(e.mean()) - noise for e in by_pixel]
        cpu_s = [np.median([cpu for _, cpu in images]) if images else 0.0 for images in (few, many)]
        cost_s = float(cpu_s[1] - cpu_s[0]) / (1 - low / samples)
        error = float(np.mean(errors))
        trimmed = float(np.mean([without_worst(e) for e in by_pixel]))
        return {
            "scene": scene,
            "renderer": renderer.label,
            "samples": samples,
            "relMSE": error,
            "relMSE of seeds": " ".join(f"{e:.3g}" for e in errors),
            "relMSE of the reference": noise,
            # With the reference's noise: how much of it lies in the pixels kept is not known.
            "relMSE without the worst": trimmed,
            "CPU s": cost_s,
            "Msamples per CPU s": samples * mean.shape[0] * mean.shape[1] / cost_s / 1e6,
            "efficiency": 1 / (error * cost_s),
            "efficiency without the worst": 1 / (trimmed * cost_s),
            "mean": float(mean.mean()),
        }

    def reference_pictures(self, renderer: Renderer, scene: str) -> list[Picture]:
        """The parts that a reference is the mean of."""
        samples = self.reference_samples[renderer.name] // REFERENCE_PARTS
        return [(scene, f"{renderer.name} reference", samples, 1000 + part) for part in range(REFERENCE_PARTS)]


def without_worst(errors: Floats) -> float:
    """Their mean without the worst hundredth, which may hold a few fireflies that say little of the rest."""
    ordered = np.sort(errors, axis=None)
    return float(ordered[: round((1 - WORST) * ordered.size)].mean())
