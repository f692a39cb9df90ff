"""Small scenes built straight through pivot_core, for tests of the core without Blender."""

from __future__ import annotations

import numpy as np
import pivot_core
from numpy.typing import NDArray

Floats = NDArray[np.float32]


def add_sphere(scene: pivot_core.Scene, rings: int = 64) -> int:
    """A unit sphere with smooth normals; returns the mesh id."""
    theta, phi = np.meshgrid(np.linspace(0, np.pi, rings + 1), np.linspace(0, 2 * np.pi, 2 * rings + 1), indexing="ij")
    points = np.stack([np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi), np.cos(theta)], -1)
    vertices = points.reshape(-1, 3).astype(np.float32)
    row = 2 * rings + 1
    a = (np.arange(rings)[:, None] * row + np.arange(2 * rings)[None, :]).ravel()
    triangles = np.concatenate([np.stack([a, a + row, a + row + 1], 1), np.stack([a, a + row + 1, a + 1], 1)])
    corners = triangles.ravel()
    return scene.add_mesh(
        "sphere", vertices, corners, np.arange(len(corners)).reshape(-1, 3), corner_normals=vertices[corners]
    )


def add_plane(scene: pivot_core.Scene, half_extent_m: float = 100.0) -> int:
    """A square in z = 0 that faces up; returns the mesh id."""
    e = half_extent_m
    vertices = np.array([[-e, -e, 0], [e, -e, 0], [e, e, 0], [-e, e, 0]], np.float32)
    return scene.add_mesh("plane", vertices, np.arange(4), np.array([[0, 1, 2], [0, 2, 3]]))


def add_box(scene: pivot_core.Scene, low: tuple[float, float, float], high: tuple[float, float, float]) -> int:
    """From corner to corner, flat, facing outwards; returns the mesh id."""
    vertices = np.array([[(low, high)[i >> axis & 1][axis] for axis in range(3)] for i in range(8)], np.float32)
    faces = np.array([[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]])
    triangles = np.arange(24).reshape(6, 4)[:, [0, 1, 2, 0, 2, 3]].reshape(-1, 3)
    return scene.add_mesh("box", vertices, faces.ravel(), triangles)


def place(x: float = 0.0, y: float = 0.0, z: float = 0.0, scale: float = 1.0) -> Floats:
    """One instance's object_to_world, (1, 4, 4)."""
    matrix = np.diag([scale, scale, scale, 1.0]).astype(np.float32)
    matrix[:3, 3] = x, y, z
    return matrix[None]


def look_at(eye: tuple[float, float, float], target: tuple[float, float, float]) -> Floats:
    """camera_to_world of a camera at eye, (4, 4)."""
    z = np.subtract(eye, target).astype(float)
    z /= np.linalg.norm(z)
    x = np.cross([0.0, 0.0, 1.0] if abs(z[2]) < 0.999 else [0.0, 1.0, 0.0], z)
    x /= np.linalg.norm(x)
    matrix = np.eye(4, dtype=np.float32)
    matrix[:3, :3] = np.stack([x, np.cross(z, x), z], 1)
    matrix[:3, 3] = eye
    return matrix


def set_camera(
    scene: pivot_core.Scene,
    eye: tuple[float, float, float],
    target: tuple[float, float, float] = (0.0, 0.0, 0.0),
    size: tuple[int, int] = (64, 64),
    half_width: float = 0.4,
    **settings: object,
) -> None:
    """half_width: of the view plane at distance 1. settings: others of Scene.set_camera."""
    width, height = size
    half_height = half_width * height / width
    plane = (-half_width, half_width, -half_height, half_height)
    scene.set_camera(look_at(eye, target), plane, width, height, **settings)


def render(scene: pivot_core.Scene, pass_name: str = "Combined", **settings: object) -> Floats:
    """The pass as (height, width, channels)."""
    session = pivot_core.Session(scene, pivot_core.RenderSettings(**settings))
    session.start()
    while not session.wait(10.0):
        pass
    assert session.bad_samples == []
    return session.read(pass_name)
