"""The scenes of indirect.py, built in Blender out of boxes, cylinders and spheres; a name in SCENES builds one.

Metres and watts, z up. They keep Blender's defaults, and to what Pivot and Cycles both render: constant materials, no
modifiers. No visible faces lie in one another: which of the two a ray meets is chance, and each renderer has its own.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import bpy

# isort: split
import bmesh
import numpy as np
from mathutils import Matrix, Vector

Triple = tuple[float, float, float]
WIDTH, HEIGHT = 480, 270
DEFAULT_SCENE = Path(__file__).resolve().parents[1] / "scenes" / "default" / "default.blend"

WHITE = (0.75, 0.74, 0.72)
OAK = (0.42, 0.26, 0.13)


# -- materials
def principled(name: str, color: Triple, **inputs: float) -> bpy.types.Material:
    """inputs: by socket name with spaces as underscores."""
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    node = next(node for node in material.node_tree.nodes if node.type == "BSDF_PRINCIPLED")
    node.inputs["Base Color"].default_value = (*color, 1.0)
    for key, value in inputs.items():
        node.inputs[key.replace("_", " ")].default_value = value
    return material


def metal(name: str, color: Triple, roughness: float) -> bpy.types.Material:
    return principled(name, color, Metallic=1.0, Roughness=roughness)


def emitter(name: str, color: Triple, radiance: float) -> bpy.types.Material:
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    node, output = tree.nodes.new("ShaderNodeEmission"), tree.nodes.new("ShaderNodeOutputMaterial")
    node.inputs["Color"].default_value = (*color, 1.0)
    node.inputs["Strength"].default_value = radiance
    tree.links.new(node.outputs[0], output.inputs["Surface"])
    return material


# -- meshes
def link(name: str, data: Any, world_from_object: Matrix) -> bpy.types.Object:
    thing = bpy.data.objects.new(name, data)
    thing.matrix_world = world_from_object
    bpy.context.scene.collection.objects.link(thing)
    return thing


def solid(name: str, material: bpy.types.Material, make: Callable[[bmesh.types.BMesh], Any], smooth: bool) -> Any:
    """A mesh of what make adds."""
    edit = bmesh.new()
    make(edit)
    for face in edit.faces:
        face.smooth = smooth
    mesh = bpy.data.meshes.new(name)
    edit.to_mesh(mesh)
    edit.free()
    mesh.materials.append(material)
    return mesh


def box(name: str, low: Triple, high: Triple, material: bpy.types.Material, turn_deg: float = 0.0) -> bpy.types.Object:
    """From corner to corner, then turned about the vertical through its middle."""
    size, middle = Vector(high) - Vector(low), (Vector(high) + Vector(low)) / 2
    mesh = solid(name, material, lambda edit: bmesh.ops.create_cube(edit, size=1.0), smooth=False)
    mesh.transform(Matrix.Diagonal((*size, 1.0)))
    return link(name, mesh, Matrix.Translation(middle) @ Matrix.Rotation(math.radians(turn_deg), 4, "Z"))


def ball(name: str, center: Triple, radius_m: float, material: bpy.types.Material) -> bpy.types.Object:
    """Of 3968 triangles."""

    def make(edit: bmesh.types.BMesh) -> None:
        bmesh.ops.create_uvsphere(edit, u_segments=64, v_segments=32, radius=radius_m)

    return link(name, solid(name, material, make, smooth=True), Matrix.Translation(center))


def tube(
    name: str, start: Triple, end: Triple, radii_m: tuple[float, float], material: bpy.types.Material, closed: bool
) -> bpy.types.Object:
    """A cone or cylinder along an axis, with or without its two ends."""
    axis = Vector(end) - Vector(start)

    def make(edit: bmesh.types.BMesh) -> None:
        bmesh.ops.create_cone(
            edit, cap_ends=closed, segments=48, radius1=radii_m[0], radius2=radii_m[1], depth=axis.length
        )

    turn = axis.to_track_quat("Z", "Y").to_matrix().to_4x4()
    middle = Matrix.Translation((Vector(start) + Vector(end)) / 2)
    return link(name, solid(name, material, make, smooth=False), middle @ turn)


# -- lights, world and camera
def aimed(eye: Triple, target: Triple) -> Matrix:
    direction = Vector(target) - Vector(eye)
    return Matrix.Translation(eye) @ direction.to_track_quat("-Z", "Y").to_matrix().to_4x4()


def light(name: str, kind: str, eye: Triple, target: Triple, color: Triple, **settings: Any) -> None:
    data = bpy.data.lights.new(name, kind)
    data.color = color
    for key, value in settings.items():
        setattr(data, key, value)
    link(name, data, aimed(eye, target))


def world(color: Triple) -> None:
    made = bpy.data.worlds.new("world")
    made.use_nodes = True
    made.node_tree.nodes["Background"].inputs["Color"].default_value = (*color, 1.0)
    bpy.context.scene.world = made


def camera(eye: Triple, target: Triple, lens_mm: float) -> None:
    data = bpy.data.cameras.new("camera")
    data.lens = lens_mm
    data.clip_start = 0.01
    bpy.context.scene.camera = link("camera", data, aimed(eye, target))


# -- a room, 5 x 4 x 2.6 m, its corner at the origin
def walls(window: bool) -> None:
    """Closed on all sides but for a window in the wall at x = 0."""
    plaster, boards = principled("plaster", WHITE, Roughness=0.8), principled("boards", OAK, Roughness=0.35)
    box("floor", (-0.2, -0.2, -0.2), (5.2, 4.2, 0.0), boards)
    box("ceiling", (-0.2, -0.2, 2.6), (5.2, 4.2, 2.8), plaster)
    box("back wall", (-0.2, 4.0, 0.0), (5.2, 4.2, 2.6), plaster)
    box("front wall", (-0.2, -0.2, 0.0), (5.2, 0.0, 2.6), plaster)
    box("right wall", (5.0, 0.0, 0.0), (5.2, 4.0, 2.6), principled("sage", (0.36, 0.45, 0.33), Roughness=0.8))
    if not window:
        box("left wall", (-0.2, 0.0, 0.0), (0.0, 4.0, 2.6), plaster)
        return
    box("left wall, below", (-0.2, 0.0, 0.0), (0.0, 4.0, 0.9), plaster)
    box("left wall, above", (-0.2, 0.0, 2.2), (0.0, 4.0, 2.6), plaster)
    box("left wall, near", (-0.2, 0.0, 0.9), (0.0, 1.5, 2.2), plaster)
    box("left wall, far", (-0.2, 3.3, 0.9), (0.0, 4.0, 2.2), plaster)
    frame = principled("frame", (0.8, 0.8, 0.8), Roughness=0.3)
    box("mullion", (-0.12, 2.37, 0.91), (-0.07, 2.43, 2.2), frame)
    box("sill", (-0.1, 1.45, 0.88), (0.15, 3.35, 0.92), frame)


def furniture() -> None:
    oak, dark = principled("oak", OAK, Roughness=0.3), principled("walnut", (0.14, 0.075, 0.04), Roughness=0.4)
    cloth = principled("cloth", (0.16, 0.22, 0.36), Roughness=0.9, Specular_IOR_Level=0.1)
    steel, brass = metal("steel", (0.65, 0.65, 0.66), 0.25), metal("brass", (0.9, 0.66, 0.3), 0.18)
    box("rug", (1.2, 0.9, 0.0), (3.9, 2.9, 0.015), principled("rug", (0.5, 0.16, 0.12), Roughness=1.0))
    box("table top", (1.7, 1.5, 0.70), (3.1, 2.4, 0.74), oak)
    for x, y in ((1.75, 1.55), (3.0, 1.55), (1.75, 2.3), (3.0, 2.3)):
        box("table leg", (x, y, 0.0), (x + 0.05, y + 0.05, 0.70), oak)
    for number, (x, y, turn_deg) in enumerate(((2.1, 1.15, 8.0), (2.75, 2.75, 175.0))):
        box(f"seat {number}", (x - 0.2, y - 0.2, 0.42), (x + 0.2, y + 0.2, 0.46), dark, turn_deg)
        back_y = y + (-0.22 if number == 0 else 0.22)
        box(f"chair back {number}", (x - 0.2, back_y - 0.015, 0.46), (x + 0.2, back_y + 0.015, 0.9), dark, turn_deg)
        for dx in (-0.17, 0.17):
            for dy in (-0.17, 0.17):
                leg = f"chair leg {number} {dx} {dy}"
                tube(leg, (x + dx, y + dy, 0.0), (x + dx, y + dy, 0.42), (0.015, 0.015), steel, closed=True)
    box("sofa", (3.0, 3.2, 0.12), (4.8, 3.95, 0.42), cloth)
    box("sofa back", (3.0, 3.75, 0.42), (4.8, 3.97, 0.85), cloth)
    for x in (3.0, 4.62):
        box("sofa arm", (x, 3.2, 0.42), (x + 0.18, 3.75, 0.62), cloth)
    box("pillow", (3.3, 3.55, 0.43), (3.7, 3.72, 0.78), principled("pillow", (0.75, 0.5, 0.12), Roughness=0.9), 12.0)
    shelf(dark)
    box("picture", (1.9, 3.97, 1.35), (2.7, 4.0, 1.95), principled("picture", (0.12, 0.3, 0.4), Roughness=0.2))
    ball("vase", (2.1, 1.9, 0.86), 0.12, principled("glaze", (0.05, 0.18, 0.3), Roughness=0.08))
    ball("kettle", (2.6, 2.05, 0.83), 0.09, steel)
    tube("bowl", (2.5, 1.7, 0.741), (2.5, 1.7, 0.81), (0.06, 0.13), brass, closed=False)
    ball("orange", (2.5, 1.7, 0.80), 0.04, principled("orange", (0.8, 0.3, 0.03), Roughness=0.4))


def shelf(wood: bpy.types.Material) -> None:
    """Of books, at the back wall's left."""
    colors = [(0.5, 0.1, 0.08), (0.1, 0.25, 0.15), (0.6, 0.5, 0.3), (0.1, 0.12, 0.3), (0.65, 0.62, 0.58)]
    covers = [principled(f"cover {i}", color, Roughness=0.4) for i, color in enumerate(colors)]
    for x in (0.2, 1.36):
        box("shelf side", (x, 3.68, 0.0), (x + 0.04, 3.98, 1.9), wood)
    random = np.random.default_rng(4)
    for level in range(5):
        z = 0.1 + 0.44 * level
        box(f"board {level}", (0.24, 3.68, z), (1.36, 3.98, z + 0.03), wood)
        x = 0.27
        while level < 4 and x < 1.1:
            width, height = random.uniform(0.025, 0.07), random.uniform(0.22, 0.36)
            cover = covers[int(random.integers(len(covers)))]
            box("book", (x, 3.74, z + 0.03), (x + width, 3.96, z + 0.03 + height), cover)
            x += width + 0.003


