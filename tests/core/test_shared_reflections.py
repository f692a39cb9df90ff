"""What a pixel's samples share of light that bounced: the light, and not the surface's own colours, nor another's."""

from __future__ import annotations

import time

import numpy as np
import pivot_core

from tests.core.scenes import Floats, add_box, add_plane, place, render, set_camera

WHITE = (1.0, 1.0, 1.0)
VSGL = {"integrator": "ANALYTIC", "indirect": "VSGL", "max_bounces": 1, "pixel_filter": "BOX", "filter_width_px": 1.0}


def stripes() -> pivot_core.Shader:
    """Of 2 mm, white and black by turns."""
    program = pivot_core.Program()
    scaled = program.add("math_multiply", [(program.add("position", []), 0.0), (-1, 1571.0)])
    wave = program.add("math_sine", [(scaled, 0.0)])
    white = program.add("math_greater_than", [(wave, 0.0), (-1, 0.0)])
    return pivot_core.Shader(pivot_core.Material(), program, {"diffuse": [white] * 3})


def corner(floor: pivot_core.Material | pivot_core.Shader, size: tuple[int, int] = (32, 24)) -> pivot_core.Scene:
    """A floor that a lit wall lights."""
    scene = pivot_core.Scene()
    chalk = scene.add_material("chalk", pivot_core.Material(diffuse=(0.7,) * 3))
    scene.add_instances("floor", add_plane(scene, 2.0), place(), [scene.add_material("floor", floor)])
    scene.add_instances("wall", add_box(scene, (-2, 1, 0), (2, 1.1, 2)), place(), [chalk])
    scene.add_light("lamp", pivot_core.SphereLight((0.3, -0.5, 1.5), 0.1, WHITE))
    set_camera(scene, (0.2, -2.5, 1.5), (0.0, 0.0, 0.0), size, 0.25)
    return scene


def indirect(scene: pivot_core.Scene, **settings: object) -> Floats:
    return render(scene, "Indirect", **(VSGL | settings))


def test_samples_keep_their_own_colours() -> None:
    """Stripes that are finer than a pixel are grey, as their samples say."""
    striped = indirect(corner(stripes()), samples=16)
    white = indirect(corner(pivot_core.Material(diffuse=WHITE)), samples=16)
    share = striped.mean(-1) / white.mean(-1)
    np.testing.assert_allclose(share.mean(), 0.5, rtol=0.02)
    assert share.std() < 0.2


def test_what_is_shared_is_what_each_sample_would_find() -> None:
    """One picture by four samples that share, and by pixels of their own; what stands for a pixel is from within a
    quarter of it, which shifts large ones."""
    grey = pivot_core.Material(diffuse=(0.5,) * 3, dielectric_weight=1.0, alpha=0.2)
    medians = []
    for width, height in ((32, 24), (96, 72)):
        shared = indirect(corner(grey, (width, height)), samples=4)
        each = indirect(corner(grey, (4 * width, 4 * height)), samples=1)
        fine = each.reshape(height, 4, width, 4, 3).mean((1, 3))
        medians.append(float(np.median(np.abs(shared - fine)) / fine.mean()))
    print(medians)
    assert medians[0] < 0.015
    assert medians[1] < 0.5 * medians[0]


def test_more_samples_of_a_pixel_cost_little() -> None:
    """Four cost little more than one, and eight as much as two."""
    grey = pivot_core.Material(diffuse=(0.5,) * 3, dielectric_weight=1.0, alpha=0.2)

    def cpu_s(samples: int) -> float:
        best = np.inf
        for _ in range(3):
            settings = pivot_core.RenderSettings(**VSGL, samples=samples, virtual_lights=256, threads=1)
            session = pivot_core.Session(corner(grey, (160, 120)), settings)
            began = time.process_time()
            session.start()
            assert session.wait(120)
            best = min(best, time.process_time() - began)
        return best

    once, four, eight = cpu_s(1), cpu_s(4), cpu_s(8)
    print(f"{once:.2f} {four:.2f} {eight:.2f} s")
    assert four < 2.5 * once
    assert eight < 5 * once
