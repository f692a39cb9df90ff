"""The op that tells what a layer of dielectric leaves to what is beneath it."""

from __future__ import annotations

import numpy as np
import pivot_core
import pytest
from scenes import add_plane, place, render, set_camera

IOR, ALPHA = 1.7, 0.3


@pytest.mark.parametrize("multiscatter", [False, True])
@pytest.mark.parametrize("cosine", [1.0, 0.6, 0.2])
def test_it_leaves_what_it_does_not_reflect(cosine: float, multiscatter: bool) -> None:
    """As a base does to its diffuse lobe; and light goes the straight way through it after it was refracted."""
    program = pivot_core.Program()
    normal = program.add("normal", [])
    constants = [(-1, number) for number in (ALPHA, IOR, 1.0, 0.5, 0.25, float(multiscatter))]
    first = program.add("dielectric_layer", [*((normal + i, 0.0) for i in range(3)), *constants])
    shader = pivot_core.Shader(pivot_core.Material(), program, {"emission": [first, first + 1, -1]})
    scene = pivot_core.Scene()
    scene.add_instances("floor", add_plane(scene, 50.0), place(), [scene.add_material("floor", shader)])
    set_camera(scene, (0, -2 * np.sqrt(1 - cosine**2), 2 * cosine), size=(1, 1), half_width=1e-3)
    leaves, path = render(scene, samples=1, max_bounces=0)[0, 0, :2]

    layer = {
        "alpha": ALPHA,
        "dielectric_weight": 1,
        "dielectric_ior": IOR,
        "dielectric_tint": (1, 0.5, 0.25),
        "multiscatter": multiscatter,
    }
    wo = (0.0, -float(np.sqrt(1 - cosine**2)), cosine)
    over_white, alone = (pivot_core.Material(diffuse=(d,) * 3, **layer).albedo(wo) for d in (1, 0))
    assert leaves == pytest.approx(over_white[0] - alone[0], abs=0.002)
    if multiscatter:
        assert leaves == pytest.approx(1 - max(alone), abs=0.01)
    assert path == pytest.approx(1 / np.sqrt(1 - (1 - cosine**2) / IOR**2), rel=1e-3)
