"""Passes, samples, pause and denoising in the Rendered viewport: viewport_pass_case.py -- FOLDER LIBRARY.

A white floor at z = 0, seen from above at 4 m, and a square half as near that shines red on the right. LIBRARY: Open
Image Denoise's, or "". Writes FOLDER/result.json, and of what the screen shows FOLDER/*.npy.
"""

from __future__ import annotations

import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

# isort: split
import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent))
import parts
import window

LIBRARY = sys.argv[sys.argv.index("--") + 2]
LATEST_S = 20.0
PASSES = ("COMBINED", "DEPTH", "NORMAL", "DIFFUSE_COLOR", "EMISSION", "INDIRECT", "METHOD", "ERROR")


def steps() -> Iterator[Callable[[], bool]]:
    window.clear()
    yield window.now
    import pivot.denoise as denoise

    if LIBRARY:
        denoise._candidates = lambda: iter([LIBRARY])
    module: Any = sys.modules["pivot.viewport"]
    viewports, module = window.Viewports(), sys.modules["pivot.viewport"]
    draw_picture = module.draw_picture  # type: ignore[attr-defined]
    shown: list[Any] = [None]

    def watched_picture(engine: Any, scene: Any, picture: Any, view: Any) -> None:
        draw_picture(engine, scene, picture, view)
        shown[0] = picture

    module.draw_picture = watched_picture  # type: ignore[attr-defined]
    main, area = window.view()
    scene, space = main.scene, area.spaces.active
    floor = parts.quad("floor", (0, 0, 0), parts.shaded("white", "ShaderNodeBsdfDiffuse", Color=(0.8, 0.8, 0.8, 1))[0])
    floor.scale = (20, 20, 1)
    lamp = parts.shaded("red", "ShaderNodeEmission", Color=(1, 0, 0, 1), Strength=5)[0]
    parts.quad("lamp", (1.2, 0, 2), lamp).scale = (0.5, 0.5, 1)
    parts.quad("lid", (-1.2, 0, 1), floor.active_material).scale = (0.6, 0.6, 1)
    parts.light("light", "POINT", (-2, 1, 3), energy=150.0)
    scene.render.engine, scene.view_settings.view_transform = "PIVOT", "Standard"
    scene.pivot.samples, scene.pivot.preview_samples = 64, 2
    space.overlay.show_overlays = space.show_gizmo = False
    space.region_3d.view_perspective, space.region_3d.view_rotation = "PERSP", (1, 0, 0, 0)
    space.region_3d.view_location, space.region_3d.view_distance = (0, 0, 0), 4
    space.shading.type = "RENDERED"
    result: dict[str, Any] = {}

    def kept(name: str, settle_s: float = 0.3) -> Callable[[], bool]:
        """What is shown once the viewport rests."""
        since_s = time.monotonic()

        def done() -> bool:
            waited_s = time.monotonic() - since_s
            if waited_s < settle_s or (not viewports.rest() and waited_s < LATEST_S):
                return False
            texture = shown[0].texture
            pixels = np.array(texture.read().to_list(), np.float32).reshape(texture.height, texture.width, -1)
            np.save(window.FOLDER / f"{name}.npy", pixels)
            result[name] = {"samples": viewports.any._session.samples_done, "rests": viewports.rest()}
            return True

        return done

    for space.shading.pivot.render_pass in PASSES:
        yield kept(space.shading.pivot.render_pass.lower())
    scene.pivot.integrator = "ANALYTIC"
    for space.shading.pivot.render_pass in ("METHOD", "ERROR", "COMBINED"):
        yield kept(f"analytic {space.shading.pivot.render_pass.lower()}")
    scene.pivot.integrator = "MONTE_CARLO"

    scene.pivot.preview_pause = True
    space.region_3d.view_distance = 5
    yield window.after(0.5)
    result["paused"] = {"renders": viewports.any._session is not None}
    space.region_3d.view_distance = 4
    scene.pivot.preview_pause = False
    yield kept("resumed")
    scene.pivot.preview_samples = 32
    yield kept("converged")
    scene.pivot.preview_samples = 2
    result["has denoiser"] = denoise.is_there()
    for scene.pivot.denoise_viewport in ("ALL", "INDIRECT", "NONE"):
        yield kept(f"denoise {scene.pivot.denoise_viewport.lower()}")
    floor.is_shadow_catcher = True
    parts.world((0.5, 0.25, 0.125))
    scene.pivot.preview_samples = 8
    yield kept("catcher")
    window.write(result)


window.follow(steps(), deadline_s=140.0)
