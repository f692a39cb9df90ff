"""What is not plain plastic or metal, for indirect.py; a name in SCENES builds one.

The balls of monte_carlo_scenes.py in other materials, glass on a table, leaves, and skies.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import bpy

# isort: split
import indirect_scenes as scenes
import monte_carlo_blender
import monte_carlo_scenes as balls
import numpy as np

ROUGHNESSES = (0.1, 0.2, 0.3, 0.4, 0.5)
COLORS = ((0.9, 0.75, 0.5), (0.6, 0.75, 0.9))
SKIES = Path(bpy.utils.resource_path("LOCAL")) / "datafiles" / "studiolights" / "world"

MakeMaterial = Callable[[int], bpy.types.Material]


def brushed(index: int) -> bpy.types.Material:
    color, roughness = COLORS[index % 2], ROUGHNESSES[index % 5]
    anisotropic = 0.2 + 0.2 * (index // 5)
    return scenes.principled("brushed", color, Metallic=1.0, Roughness=roughness, Anisotropic=anisotropic)


def coated(index: int) -> bpy.types.Material:
    coat = {"Coat_Weight": 1.0, "Coat_Roughness": 0.03 + 0.05 * (index // 5)}
    return scenes.principled("coated", (0.6, 0.15, 0.1), Roughness=ROUGHNESSES[index % 5], **coat)


def plastic(index: int) -> bpy.types.Material:
    return scenes.principled("plastic", COLORS[index % 2], Roughness=ROUGHNESSES[index % 5])


def matt(index: int) -> bpy.types.Material:
    return scenes.principled("matt", COLORS[index % 2], Roughness=1.0, Specular_IOR_Level=0.0)


def glass(roughness: float) -> bpy.types.Material:
    return scenes.principled("glass", (1.0, 1.0, 1.0), Roughness=roughness, Transmission_Weight=1.0, IOR=1.45)


def leaf() -> bpy.types.Material:
    """Half translucent, and nothing around a disk of the UV map."""
    material = bpy.data.materials.new("leaf")
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()

    def add(kind: str, *feeds: tuple[str | int, bpy.types.NodeSocket]) -> bpy.types.Node:
        node = tree.nodes.new(f"ShaderNode{kind}")
        for name, socket in feeds:
            tree.links.new(socket, node.inputs[name])
        return node

    above, below = add("BsdfDiffuse"), add("BsdfTranslucent")
    above.inputs["Color"].default_value, below.inputs["Color"].default_value = (0.12, 0.3, 0.06, 1), (0.3, 0.5, 0.08, 1)
    both = add("MixShader", (1, above.outputs[0]), (2, below.outputs[0]))
    from_middle = add("VectorMath", (0, add("TexCoord").outputs["UV"]))
    from_middle.operation, from_middle.inputs[1].default_value = "DISTANCE", (0.5, 0.5, 0.0)
    within = add("Math", (0, from_middle.outputs["Value"]))
    within.operation, within.inputs[1].default_value = "LESS_THAN", 0.45
    cut = add("MixShader", (0, within.outputs[0]), (1, add("BsdfTransparent").outputs[0]), (2, both.outputs[0]))
    add("OutputMaterial", ("Surface", cut.outputs[0]))
    return material


def of_balls(lights: list[balls.LightSource], make: MakeMaterial | None, sky: str | None = None) -> Callable[[], None]:
    """25 balls on a glossy floor, or on a plastic one in materials of their own."""

    def build() -> None:
        monte_carlo_blender.build(balls.Scene(balls.balls(balls.SATIN), lights))
        things = [thing for thing in bpy.context.scene.objects if thing.type == "MESH"] if make else []
        index = 0
        for thing in things:
            if thing.name.startswith("SPHERE"):
                thing.data.materials[0] = make(index)
                index += 1
            else:
                thing.data.materials[0] = scenes.principled("floor", (0.5, 0.5, 0.5), Roughness=0.5)
        if sky is not None:
            scenes.world((1.0, 1.0, 1.0))
            tree = bpy.context.scene.world.node_tree
            picture = tree.nodes.new("ShaderNodeTexEnvironment")
            picture.image = bpy.data.images.load(str(SKIES / f"{sky}.exr"))
            background = next(node for node in tree.nodes if node.type == "BACKGROUND")
            tree.links.new(picture.outputs[0], background.inputs["Color"])
        scenes.set_size()

    return build


def table() -> None:
    bpy.ops.wm.read_factory_settings(use_empty=True)
    oak = scenes.principled("oak", (0.4, 0.25, 0.12), Roughness=0.4)
    scenes.box("table", (-3.0, -2.0, -0.1), (3.0, 2.0, 0.0), oak)
    for place, radius_m, roughness in (
        ((-1.2, 0, 0.6), 0.6, 0.0),
        ((0.3, 0.4, 0.5), 0.5, 0.1),
        ((1.4, -0.3, 0.4), 0.4, 0.3),
    ):
        scenes.ball("ball", place, radius_m, glass(roughness))
    panel = {"energy": 300.0, "shape": "RECTANGLE", "size": 1.2, "size_y": 0.8}
    scenes.light("key", "AREA", (-2, -2, 4), (0, 0, 0), (1, 0.95, 0.9), **panel)
    scenes.light("fill", "POINT", (3, -1, 3), (0, 0, 0), (0.7, 0.8, 1), energy=150.0, shadow_soft_size=0.3)
    scenes.world((0.1, 0.1, 0.12))
    scenes.camera((0.0, -6.0, 2.5), (0, 0, 0.35), 40.0)
    scenes.set_size()


def leaves() -> None:
    """400 squares that turn every way."""
    floor = balls.Shape("PLANE", balls.GREY, (0, 0, -1.5), (14, 14, 1))
    monte_carlo_blender.build(balls.Scene([floor], balls.sphere_lights()))
    rng, count = np.random.default_rng(7), 400
    centers = rng.normal(size=(count, 3)) * (2.2, 2.0, 1.0) + (0, 0, 1.2)
    sides = np.linalg.qr(rng.normal(size=(count, 3, 3)))[0][:, :2] * 0.35
    corners = centers[:, None] + np.einsum("kl,nlx->nkx", [[-1, -1], [1, -1], [1, 1], [-1, 1]], sides)
    mesh = bpy.data.meshes.new("leaves")
    mesh.from_pydata(corners.reshape(-1, 3).tolist(), [], np.arange(4 * count).reshape(-1, 4).tolist())
    uv = mesh.uv_layers.new(name="UVMap")
    uv.data.foreach_set("uv", np.tile(np.array([0, 0, 1, 0, 1, 1, 0, 1], np.float32), count))
    mesh.materials.append(leaf())
    bpy.context.scene.collection.objects.link(bpy.data.objects.new("leaves", mesh))
    scenes.set_size()


SCENES: dict[str, Callable[[], None]] = {
    "brushed": of_balls(balls.sphere_lights(), brushed),
    "brushed-panels": of_balls(balls.area_lights(), brushed),
    "coats": of_balls(balls.sphere_lights(), coated),
    "coats-panels": of_balls(balls.area_lights(), coated),
    "glass": table,
    "leaves": leaves,
} | {
    f"{sky}-{name}": of_balls([], make, sky)
    for sky in ("studio", "city", "sunset")
    for name, make in (("matt", matt), ("plastic", plastic), ("glossy", None))
}
