"""Whether the Error pass of virtual lights holds where nobody fitted it.

`./run python tests/benchmark/virtual_lights_held_out.py`

Eight scenes that are not virtual_lights_scenes.py's, one bounce. A pixel is held where its error against Monte Carlo is
within what the pass predicts and twice the reference's own noise.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pivot_core
import virtual_lights_scenes as own
from virtual_lights_measure import Floats
from virtual_lights_scenes import ball, box, diffuse, metal, parts, plastic, sphere_light

SIZE = (96, 54)
LEAST_RADIANCE = 1e-3
BOX = {"pixel_filter": "BOX", "filter_width_px": 1.0, "max_bounces": 1}


def corridor() -> pivot_core.Scene:
    """Long and white, two lamps behind corners' worth of pillars."""
    scene = pivot_core.Scene()
    white, floor = diffuse(scene, (0.75, 0.75, 0.75)), plastic(scene, (0.3, 0.3, 0.35), 0.4)
    box(scene, (-1.0, -1.0, -0.1), (1.0, 9.0, 0.0), floor)
    box(scene, (-1.0, -1.0, 2.2), (1.0, 9.0, 2.3), white)
    box(scene, (-1.1, -1.0, -0.1), (-1.0, 9.0, 2.3), diffuse(scene, (0.7, 0.6, 0.3)))
    box(scene, (1.0, -1.0, -0.1), (1.1, 9.0, 2.3), white)
    box(scene, (-1.1, 9.0, -0.1), (1.1, 9.1, 2.3), white)
    for y in (2.0, 5.0):
        box(scene, (-1.0, y, 0.0), (-0.4, y + 0.4, 2.2), white)
    sphere_light(scene, (-0.7, 3.2, 1.8), 0.05, 40.0)
    sphere_light(scene, (0.5, 7.5, 1.9), 0.05, 40.0)
    parts.set_camera(scene, (0.4, -0.6, 1.3), (-0.1, 6.0, 1.0), SIZE, 0.6)
    return scene


def metals() -> pivot_core.Scene:
    """Metal among metal."""
    scene = pivot_core.Scene()
    box(scene, (-2.0, -2.0, -0.1), (2.0, 2.0, 0.0), metal(scene, (0.6, 0.6, 0.65), 0.5))
    box(scene, (-2.0, 1.5, 0.0), (2.0, 1.6, 1.6), metal(scene, (0.9, 0.6, 0.4), 0.35))
    ball(scene, (-0.6, 0.4, 0.4), 0.4, metal(scene, (0.9, 0.75, 0.4), 0.4))
    ball(scene, (0.5, 0.2, 0.3), 0.3, metal(scene, (0.8, 0.8, 0.8), 0.55))
    box(scene, (0.7, 0.7, 0.0), (1.2, 1.2, 0.9), metal(scene, (0.5, 0.7, 0.8), 0.45))
    sphere_light(scene, (0.2, -1.0, 2.0), 0.1, 120.0)
    parts.set_camera(scene, (0.3, -3.0, 1.2), (0.0, 0.5, 0.4), SIZE, 0.5)
    return scene


def sunlit() -> pivot_core.Scene:
    """Things on the ground under a sun."""
    scene = pivot_core.Scene()
    box(scene, (-5.0, -5.0, -0.1), (5.0, 5.0, 0.0), diffuse(scene, (0.5, 0.45, 0.4)))
    box(scene, (-1.0, 0.5, 0.0), (-0.2, 1.3, 0.9), diffuse(scene, (0.8, 0.3, 0.2)))
    ball(scene, (0.5, 0.6, 0.4), 0.4, plastic(scene, (0.2, 0.4, 0.7), 0.35))
    box(scene, (0.9, 1.2, 0.0), (1.5, 1.4, 1.3), metal(scene, (0.8, 0.8, 0.8), 0.4))
    sun = np.array([-0.5, -0.6, 0.7]) / np.linalg.norm([-0.5, -0.6, 0.7])
    scene.add_light("sun", pivot_core.SunLight(tuple(sun), 0.01, (3.0, 2.8, 2.5)))
    parts.set_camera(scene, (0.4, -2.6, 1.1), (0.1, 1.0, 0.4), SIZE, 0.5)
    return scene


def emissive() -> pivot_core.Scene:
    """A room that meshes light."""
    scene = pivot_core.Scene()
    white = diffuse(scene, (0.7, 0.7, 0.7))
    box(scene, (-1.5, -1.5, -0.1), (1.5, 1.5, 0.0), plastic(scene, (0.5, 0.4, 0.3), 0.45))
    box(scene, (-1.5, 1.5, 0.0), (1.5, 1.6, 2.0), white)
    box(scene, (-1.6, -1.5, 0.0), (-1.5, 1.5, 2.0), diffuse(scene, (0.2, 0.6, 0.3)))
    lamp = scene.add_material("lamp", pivot_core.Material(emission=(6.0, 5.0, 4.0)))
    scene.add_instances("panel", parts.add_box(scene, (-0.5, 0.2, 1.7), (0.3, 0.6, 1.75)), parts.place(), [lamp])
    scene.add_instances("globe", parts.add_sphere(scene, 8), parts.place(0.9, 0.8, 0.2, 0.2), [lamp])
    ball(scene, (-0.5, 0.7, 0.35), 0.35, metal(scene, (0.8, 0.8, 0.8), 0.4))
    parts.set_camera(scene, (0.4, -2.6, 1.1), (0.0, 0.6, 0.7), SIZE, 0.55)
    return scene