def room_window() -> None:
    walls(window=True)
    furniture()
    size = {"shape": "RECTANGLE", "size": 2.4, "size_y": 1.8}
    light("daylight", "AREA", (-1.6, 1.6, 3.0), (0.6, 2.6, 0.8), (1.0, 0.96, 0.9), energy=900.0, **size)
    brass = metal("lamp brass", (0.9, 0.66, 0.3), 0.3)
    tube("lamp pole", (2.85, 3.6, 0.0), (2.85, 3.6, 1.4), (0.012, 0.012), brass, closed=True)
    shade = principled("shade", (0.8, 0.72, 0.6), Roughness=0.9)
    tube("lamp shade", (2.85, 3.6, 1.38), (2.85, 3.6, 1.68), (0.24, 0.15), shade, closed=False)
    light("lamp", "POINT", (2.85, 3.6, 1.53), (2.85, 3.6, 0.0), (1.0, 0.75, 0.5), energy=40.0, shadow_soft_size=0.05)
    world((0.6, 0.6, 0.6))
    camera((4.1, 0.25, 1.55), (1.7, 2.9, 0.95), 22.0)


def room_emissive() -> None:
    walls(window=False)
    furniture()
    box("ceiling panel", (1.9, 1.5, 2.54), (3.1, 2.1, 2.57), emitter("panel", (1.0, 0.97, 0.92), 7.0))
    pole = metal("pole", (0.8, 0.8, 0.8), 0.3)
    tube("lamp pole", (2.85, 3.6, 0.0), (2.85, 3.6, 1.4), (0.012, 0.012), pole, closed=True)
    ball("lamp globe", (2.85, 3.6, 1.55), 0.16, emitter("globe", (1.0, 0.7, 0.42), 8.0))
    box("strip", (0.25, 3.9, 1.93), (1.35, 3.93, 1.95), emitter("strip", (0.6, 0.8, 1.0), 30.0))
    world((0.0, 0.0, 0.0))
    camera((4.1, 0.25, 1.55), (1.7, 2.9, 0.95), 22.0)


