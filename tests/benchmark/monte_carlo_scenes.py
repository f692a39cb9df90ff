"""The scenes of monte_carlo.py, as data that Blender and Mitsuba build the same scene from.

Metres and watts, z up. Lights stand where the camera does not see them and none shades another.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Triple = tuple[float, float, float]
WIDTH, HEIGHT = 640, 360


@dataclass(frozen=True)
class Material:
    """Lambert, a white-Fresnel GGX lobe ("GLOSSY"), or both in layers ("PLASTIC": Blender's Principled)."""

    kind: str
    color: Triple
    roughness: float = 1.0


@dataclass(frozen=True)
class Shape:
    """A unit sphere or a square of half-extent 1 in z = 0, scaled, turned about x, then moved."""

    kind: str  # "SPHERE" or "PLANE"
    material: Material
    location: Triple = (0.0, 0.0, 0.0)
    scale: Triple = (1.0, 1.0, 1.0)
    turn_x_rad: float = 0.0

    def world_from_object(self) -> NDArray[np.float64]:
        """(4, 4)."""
        c, s = math.cos(self.turn_x_rad), math.sin(self.turn_x_rad)
        matrix = np.eye(4)
        matrix[:3, :3] = np.array([[1, 0, 0], [0, c, -s], [0, s, c]]) @ np.diag(self.scale)
        matrix[:3, 3] = self.location
        return matrix


@dataclass(frozen=True)
class LightSource:
    """A sphere ("POINT"), a "SPOT", or an area light ("RECTANGLE", "ELLIPSE") that shines towards target."""

    kind: str
    location: Triple
    power_w: float
    size_m: tuple[float, float]  # radius of a sphere (twice), sides of an area light
    color: Triple = (1.0, 1.0, 1.0)
    target: Triple = (0.0, 0.0, 0.0)
    cone_rad: float = math.radians(40)  # of a spot, its full angle


@dataclass(frozen=True)
class Scene:
    shapes: list[Shape]
    lights: list[LightSource]
    eye: Triple = (0.0, -13.0, 9.0)
    target: Triple = (0.0, 0.0, 0.4)
    half_width: float = 0.42  # of the view plane at distance 1
    peers: tuple[str, ...] = ("cycles", "mitsuba")  # who can render the same


def look_at(eye: Triple, target: Triple) -> NDArray[np.float64]:
    """(4, 4): -z looks from eye to target, y is up."""
    z = np.subtract(eye, target)
    z = z / np.linalg.norm(z)
    x = np.cross([0.0, 0.0, 1.0] if abs(z[2]) < 0.999 else [0.0, 1.0, 0.0], z)
    x /= np.linalg.norm(x)
    matrix = np.eye(4)
    matrix[:3, :3] = np.stack([x, np.cross(z, x), z], 1)
    matrix[:3, 3] = eye
    return matrix


def sphere_mesh(rings: int = 48) -> tuple[NDArray[np.float64], NDArray[np.int32]]:
    """Vertices (V, 3), which are also the normals, and triangles (T, 3) of a unit sphere."""
    theta = np.linspace(0, math.pi, rings + 1)[1:-1, None]
    phi = np.linspace(0, 2 * math.pi, 2 * rings, endpoint=False)[None, :]
    rows = np.stack(np.broadcast_arrays(np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi), np.cos(theta)), -1)
    vertices = np.concatenate([rows.reshape(-1, 3), [[0, 0, 1], [0, 0, -1]]])
    a = np.arange((rings - 1) * 2 * rings).reshape(rings - 1, 2 * rings)
    b = np.roll(a, -1, axis=1)
    top, bottom = len(vertices) - 2, len(vertices) - 1
    quads = [(a[:-1], a[1:], b[1:]), (a[:-1], b[1:], b[:-1])]
    caps = [(np.full(2 * rings, top), a[0], b[0]), (np.full(2 * rings, bottom), b[-1], a[-1])]
    return vertices, np.concatenate([np.stack(t, -1).reshape(-1, 3) for t in quads + caps]).astype(np.int32)