def touching() -> pivot_core.Scene:
    """A box and a ball on a floor at a wall, from nearby."""
    return _at_a_wall(lambda scene: diffuse(scene, (0.8, 0.8, 0.8)))


def polished() -> pivot_core.Scene:
    """The same on a floor of brushed metal."""
    return _at_a_wall(lambda scene: metal(scene, (0.8, 0.8, 0.8), 0.45))


def _at_a_wall(floor: Callable[[pivot_core.Scene], int]) -> pivot_core.Scene:
    """floor: makes its material."""
    scene = pivot_core.Scene()
    white = diffuse(scene, (0.8, 0.8, 0.8))
    box(scene, (-3.0, -3.0, -0.2), (3.0, 2.0, 0.0), floor(scene))
    box(scene, (-3.0, 2.0, -0.2), (3.0, 2.2, 2.5), white)
    box(scene, (-0.3, 1.2, 0.0), (0.3, 1.6, 0.5), diffuse(scene, (0.7, 0.3, 0.2)))
    ball(scene, (0.9, 1.4, 0.25), 0.25, white)
    sphere_light(scene, (0.5, -0.5, 2.2), 0.1, 150.0)
    parts.set_camera(scene, (0.6, -0.6, 0.8), (0.3, 1.9, 0.25), SIZE, 0.45)
    return scene


def stairs() -> pivot_core.Scene:
    """Steps below a spot that shines on the wall beside them."""
    scene = pivot_core.Scene()
    stone, wood = diffuse(scene, (0.6, 0.6, 0.55)), plastic(scene, (0.45, 0.25, 0.12), 0.4)
    box(scene, (-2.0, -2.0, -0.1), (2.0, 3.0, 0.0), stone)
    box(scene, (1.2, -2.0, 0.0), (1.3, 3.0, 3.0), stone)
    for k in range(6):
        box(scene, (0.0, 0.3 * k, 0.0), (1.2, 0.3 * k + 0.3, 0.18 * (k + 1)), wood)
    down = np.array([0.78, 0.1, -0.62]) / np.linalg.norm([0.78, 0.1, -0.62])
    spot = ((-0.8, 0.5, 2.4), 0.05, (20.0,) * 3, tuple(down), 0.8, 0.4)
    scene.add_light("spot", pivot_core.SpotLight(*spot))
    parts.set_camera(scene, (-1.4, -2.2, 1.5), (0.6, 0.9, 0.6), SIZE, 0.55)
    return scene


def sky() -> pivot_core.Scene:
    """A court of plastic and metal under an even sky."""
    scene = pivot_core.Scene()
    wall = diffuse(scene, (0.75, 0.55, 0.4))
    box(scene, (-1.5, -3.0, -0.1), (1.5, 1.5, 0.0), plastic(scene, (0.5, 0.5, 0.5), 0.5))
    box(scene, (-1.6, -3.0, 0.0), (-1.5, 1.5, 1.2), wall)
    box(scene, (1.5, -3.0, 0.0), (1.6, 1.5, 1.2), wall)
    box(scene, (-1.6, 1.5, 0.0), (1.6, 1.6, 1.2), wall)
    ball(scene, (0.3, 0.5, 0.35), 0.35, metal(scene, (0.8, 0.7, 0.5), 0.5))
    scene.set_world((0.8, 0.9, 1.1))
    parts.set_camera(scene, (0.2, -2.6, 1.6), (0.0, 0.6, 0.3), SIZE, 0.5)
    return scene


SCENES: tuple[Callable[[], pivot_core.Scene], ...] = (
    *(corridor, metals, emissive, touching),
    *(sunlit, polished, stairs, sky),
)


def read(scene: pivot_core.Scene, *passes: str, **settings: object) -> list[Floats]:
    session = pivot_core.Session(scene, pivot_core.RenderSettings(**(BOX | settings)))
    session.start()
    while not session.wait(10.0):
        pass
    return [session.read(name)[..., :3].mean(-1) for name in passes]


def monte_carlo(make: Callable[[], pivot_core.Scene], samples: int) -> tuple[Floats, Floats]:
    """The mean radiance, and its own relative noise."""
    settings = {"integrator": "MONTE_CARLO", "samples": samples // 2}
    parts_of = [read(make(), "Combined", seed=seed, **settings)[0] for seed in range(2)]
    mean = (parts_of[0] + parts_of[1]) / 2
    return mean, np.abs(parts_of[0] - parts_of[1]) / 2 / np.maximum(mean, LEAST_RADIANCE)


def check(make: Callable[[], pivot_core.Scene], samples: int) -> str:
    exact, noise = monte_carlo(make, samples)
    image, predicted = read(make(), "Combined", "Error", integrator="ANALYTIC", indirect="VSGL", samples=8)
    error = np.abs(image - exact) / np.maximum(exact, LEAST_RADIANCE)
    held = (error <= predicted + 2 * noise).mean()
    return f"error {error.mean():.4f}, predicted {predicted.mean():.4f}, held in {100 * held:.1f} % of the pixels"


def main() -> None:
    own.SIZE = SIZE
    for make in SCENES:
        print(f"{make.__name__:9} {check(make, 1024)}", flush=True)


if __name__ == "__main__":
    main()