def metal_box() -> None:
    sheet = metal("sheet", (0.75, 0.74, 0.72), 0.3)
    box("floor", (-2.1, -2.0, -0.1), (2.1, 2.1, 0.0), sheet)
    box("ceiling", (-2.1, -2.0, 2.4), (2.1, 2.1, 2.5), sheet)
    box("back", (-2.1, 2.0, 0.0), (2.1, 2.1, 2.4), sheet)
    box("left", (-2.1, -2.0, 0.0), (-2.0, 2.0, 2.4), metal("copper", (0.9, 0.5, 0.35), 0.4))
    box("right", (2.0, -2.0, 0.0), (2.1, 2.0, 2.4), metal("blued steel", (0.35, 0.45, 0.7), 0.2))
    colors = ((0.95, 0.93, 0.88), (1.0, 0.77, 0.34), (0.9, 0.55, 0.4), (0.6, 0.6, 0.62))
    places = (
        (-1.3, 0.9, 0.5),
        (-0.3, 1.2, 0.55),
        (0.9, 1.1, 0.6),
        (-0.9, -0.2, 0.4),
        (0.15, 0.1, 0.45),
        (1.2, -0.1, 0.42),
        (-1.45, -1.1, 0.3),
        (-0.4, -1.1, 0.28),
        (0.5, -1.0, 0.3),
        (1.4, -1.2, 0.26),
    )
    for number, (x, y, radius_m) in enumerate(places):
        roughness = (0.05, 0.4, 0.15, 0.6, 0.1, 0.25)[number % 6]
        ball(f"ball {number}", (x, y, radius_m), radius_m, metal(f"metal {number}", colors[number % 4], roughness))
    for name, place, color, energy, radius_m in (
        ("warm", (-1.3, 0.2, 1.9), (1.0, 0.8, 0.55), 45.0, 0.15),
        ("cool", (1.4, 0.8, 1.8), (0.55, 0.75, 1.0), 35.0, 0.06),
        ("white", (0.2, -1.2, 2.0), (1.0, 1.0, 1.0), 30.0, 0.25),
    ):
        light(name, "POINT", place, (0.0, 0.0, 0.0), color, energy=energy, shadow_soft_size=radius_m)
    world((0.02, 0.02, 0.02))
    camera((0.0, -5.6, 1.5), (0.0, 0.0, 0.95), 42.0)


