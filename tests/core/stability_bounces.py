"""Renders by virtual lights where what lights a surface touches it, surrounds it, or is far, small or huge.

Held against what Monte Carlo's first bounce adds; scenes that are one scene at another scale or place against the same
at the origin in metres, to what cells of another size make of it.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

import numpy as np
import pivot_core

from tests.core.scenes import Floats, add_box, look_at
from tests.core.stability_scenes import EdgeRender

SIZE_PX = 12
VIRTUAL_LIGHTS = {"integrator": "ANALYTIC", "indirect": "VSGL", "samples": 16, "max_bounces": 1}
MONTE_CARLO = {"integrator": "MONTE_CARLO", "samples": 4096}


@dataclass(frozen=True)
class Contact:
    """A floor, diffuse or of metal of this alpha, close to the line where a lit wall stands on it; a second wall makes
    of it the ground of a slot 0.1 wide. Lengths are in units of `unit_m`, all of it moved by `far_m`."""

    name: str
    bound: float
    alpha: float | None = None
    is_slot: bool = False
    unit_m: float = 1.0
    far_m: float = 0.0

    def render(self, pass_name: str, **settings: object) -> Floats:
        """(SIZE_PX, SIZE_PX, 3)"""
        scene, unit, far = pivot_core.Scene(), self.unit_m, np.array([self.far_m, self.far_m, 0.0])
        chalk = pivot_core.Material(diffuse=(0.7,) * 3)
        metal = pivot_core.Material(alpha=self.alpha or 1.0, conductor_f0=(1.0,) * 3, conductor_f90=(1.0,) * 3)
        floor = scene.add_material("floor", metal if self.alpha else chalk)
        wall = scene.add_material("wall", chalk)
        matrix = np.diag([unit, unit, unit, 1.0]).astype(np.float32)
        matrix[:3, 3] = far
        boxes = [((-1, -1, -0.1), (1, 1, 0), floor), ((-1, 0.05, 0), (1, 1, 1), wall)]
        if self.is_slot:
            boxes.append(((-1, -1, 0), (1, -0.05, 0.3), wall))
        for low, high, material in boxes:
            scene.add_instances("box", add_box(scene, low, high), matrix[None], [material])
        lamp = tuple(unit * np.array([0.2, -0.5, 1.2]) + far)
        scene.add_light("lamp", pivot_core.SphereLight(lamp, 0.1 * unit, (unit * unit,) * 3))
        camera = look_at((0.0, -0.3, 1.0) if self.is_slot else (0.0, -1.0, 0.7), (0.0, 0.0, 0.0))
        camera[:3, 3] = unit * camera[:3, 3] + far
        window = (0, 0, SIZE_PX, SIZE_PX)
        scene.set_camera(camera, (-0.1, 0.1, -0.1, 0.1), SIZE_PX, SIZE_PX, window, 1e-3 * unit, 1e6 * unit)
        chosen = pivot_core.RenderSettings(pixel_filter="BOX", filter_width_px=1.0, **settings)
        session = pivot_core.Session(scene, chosen)
        session.start()
        while not session.wait(10.0):
            pass
        assert session.bad_samples == []
        return session.read(pass_name)[..., :3]

    def reference(self) -> Floats:
        if (self.unit_m, self.far_m) != (1.0, 0.0):
            return replace(self, unit_m=1.0, far_m=0.0).render("Indirect", **VIRTUAL_LIGHTS)
        both, direct = (self.render("Combined", max_bounces=bounces, **MONTE_CARLO) for bounces in (1, 0))
        return both - direct


# A wall that touches is off within half a cell of it, more so in a mirror, which sees that part alone.
SCENES = (
    Contact("lit wall touches a diffuse floor", 0.15),
    Contact("lit wall touches metal, alpha 1e-3", 0.4, alpha=1e-3),
    Contact("lit wall touches metal, alpha 0.1", 0.25, alpha=0.1),
    Contact("lit wall touches metal, alpha 1", 0.3, alpha=1.0),
    Contact("slot narrower than cells", 0.05, is_slot=True),
    # Cells go by powers of two: in other units they lie elsewhere, which moves no more than they are off themselves.
    Contact("contact in 2^-13 units", 1e-3, alpha=0.1, unit_m=2.0**-13),
    Contact("contact in 2^20 units", 1e-3, alpha=0.1, unit_m=2.0**20),
    Contact("contact in 0.7 units", 0.15, alpha=0.1, unit_m=0.7),
    Contact("contact 1e5 m from the origin", 0.1, alpha=0.1, far_m=1e5),
)


def bounce_renders() -> Iterator[EdgeRender]:
    for scene in SCENES:
        image, reference = scene.render("Indirect", **VIRTUAL_LIGHTS), scene.reference()
        error = float(np.sqrt(np.mean((image - reference) ** 2) / np.mean(reference**2)))
        is_light = bool(np.isfinite(image).all() and (image >= 0).all())
        yield EdgeRender(scene.name, "virtual lights", "4096 cells", error, scene.bound, is_light)