def balls(floor: Material, kind: str = "GLOSSY") -> list[Shape]:
    """25 spheres of all roughness on a floor."""
    shapes = [Shape("PLANE", floor, scale=(14.0, 14.0, 1.0))]
    for i in range(25):
        roughness = 0.05 + 0.95 * i / 24
        color = (0.9, 0.75, 0.5) if i % 2 else (0.6, 0.75, 0.9)
        place = (2.0 * (i % 5 - 2), 2.0 * (i // 5 - 2), 0.8)
        shapes.append(Shape("SPHERE", Material(kind, color, roughness), place, (0.8, 0.8, 0.8)))
    return shapes


def plates() -> Scene:
    """After Veach: plates of four roughnesses that mirror four spheres of equal power from radius 0.03 to 0.8."""
    shapes = [Shape("PLANE", Material("DIFFUSE", (0.35, 0.35, 0.35)), (0, 0, -1.5), (14, 14, 1))]
    eye, light_y, light_z = np.array((0.0, -13.0, 9.0)), 7.0, 9.0
    for i, roughness in enumerate((0.08, 0.16, 0.26, 0.38)):
        center = np.array((0.0, 2.1 - 2.0 * i, 0.9 - 0.65 * i))
        to_eye, to_light = eye - center, np.array((0.0, light_y, light_z)) - center
        half = to_eye / np.linalg.norm(to_eye) + to_light / np.linalg.norm(to_light)
        material = Material("GLOSSY", (0.7, 0.7, 0.7), roughness)
        turn = math.atan2(-half[1], half[2])
        shapes.append(Shape("PLANE", material, tuple(center), (4.4, 0.75, 1.0), turn))
    colors = ((1.0, 0.6, 0.4), (0.9, 1.0, 0.5), (0.5, 1.0, 0.9), (0.6, 0.6, 1.0))
    lights = [
        LightSource("POINT", (-4.5 + 3.0 * i, light_y, light_z), 250.0, (radius, radius), colors[i])
        for i, radius in enumerate((0.03, 0.1, 0.3, 0.8))
    ]
    return Scene(shapes, lights, target=(0.0, -0.8, -0.4))


def sphere_lights() -> list[LightSource]:
    return [
        LightSource("POINT", (-7.0, -5.0, 9.0), 2200.0, (0.6, 0.6), (1.0, 0.85, 0.7)),
        LightSource("POINT", (7.5, -2.0, 8.0), 1800.0, (1.2, 1.2), (0.7, 0.85, 1.0)),
        LightSource("POINT", (1.0, 8.0, 10.0), 2500.0, (0.2, 0.2)),
    ]


def many_lights() -> list[LightSource]:
    """64 spheres of many sizes and powers in a layer above the scene."""
    random = np.random.default_rng(6)
    lights = []
    for i in range(64):
        x, y = 2.8 * (i % 8 - 3.5) + random.uniform(-0.5, 0.5), 2.8 * (i // 8 - 3.5) + random.uniform(-0.5, 0.5)
        radius, power = random.uniform(0.05, 0.45), 120.0 * random.uniform(0.1, 1.0) ** 2
        color = tuple(random.uniform(0.4, 1.0, 3).tolist())
        lights.append(LightSource("POINT", (x, y, 9.0 + random.uniform(0, 0.4)), power, (radius, radius), color))
    return lights


def lamps(count: int) -> list[LightSource]:
    """So many spheres of one size all over the scene's ceiling, in all 4000 W."""
    # Multiples of an irrational pair spread evenly, whatever their number (the R2 sequence).
    xy = 22.0 * ((np.arange(1, count + 1)[:, None] * (0.7548776662466927, 0.5698402909980532)) % 1.0 - 0.5)
    return [LightSource("POINT", (float(x), float(y), 9.0), 4000.0 / count, (0.15, 0.15)) for x, y in xy]


def spots() -> list[LightSource]:
    places = ((-7, -6, 8), (0, -8, 9), (7, -6, 8), (-7, 6, 9), (0, 8, 8), (7, 6, 9))
    colors = ((1, 0.5, 0.4), (0.6, 1, 0.6), (0.5, 0.6, 1), (1, 0.9, 0.5), (0.9, 0.5, 1), (0.5, 1, 1))
    return [
        LightSource("SPOT", place, 3000.0, (0.35, 0.35), color, (0.4 * place[0], 0.3 * place[1], 0.0))
        for place, color in zip(places, colors, strict=True)
    ]


def area_lights() -> list[LightSource]:
    return [
        LightSource("RECTANGLE", (-6.0, -3.0, 8.0), 900.0, (3.0, 1.5), (1.0, 0.85, 0.7)),
        LightSource("ELLIPSE", (6.0, -3.0, 8.0), 700.0, (2.0, 2.0), (0.7, 0.85, 1.0)),
        LightSource("RECTANGLE", (0.0, 7.0, 8.0), 800.0, (8.0, 0.2)),
    ]


GREY = Material("DIFFUSE", (0.5, 0.5, 0.5))
SATIN = Material("GLOSSY", (0.5, 0.5, 0.5), 0.5)

LAMPS = {f"{count}-lamps": Scene(balls(SATIN), lamps(count), peers=("cycles",)) for count in (10, 100, 1000)}

SCENES = {
    "plates": plates(),
    "balls": Scene(balls(SATIN), sphere_lights()),
    "balls-diffuse-floor": Scene(balls(GREY), sphere_lights()),
    "plastic": Scene(balls(Material("PLASTIC", (0.4, 0.3, 0.2), 0.3), "PLASTIC"), sphere_lights(), peers=("cycles",)),
    "64-lights": Scene(balls(SATIN), many_lights()),
    "spots": Scene(balls(SATIN), spots(), peers=("cycles",)),
    "area-lights": Scene(balls(SATIN), area_lights()),
    **LAMPS,
}