# -- outdoors
def truck() -> None:
    """Along x, its front at 3. Nothing mirrors the sun so sharply that a few fireflies are all of the error."""
    paint = principled("paint", (0.55, 0.04, 0.03), Roughness=0.3)
    dark = principled("trim", (0.03, 0.03, 0.03), Roughness=0.5)
    planks = principled("planks", OAK, Roughness=0.6)
    tyre = principled("tyre", (0.02, 0.02, 0.02), Roughness=0.8)
    pane = principled("pane", (0.02, 0.03, 0.04), Roughness=0.2)
    nickel = metal("nickel", (0.85, 0.83, 0.8), 0.35)
    box("chassis", (-3.0, -0.5, 0.55), (2.9, 0.5, 0.75), dark)
    box("cab", (0.9, -0.95, 0.75), (2.2, 0.95, 2.3), paint)
    box("hood", (2.2, -0.85, 0.75), (3.0, 0.85, 1.45), paint)
    box("windscreen", (2.19, -0.8, 1.55), (2.215, 0.8, 2.2), pane)
    for side in (-1.0, 1.0):
        box("door pane", (1.1, side * 0.955 - 0.01, 1.5), (1.95, side * 0.955 + 0.01, 2.15), pane)
        tube("exhaust", (0.78, side * 0.8, 0.8), (0.78, side * 0.8, 2.6), (0.06, 0.06), nickel, closed=True)
        ball("headlamp", (3.0, side * 0.6, 1.15), 0.14, nickel)
        for x in (-2.2, -1.1, 2.3):
            tube("tyre", (x, side * 0.95 - 0.15, 0.5), (x, side * 0.95 + 0.15, 0.5), (0.5, 0.5), tyre, closed=True)
            tube("hub", (x, side * 0.95 - 0.16, 0.5), (x, side * 0.95 + 0.16, 0.5), (0.25, 0.25), nickel, closed=True)
        box("side board", (-3.0, side * 0.98 - 0.03, 0.9), (0.7, side * 0.98 + 0.03, 1.5), planks)
    box("bed", (-3.0, -1.0, 0.8), (0.7, 1.0, 0.9), planks)
    box("bumper", (3.0, -0.95, 0.55), (3.12, 0.95, 0.8), nickel)
    tube("tank", (-2.6, 0.0, 1.5), (0.3, 0.0, 1.5), (0.55, 0.55), metal("tank", (0.7, 0.72, 0.74), 0.4), closed=True)


