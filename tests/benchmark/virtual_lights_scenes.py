"""The scenes of virtual_lights.py, made with pivot_core alone.

`camera` and `light` move either a little: 0 is the first frame, 1 the last.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pivot_core

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "core"))
import scenes as parts

SIZE = (320, 180)
Triple = tuple[float, float, float]


def diffuse(scene: pivot_core.Scene, color: Triple) -> int:
    return scene.add_material("diffuse", pivot_core.Material(diffuse=color))


def metal(scene: pivot_core.Scene, color: Triple, roughness: float) -> int:
    return scene.add_material(
        "metal",
        pivot_core.Material(conductor_f0=color, conductor_f90=(1, 1, 1), alpha=roughness**2, multiscatter=True),
    )


def plastic(scene: pivot_core.Scene, color: Triple, roughness: float) -> int:
    return scene.add_material(
        "plastic", pivot_core.Material(diffuse=color, dielectric_weight=1.0, alpha=roughness**2, multiscatter=True)
    )


def box(scene: pivot_core.Scene, low: Triple, high: Triple, material: int) -> None:
    scene.add_instances("box", parts.add_box(scene, low, high), parts.place(), [material])


def ball(scene: pivot_core.Scene, center: Triple, radius: float, material: int) -> None:
    scene.add_instances("ball", parts.add_sphere(scene, 32), parts.place(*center, radius), [material])


def sphere_light(scene: pivot_core.Scene, center: Triple, radius: float, watts: float) -> None:
    intensity = watts / (4 * np.pi)
    scene.add_light("lamp", pivot_core.SphereLight(center, radius, (intensity,) * 3))


def floor_and_wall(camera: float = 0.0, light: float = 0.0) -> pivot_core.Scene:
    """A glossy floor before a coloured wall, a ball between them."""
    scene = pivot_core.Scene()
    floor, wall = metal(scene, (0.8, 0.8, 0.8), 0.45), diffuse(scene, (0.8, 0.25, 0.1))
    box(scene, (-3.0, -3.0, -0.2), (3.0, 2.0, 0.0), floor)
    box(scene, (-3.0, 2.0, -0.2), (3.0, 2.2, 2.5), wall)
    box(scene, (-3.2, -3.0, -0.2), (-3.0, 2.2, 2.5), diffuse(scene, (0.1, 0.3, 0.7)))
    ball(scene, (0.6, 0.6, 0.5), 0.5, plastic(scene, (0.7, 0.7, 0.7), 0.4))
    sphere_light(scene, (0.5 + 0.4 * light, -0.5, 2.2), 0.1, 150.0)
    parts.set_camera(scene, (1.2 + 0.3 * camera, -4.0, 1.4), (-0.4, 1.0, 0.6), SIZE, 0.6)
    return scene


def facing_planes(camera: float = 0.0, light: float = 0.0) -> pivot_core.Scene:
    """Two glossy planes that face each other, a spot between them that shines on one."""
    scene = pivot_core.Scene()
    gold, silver = metal(scene, (0.9, 0.7, 0.35), 0.4), metal(scene, (0.85, 0.85, 0.9), 0.5)
    box(scene, (-1.2, -2.0, 0.0), (-1.0, 2.0, 2.0), gold)
    box(scene, (1.0, -2.0, 0.0), (1.2, 2.0, 2.0), silver)
    box(scene, (-1.2, -2.0, -0.2), (1.2, 2.0, 0.0), diffuse(scene, (0.6, 0.6, 0.6)))
    intensity = (200.0 / (4 * np.pi),) * 3
    direction = np.array([-1.0, 0.3, -0.4]) / np.linalg.norm([-1.0, 0.3, -0.4])
    scene.add_light(
        "spot", pivot_core.SpotLight((0.6, -0.4 + 0.3 * light, 1.4), 0.05, intensity, tuple(direction), 0.8, 0.5)
    )
    parts.set_camera(scene, (0.2 * camera, -3.6, 1.6), (0.0, 0.2, 0.7), SIZE, 0.6)
    return scene


def add_ring(scene: pivot_core.Scene, radius: float, height: float, segments: int = 128) -> int:
    """The wall of a cylinder about z, smooth, facing inwards."""
    phi = np.linspace(0, 2 * np.pi, segments + 1)
    rim = np.stack([radius * np.cos(phi), radius * np.sin(phi)], 1)
    vertices = np.concatenate([np.insert(rim, 2, 0.0, axis=1), np.insert(rim, 2, height, axis=1)]).astype(np.float32)
    a = np.arange(segments)
    n = segments + 1
    triangles = np.concatenate([np.stack([a, a + n, a + 1], 1), np.stack([a + 1, a + n, a + n + 1], 1)])
    normals = -np.insert(np.concatenate([rim, rim]) / radius, 2, 0.0, axis=1).astype(np.float32)
    corners = triangles.ravel()
    return scene.add_mesh(
        "ring", vertices, corners, np.arange(len(corners)).reshape(-1, 3), corner_normals=normals[corners]
    )


def caustic_ring(camera: float = 0.0, light: float = 0.0) -> pivot_core.Scene:
    """The caustic that a metal ring throws on the floor within it."""
    scene = pivot_core.Scene()
    box(scene, (-4.0, -4.0, -0.2), (4.0, 4.0, 0.0), diffuse(scene, (0.7, 0.7, 0.7)))
    scene.add_instances("ring", add_ring(scene, 1.0, 0.7), parts.place(), [metal(scene, (0.9, 0.75, 0.4), 0.25)])
    sphere_light(scene, (-2.2, 1.5 - 0.3 * light, 2.6), 0.1, 300.0)
    parts.set_camera(scene, (0.3 * camera, -2.6, 2.8), (0.0, 0.1, 0.0), SIZE, 0.5)
    return scene


def interior(camera: float = 0.0, light: float = 0.0) -> pivot_core.Scene:
    """A furnished room, an area light at the window and a lamp."""
    scene = pivot_core.Scene()
    white, red = diffuse(scene, (0.75, 0.73, 0.7)), diffuse(scene, (0.6, 0.12, 0.1))
    wood, steel = plastic(scene, (0.4, 0.22, 0.1), 0.45), metal(scene, (0.8, 0.8, 0.8), 0.4)
    box(scene, (-2.2, -3.2, -0.2), (2.2, 2.7, 0.0), wood)
    box(scene, (-2.2, -3.2, 2.5), (2.2, 2.7, 2.7), white)
    box(scene, (-2.2, 2.5, 0.0), (2.2, 2.7, 2.5), white)
    box(scene, (-2.2, -3.2, 0.0), (2.2, -3.0, 2.5), white)
    box(scene, (-2.2, -3.0, 0.0), (-2.0, 2.5, 2.5), red)
    box(scene, (2.0, -3.0, 0.0), (2.2, 2.5, 2.5), white)
    box(scene, (-0.6, 0.6, 0.68), (1.4, 1.5, 0.74), wood)  # a table
    for x in (-0.55, 1.29):
        for y in (0.65, 1.39):
            box(scene, (x, y, 0.0), (x + 0.06, y + 0.06, 0.68), steel)
    box(scene, (-1.9, 1.2, 0.0), (-1.3, 2.4, 1.7), white)  # a shelf
    box(scene, (-0.3, -0.6, 0.0), (0.3, 0.0, 0.45), red)  # a stool
    ball(scene, (0.2, 1.0, 0.94), 0.2, steel)
    ball(scene, (0.9, 1.1, 0.89), 0.15, plastic(scene, (0.1, 0.4, 0.5), 0.3))
    area = pivot_core.AreaLight((1.95, -0.5 + 0.3 * light, 1.5), (0.0, 0.6, 0.0), (0.0, 0.0, 0.5), (12.0, 13.0, 14.0))
    scene.add_light("window", area)
    sphere_light(scene, (-0.9, 0.9, 2.0), 0.08, 25.0)
    parts.set_camera(scene, (0.9 + 0.3 * camera, -2.7, 1.5), (-0.1, 0.8, 0.9), SIZE, 0.75)
    return scene


SCENES: dict[str, Callable[[float, float], pivot_core.Scene]] = {
    "floor_and_wall": floor_and_wall,
    "facing_planes": facing_planes,
    "caustic_ring": caustic_ring,
    "interior": interior,
}
