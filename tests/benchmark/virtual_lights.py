"""Light by way of other surfaces, against Monte Carlo: `./run python tests/benchmark/virtual_lights.py`

Four scenes, 320 x 180, one bounce. relMSE is against Monte Carlo's picture of many samples, CPU with the lights' own.
With `frames`, how still pictures are while a light or the camera moves. What Cycles needs: virtual_lights_cycles.py.
"""

from __future__ import annotations

import argparse
import time
from pathlib import Path

import numpy as np
import pivot_core
from virtual_lights_measure import Floats, flicker, relmse
from virtual_lights_scenes import SCENES

CACHE = Path(__file__).resolve().parents[2] / "build" / "virtual_lights"
COUNTS = (256, 1024, 4096, 16384)
FRAMES = 24


def render(scene: pivot_core.Scene, pass_name: str = "Combined", **settings: object) -> tuple[Floats, float, int]:
    """The pass, CPU seconds, and how many virtual lights there were."""
    began = time.process_time()
    session = pivot_core.Session(scene, pivot_core.RenderSettings(**settings))
    session.start()
    while not session.wait(10.0):
        pass
    return session.read(pass_name)[..., :3], time.process_time() - began, session.virtual_lights[0]


def analytic(
    name: str, pass_name: str = "Combined", camera: float = 0.0, light: float = 0.0, **settings: object
) -> tuple[Floats, float, int]:
    values = {"integrator": "ANALYTIC", "indirect": "VSGL", "max_bounces": 1, "samples": 2} | settings
    return render(SCENES[name](camera, light), pass_name, **values)


def reference(name: str, samples: int) -> Floats:
    """Kept, as it takes minutes."""
    path = CACHE / f"{name}_{samples}.npy"
    if not path.exists():
        CACHE.mkdir(parents=True, exist_ok=True)
        np.save(path, render(SCENES[name](0.0, 0.0), integrator="MONTE_CARLO", max_bounces=1, samples=samples)[0])
    return np.load(path)


def compare(name: str, samples: int) -> None:
    truth = reference(name, samples)
    none, none_s, _ = analytic(name, indirect="NONE")
    without = relmse(none, truth)
    print(f"{name:15} no indirect light              relMSE {without:.5f}            {none_s:6.2f} s CPU")
    rows = [(f"{count} cells", {"virtual_lights": count}) for count in COUNTS]
    rows += [("4096 cells, 1 sample", {"samples": 1}), ("4096 cells, 4 samples", {"samples": 4})]
    rows += [
        ("4096 cells, [Tokuyoshi24]", {"virtual_light_method": "WIDENED"}),
        ("4096 cells, [Tokuyoshi15]", {"virtual_light_method": "ANISOTROPIC"}),
    ]
    rows += [("4096 cells, no shadow rays", {"occlusion": "NONE"})]
    for label, settings in rows:
        picture, cpu_s, lights = analytic(name, **settings)
        error = relmse(picture, truth)
        print(
            f"{name:15} {label:30} relMSE {error:.5f} ({without / error:5.1f} x) {cpu_s:6.2f} s CPU, {lights} lights",
            flush=True,
        )


def watch(name: str) -> None:
    for what in ("camera", "light"):
        frames = [analytic(name, "Indirect", **{what: k / (FRAMES - 1)}, samples=1)[0] for k in range(FRAMES)]
        mean = float(analytic(name, samples=1)[0].mean())
        print(f"{name:15} {FRAMES} frames, the {what} moves: {100 * flicker(frames) / mean:.2f} %", flush=True)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("scenes", nargs="*", default=list(SCENES))
    parser.add_argument("--samples", type=int, default=4096, help="of the reference")
    parser.add_argument("--frames", action="store_true", help="how still pictures are, too")
    arguments = parser.parse_args()
    for name in arguments.scenes:
        compare(name, arguments.samples)
        if arguments.frames:
            watch(name)


if __name__ == "__main__":
    main()