def instances(name: str, parts: Sequence[bpy.types.Object], places: Sequence[Matrix]) -> None:
    """The parts as a collection that is seen at the places only."""
    collection = bpy.data.collections.new(name)
    for part in parts:
        bpy.context.scene.collection.objects.unlink(part)
        collection.objects.link(part)
    for number, place in enumerate(places):
        empty = link(f"{name} {number}", None, place)
        empty.instance_type, empty.instance_collection = "COLLECTION", collection


def tree() -> list[bpy.types.Object]:
    """A trunk and eight instances of a spray of 300 leaves."""
    random = np.random.default_rng(7)
    centers = random.normal(size=(300, 3))
    centers *= (random.uniform(0.2, 1.0, 300) ** (1 / 3) / np.linalg.norm(centers, axis=1))[:, None]
    frames = np.linalg.qr(random.normal(size=(300, 3, 3)))[0][:, :2] * 0.09
    corners = centers[:, None] + np.einsum("kl,nlx->nkx", [[-1, -1], [1, -1], [1, 1], [-1, 1]], frames)
    leaves = bpy.data.meshes.new("leaves")
    leaves.from_pydata(corners.reshape(-1, 3).tolist(), [], np.arange(1200).reshape(-1, 4).tolist())
    leaves.materials.append(principled("leaf", (0.12, 0.26, 0.06), Roughness=0.5))
    bark = principled("bark", (0.16, 0.1, 0.06), Roughness=0.9)
    parts = [tube("trunk", (0.0, 0.0, -0.1), (0.0, 0.0, 3.2), (0.18, 0.08), bark, closed=True)]
    for number in range(8):
        turn = number * 2.4
        place = (0.7 * math.cos(turn), 0.7 * math.sin(turn), 2.3 + 0.25 * number)
        scale = Matrix.Scale(1.0 - 0.05 * number, 4)
        parts.append(link(f"spray {number}", leaves, Matrix.Translation(place) @ Matrix.Rotation(turn, 4, "Z") @ scale))
    return parts


def outdoors() -> None:
    box("ground", (-80.0, -80.0, -1.0), (80.0, 80.0, 0.0), principled("gravel", (0.36, 0.33, 0.28), Roughness=0.9))
    truck()
    random = np.random.default_rng(11)
    places = []
    for number in range(60):
        x, y = -22.0 + 44.0 * (number % 12 + 0.7 * random.uniform()) / 12, 5.0 + 4.0 * (number // 12 + random.uniform())
        turn, scale = Matrix.Rotation(random.uniform(0, 6.28), 4, "Z"), Matrix.Scale(random.uniform(0.8, 1.4), 4)
        places.append(Matrix.Translation((x, y, 0.0)) @ turn @ scale)
    instances("tree", tree(), places)
    light("sun", "SUN", (4.0, -5.0, 6.0), (0.0, 0.0, 0.0), (1.0, 0.93, 0.82), energy=3.0)
    world((0.5, 0.5, 0.5))
    camera((5.5, -8.0, 2.2), (0.2, 0.6, 1.5), 32.0)


def _from_primitives(build: Callable[[], None]) -> Callable[[], None]:
    def build_all() -> None:
        bpy.ops.wm.read_factory_settings(use_empty=True)
        build()
        set_size()

    return build_all


def default_scene() -> None:
    bpy.ops.wm.open_mainfile(filepath=str(DEFAULT_SCENE))
    set_size()


def set_size() -> None:
    render = bpy.context.scene.render
    render.resolution_x, render.resolution_y, render.resolution_percentage = WIDTH, HEIGHT, 100


SCENES: dict[str, Callable[[], None]] = {
    "default": default_scene,
    "room-window": _from_primitives(room_window),
    "room-emissive": _from_primitives(room_emissive),
    "metal": _from_primitives(metal_box),
    "outdoors": _from_primitives(outdoors),
}
