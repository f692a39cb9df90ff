"""A full frame by the analytic integrator through the addon, beside Cycles at the same error.

    ./run python tests/benchmark/full_frame.py

1920 x 1080, 25 spheres of all roughness under three lights. relMSE is measured at a quarter of the width against each
renderer's converged picture; Cycles takes as many samples as bring it to Pivot's; CPU seconds are of the full frame.
Workbench and EEVEE are timed where they start.
"""

from __future__ import annotations

import importlib
import os
import time
from typing import Any

import bpy

# isort: split
import addon_utils
import monte_carlo_blender
import monte_carlo_scenes

FULL_PX, SMALL_PX = 1920, 480
REFERENCE_PARTS, REFERENCE_SAMPLES = 4, 128


def main() -> None:
    monte_carlo_blender.build(monte_carlo_scenes.SCENES["balls"])
    addon = addon_utils.enable("pivot")
    renderers = importlib.import_module(f"{addon.__name__}.chart.renderers")
    errors = importlib.import_module(f"{addon.__name__}.chart.errors")
    scene = bpy.context.scene
    scene.render.resolution_x, scene.render.resolution_y = 16, 9

    analytic: list[tuple[str, dict[str, Any]]] = [
        (
            f"Pivot, analytic at {budget:g} %, {occlusion}",
            {"integrator": "ANALYTIC", "error_budget": budget, "occlusion": occlusion},
        )
        for budget in (2.0, 5.0)
        for occlusion in ("RAY_TRACED", "NONE")
    ]
    found: dict[str, float] = {}

    def small_pivot(render: Any) -> None:
        reference = errors.Reference.of_parts([render({}, REFERENCE_SAMPLES, s)[0] for s in range(REFERENCE_PARTS)])
        for name, settings in analytic:
            found[name] = reference.rel_mse(render(settings, 1, 0)[0])

    def full_pivot(render: Any) -> None:
        for name, settings in analytic:
            print(f"{name:44} relMSE {found[name]:9.3g}   CPU {render(settings, 1, 0)[1]:7.2f} s", flush=True)

    renderers.set_size(scene, SMALL_PX)
    renderers.with_pivot(scene, small_pivot)
    renderers.set_size(scene, FULL_PX)
    renderers.with_pivot(scene, full_pivot)

    samples = [1]

    def small_cycles(render: Any) -> None:
        reference = errors.Reference.of_parts([render({}, REFERENCE_SAMPLES, 9 + s)[0] for s in range(REFERENCE_PARTS)])
        target = found[analytic[0][0]]
        while samples[0] < 1024 and reference.rel_mse(render({}, samples[0], 0)[0]) > target:
            samples[0] *= 2

    def full_cycles(render: Any) -> None:
        print(
            f"{'Cycles':44} {samples[0]} samples for that relMSE   CPU {render({}, samples[0], 0)[1]:7.2f} s",
            flush=True,
        )

    renderers.set_size(scene, SMALL_PX)
    renderers.with_cycles(scene, small_cycles)
    renderers.set_size(scene, FULL_PX)
    renderers.with_cycles(scene, full_cycles)

    for engine in ("BLENDER_WORKBENCH", "BLENDER_EEVEE_NEXT", "BLENDER_EEVEE"):
        try:
            scene.render.engine = engine
            start_s = time.process_time()
            bpy.ops.render.render(scene=scene.name)
            print(f"{engine:44} CPU {time.process_time() - start_s:7.2f} s", flush=True)
        except (TypeError, RuntimeError) as error:
            print(f"{engine:44} does not start: {str(error).splitlines()[0][:60]}", flush=True)


if __name__ == "__main__":
    main()
    os._exit(0)  # some Blenders crash at exit while classes are registered
