"""A hall with sun in its windows, a spot over a bowl, and a gold rabbit: the scene of shafts.py, built in Blender.

Metres and watts, z up. The rabbit is the default scene's; its licence is there.
"""

from __future__ import annotations

import lzma
import math
from pathlib import Path

import bpy

# isort: split
import fog_scenes
import indirect_scenes as parts
from mathutils import Matrix, Vector

WIDTH, HEIGHT = 960, 540
SIZES = {"shafts": 100, "small shafts": 25}  # percent of it
BOUNCES = 2
BUNNY = Path(__file__).resolve().parents[1] / "scenes" / "default" / "meshes" / "bunny.obj.xz"
WINDOWS_Y = (-2.4, 0.3, 3.0)
SILL_M, LINTEL_M, HALF_WIDTH_M = 1.9, 4.3, 0.6


def hall() -> None:
    """8 x 12 x 5 m."""
    stone = parts.principled("stone", (0.36, 0.33, 0.29), Roughness=0.8)
    slabs = parts.principled("slabs", (0.10, 0.095, 0.09), Roughness=0.22)
    parts.box("floor", (-4.4, -7.4, -0.3), (4.4, 5.4, 0.0), slabs)
    parts.box("ceiling", (-4.4, -7.4, 5.0), (4.4, 5.4, 5.3), stone)
    parts.box("back", (-4.0, 5.0, 0.0), (4.0, 5.4, 5.0), stone)
    parts.box("front", (-4.0, -7.4, 0.0), (4.0, -7.0, 5.0), stone)
    parts.box("right", (4.0, -7.4, 0.0), (4.4, 5.4, 5.0), stone)
    parts.box("left, below", (-4.4, -7.4, 0.0), (-4.0, 5.4, SILL_M), stone)
    parts.box("left, above", (-4.4, -7.4, LINTEL_M), (-4.0, 5.4, 5.0), stone)
    edges = [-7.4, *(y + side * HALF_WIDTH_M for y in WINDOWS_Y for side in (-1, 1)), 5.4]
    for start, end in zip(edges[::2], edges[1::2], strict=True):
        parts.box("left, between", (-4.4, start, SILL_M), (-4.0, end, LINTEL_M), stone)
    iron = parts.principled("iron", (0.03, 0.03, 0.03), Roughness=0.4)
    for y in WINDOWS_Y:
        parts.box("mullion", (-4.23, y - 0.05, SILL_M), (-4.17, y + 0.05, LINTEL_M), iron)
        for z in (2.7, 3.5):
            for side in (-1, 1):
                low, high = sorted((y + side * 0.05, y + side * HALF_WIDTH_M))
                parts.box("transom", (-4.23, low, z - 0.04), (-4.17, high, z + 0.04), iron)
    for y in (-1.0, 1.7, 4.4):
        parts.tube("column", (3.1, y, 0.0), (3.1, y, 5.0), (0.24, 0.2), stone, closed=False)
        parts.box("base", (2.78, y - 0.32, 0.0), (3.42, y + 0.32, 0.25), stone)
    for y in (-2.0, 1.0, 4.0):
        parts.box(
            "beam", (-4.0, y - 0.12, 4.7), (4.0, y + 0.12, 5.0), parts.principled("beam", parts.OAK, Roughness=0.6)
        )


def rabbit(height_m: float, place: tuple[float, float, float]) -> None:
    lines = [line.split() for line in lzma.decompress(BUNNY.read_bytes()).decode().splitlines()]
    points = [tuple(map(float, line[1:4])) for line in lines if line[:1] == ["v"]]
    faces = [[int(corner.split("/")[0]) - 1 for corner in line[1:]] for line in lines if line[:1] == ["f"]]
    mesh = bpy.data.meshes.new("rabbit")
    mesh.from_pydata(points, [], faces)
    mesh.polygons.foreach_set("use_smooth", [True] * len(faces))
    mesh.materials.append(parts.metal("gold", (1.0, 0.72, 0.3), 0.25))
    mesh.transform(Matrix.Rotation(math.radians(90), 4, "X"))
    corners = [[f(v.co[axis] for v in mesh.vertices) for axis in range(3)] for f in (min, max)]
    low, high = map(Vector, corners)
    middle = Vector(((low.x + high.x) / 2, (low.y + high.y) / 2, low.z))
    scale = Matrix.Scale(height_m / (high.z - low.z), 4)
    turn = Matrix.Rotation(math.radians(-20), 4, "Z")
    parts.link("rabbit", mesh, Matrix.Translation(place) @ turn @ scale @ Matrix.Translation(-middle))


def build(percentage: int) -> None:
    bpy.ops.wm.read_factory_settings(use_empty=True)
    hall()
    marble = parts.principled("marble", (0.5, 0.48, 0.45), Roughness=0.3)
    parts.box("plinth", (-1.3, 0.9, 0.0), (-0.5, 1.7, 0.95), marble)
    parts.box("plinth top", (-1.37, 0.83, 0.95), (-0.43, 1.77, 1.02), marble)
    rabbit(1.25, (-0.9, 1.3, 1.02))
    parts.tube("stand", (1.9, -0.4, 0.0), (1.9, -0.4, 0.75), (0.28, 0.18), marble, closed=True)
    parts.ball("orb", (1.9, -0.4, 1.06), 0.31, parts.metal("silver", (0.9, 0.9, 0.92), 0.12))
    parts.ball("copper", (-1.75, -0.9, 0.32), 0.32, parts.metal("copper", (0.95, 0.5, 0.35), 0.25))
    parts.ball("lacquer", (0.75, -0.9, 0.2), 0.2, parts.principled("lacquer", (0.35, 0.02, 0.02), Roughness=0.12))
    toward_sun = Vector((-0.75, 0.42, 0.44))
    sun = {"energy": 40.0, "angle": math.radians(0.6)}
    parts.light("sun", "SUN", tuple(toward_sun), (0, 0, 0), (1.0, 0.8, 0.55), **sun)
    spot = {"energy": 1300.0, "spot_size": math.radians(24), "spot_blend": 0.25, "shadow_soft_size": 0.05}
    parts.light("spot", "SPOT", (2.2, 0.3, 4.55), (1.9, -0.4, 0.9), (0.55, 0.75, 1.0), **spot)
    lantern = {"energy": 40.0, "shadow_soft_size": 0.08}
    parts.light("lantern", "POINT", (0.75, -0.5, 2.5), (0, 0, 0), (1.0, 0.6, 0.3), **lantern)
    parts.world((0.6, 0.9, 1.4))
    parts.box("fog", (-4.3, -7.3, -0.2), (4.3, 5.3, 5.2), fog_scenes.fog(0.5, 0.045))
    parts.camera((0.75, -4.3, 1.5), (-0.2, 1.0, 1.75), 24.0)
    render = bpy.context.scene.render
    render.resolution_x, render.resolution_y, render.resolution_percentage = WIDTH, HEIGHT, percentage
