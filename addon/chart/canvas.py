"""Lines, dots and text as a picture: flat shapes that shine, rendered by the core; text as Blender's own outlines.

Neither matplotlib nor a GPU is there in a background Blender. Pixels, x right and y up from the bottom left.
"""

from __future__ import annotations

import itertools
from collections.abc import Sequence
from types import ModuleType

import bpy
import numpy as np
from numpy.typing import NDArray

from ..export.mesh import mesh_arrays
from ..srgb import linear_from_srgb
from .pixels import to_bytes

Floats = NDArray[np.float64]
Color = tuple[float, float, float]  # sRGB, 0..1

_DISTANCE_PX = 1e4  # of the camera
_LAYER_PX = 1.0  # between shapes drawn before and after
_SAMPLES = 16


class Canvas:
    """What is drawn later covers what was drawn before."""

    def __init__(self, core: ModuleType, width: int, height: int, paper: Color = (1.0, 1.0, 1.0)) -> None:
        self.width, self.height = width, height
        self._core = core
        self._scene = core.Scene()
        self._paper = linear_from_srgb(np.array(paper))
        self._depth_px = 0.0
        self._images: list[tuple[int, int, Floats]] = []

    def polygon(self, points: Sequence[tuple[float, float]] | Floats, color: Color) -> None:
        """A convex one."""
        corners = np.arange(1, len(points) - 1)
        self._add(np.asarray(points, float), np.stack([np.zeros_like(corners), corners, corners + 1], 1), color)

    def rectangle(self, x: float, y: float, width: float, height: float, color: Color) -> None:
        self.polygon([(x, y), (x + width, y), (x + width, y + height), (x, y + height)], color)

    def dot(self, x: float, y: float, radius: float, color: Color) -> None:
        turn = np.linspace(0, 2 * np.pi, 24, endpoint=False)
        self.polygon(np.stack([x + radius * np.cos(turn), y + radius * np.sin(turn)], 1), color)

    def line(self, points: Sequence[tuple[float, float]], width: float, color: Color) -> None:
        """Through the points, with round joints."""
        path = np.asarray(points, float)
        for a, b in itertools.pairwise(path):
            length = np.hypot(*(b - a))
            if length > 0:
                side = width / 2 * np.array([a[1] - b[1], b[0] - a[0]]) / length
                self.polygon(np.array([a - side, b - side, b + side, a + side]), color)
        if width > 1:
            for x, y in path:
                self.dot(x, y, width / 2, color)

    def text(self, x: float, y: float, body: str, size: float, color: Color, align: str = "LEFT") -> None:
        """y: the base line. align: LEFT, CENTER or RIGHT of x."""
        curve = bpy.data.curves.new("text", "FONT")
        curve.body, curve.size, curve.align_x, curve.resolution_u = body, size, align, 3
        holder = bpy.data.objects.new("text", curve)
        try:
            mesh = holder.to_mesh()
            arrays = mesh_arrays(mesh) if len(mesh.polygons) else None
        finally:
            bpy.data.objects.remove(holder)
            bpy.data.curves.remove(curve)
        if arrays is not None:
            self._add(arrays.positions[:, :2] + (x, y), arrays.corner_vertices[arrays.triangle_corners], color)

    def image(self, x: int, y: int, linear_rgb: Floats) -> None:
        """A picture (height, width, 3), bottom row first, its bottom left at (x, y); over all shapes."""
        self._images.append((x, y, linear_rgb))

    def _add(self, points: Floats, triangles: NDArray[np.integer], color: Color) -> None:
        self._depth_px += _LAYER_PX
        nearer = 1 - self._depth_px / _DISTANCE_PX  # what is nearer is drawn smaller, and seen at its place
        positions = np.column_stack([points * nearer, np.full(len(points), self._depth_px)]).astype(np.float32)
        corners = np.ascontiguousarray(triangles, np.int32).ravel()
        mesh = self._scene.add_mesh("shape", positions, corners, np.arange(len(corners), dtype=np.int32).reshape(-1, 3))
        emission = tuple(float(channel) for channel in linear_from_srgb(np.array(color)))
        material = self._scene.add_material("ink", self._core.Material(emission=emission))
        self._scene.add_instances("shape", mesh, np.eye(4, dtype=np.float32)[None], [material])

    def render(self) -> NDArray[np.uint8]:
        """(height, width, 3), sRGB, bottom row first."""
        camera = np.eye(4, dtype=np.float32)
        camera[2, 3] = _DISTANCE_PX
        plane = (0.0, self.width / _DISTANCE_PX, 0.0, self.height / _DISTANCE_PX)
        self._scene.set_camera(camera, plane, self.width, self.height)
        self._scene.set_world(tuple(float(channel) for channel in self._paper))
        settings = self._core.RenderSettings(
            samples=_SAMPLES, max_bounces=0, pixel_filter="BOX", filter_width_px=1.0, threads=0
        )
        session = self._core.Session(self._scene, settings)
        session.start()
        while not session.wait(1.0):
            pass
        picture = session.read("Combined")[..., :3].astype(float)
        for x, y, image in self._images:
            picture[y : y + image.shape[0], x : x + image.shape[1]] = image
        return to_bytes(picture)
