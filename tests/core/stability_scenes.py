"""Whole renders at the edge of what floats hold: scenes of a plane, lit hard, by both integrators.

Held against Monte Carlo by light samples alone, which knows nothing of the lobe; scenes that are one scene at another
scale or place are held against the same at the origin in metres.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import pivot_core

from tests.core import ndf_pictures
from tests.core.scenes import Floats, add_plane, look_at

SIZE_PX = 12
REFERENCE_SAMPLES = 4096
ANALYTIC = {"integrator": "ANALYTIC", "error_budget_percent": 2.0, "samples": 64}
MONTE_CARLO = {"integrator": "MONTE_CARLO", "light_sampling": "JOINT", "samples": 256}
INTEGRATORS = (
    ("analytic", "AUTO, 2 %", ANALYTIC, 0.02),
    ("Monte Carlo", f"JOINT, {MONTE_CARLO['samples']} samples", MONTE_CARLO, 0.03),
)


@dataclass(frozen=True)
class EdgeScene:
    """A GGX plane in z = 0 under a sphere light; lengths are in units of `unit_m`, all of it moved by `far_m`.

    picture: of its microfacets, in the place of alpha, by name.
    """

    name: str
    alpha: float = 0.3
    light: tuple[float, float, float] = (0.0, 1.0, 1.0)
    radius_m: float = 0.5
    eye: tuple[float, float, float] = (0.0, -2.0, 2.0)
    unit_m: float = 1.0
    far_m: float = 0.0
    picture: str = ""

    def material(self) -> pivot_core.Material:
        white = (1.0, 1.0, 1.0)
        if not self.picture:
            return pivot_core.Material(alpha=self.alpha, conductor_f0=white, conductor_f90=white)
        ndf = pivot_core.TabulatedNdf(ndf_pictures.sharp(self.picture))
        lobe = {"ndf": ndf, "conductor_f0": white, "conductor_f90": white}
        return pivot_core.Material(lobes=[("tabulated", lobe)])

    def render(self, **settings: object) -> Floats:
        """(SIZE_PX, SIZE_PX, 3)"""
        unit, offset = self.unit_m, np.array([self.far_m, self.far_m, 0.0])
        scene = pivot_core.Scene()
        plane = np.diag([unit, unit, unit, 1.0]).astype(np.float32)
        plane[:3, 3] = offset
        scene.add_instances("plane", add_plane(scene), plane[None], [scene.add_material("m", self.material())])
        position = tuple(unit * np.array(self.light) + offset)
        intensity = (unit * unit * self.radius_m**2,) * 3  # a radiance of 1 / pi
        scene.add_light("light", pivot_core.SphereLight(position, unit * self.radius_m, intensity))
        camera = look_at(self.eye, (0.0, 0.0, 0.0))
        camera[:3, 3] = unit * camera[:3, 3] + offset
        window = (0, 0, SIZE_PX, SIZE_PX)
        scene.set_camera(camera, (-0.3, 0.3, -0.3, 0.3), SIZE_PX, SIZE_PX, window, 1e-3 * unit, 1e6 * unit)
        chosen = pivot_core.RenderSettings(max_bounces=0, pixel_filter="BOX", filter_width_px=1.0, **settings)
        session = pivot_core.Session(scene, chosen)
        session.start()
        while not session.wait(10.0):
            pass
        assert session.bad_samples == []
        return session.read("Combined")[..., :3]

    def in_metres(self) -> EdgeScene:
        return EdgeScene(self.name, self.alpha, self.light, self.radius_m, self.eye)


@dataclass(frozen=True)
class EdgeRender:
    """error: root mean square, over the reference's own. bound: the analytic's error budget, Monte Carlo's noise, or
    what rounding the scene's coordinates may do."""

    scene: str
    integrator: str
    settings: str
    error: float
    bound: float
    is_finite: bool


SCENES = (
    EdgeScene("receiver touches the light", light=(0.0, 0.0, 0.5)),
    EdgeScene("receiver inside the light", light=(0.0, 0.0, 0.3), radius_m=3.0),
    EdgeScene("plane cuts the light", light=(0.0, 0.5, 0.1)),
    EdgeScene("light across the horizon", light=(0.0, 8.0, 0.5), radius_m=2.0),
    EdgeScene("light surrounds the view", light=(0.0, -2.0, 2.0), radius_m=2.5, eye=(0.0, -0.1, 0.1)),
    EdgeScene("grazing view", eye=(0.0, -5.0, 0.1)),
    EdgeScene("mirror, alpha 1e-3", alpha=1e-3),
    EdgeScene("alpha 1", alpha=1.0),
    EdgeScene("light of 1e-5 m", radius_m=1e-5),
    EdgeScene("scene in 1e-4 units", unit_m=1e-4),
    EdgeScene("scene in 1e6 units", unit_m=1e6),
    EdgeScene("1e5 m from the origin", far_m=1e5),
    EdgeScene("microfacets of one pixel", picture="pixel"),
    EdgeScene("microfacets of one tilted pixel", picture="tilted pixel"),
)


def edge_renders() -> Iterator[EdgeRender]:
    for scene in SCENES:
        is_moved = (scene.unit_m, scene.far_m) != (1.0, 0.0)
        truth = None if is_moved else scene.render(light_sampling="MIS", samples=REFERENCE_SAMPLES, seed=1)
        for integrator, described, settings, bound in INTEGRATORS:
            image = scene.render(**settings)
            if truth is None:  # a float holds 1e5 m to 8 mm, 0.3 % of what stands 2.8 m away
                reference, bound = scene.in_metres().render(**settings), 3e-3 if scene.far_m else 1e-5
            else:
                reference = truth
                if scene.picture:  # their sharp rims are within pixels: noise of the reference too
                    bound *= 2
            error = float(np.sqrt(np.mean((image - reference) ** 2) / np.mean(reference**2)))
            yield EdgeRender(scene.name, integrator, described, error, bound, bool(np.isfinite(image).all()))
