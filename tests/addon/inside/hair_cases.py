"""A furry ball in several materials and lights, rendered by Cycles and by Pivot; as files in the folder."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import bpy
import cycles_cases
import parts

SIZE = 32
SAMPLES = {"CYCLES": 400, "PIVOT": 256}
BROWN = (0.6, 0.3, 0.15, 1)


def main(folder: Path) -> Any:
    """Returns the names of the pictures."""
    for name, make in CASES.items():
        scene(make)
        # After the first bounce among hairs 3.4 shows 1 to 2 % less of a lamp; later Blenders agree.
        is_noisy = name == "hair_of_color"
        render(folder, name, 1 if is_noisy and bpy.app.version < (4, 0) else 4, 2 if is_noisy else 1)
    return list(CASES)


def render(folder: Path, name: str, bounces: int = 4, times: int = 1) -> None:
    cycles_cases._cycles(folder / f"{name}_CYCLES.exr", bounces, times * SAMPLES["CYCLES"])
    cycles_cases._pivot(folder / f"{name}_PIVOT.exr", bounces, "JOINT", times * SAMPLES["PIVOT"])


def scene(make: Callable[[], Any]) -> None:
    """make: its material, and what is beside the ball."""
    parts.clear()
    parts.size(SIZE, SIZE)
    parts.camera((0, -6, 0), (math.pi / 2, 0, 0)).data.lens = 62
    bpy.context.scene.cycles_curves.shape = "RIBBONS"
    bpy.ops.mesh.primitive_uv_sphere_add(segments=24, ring_count=12)
    ball = bpy.context.object
    make()
    ball.data.materials.append(bpy.data.materials["fur"])
    fur(ball)


def fur(ball: Any) -> None:
    """Bent strands, each with some children."""
    ball.modifiers.new("fur", "PARTICLE_SYSTEM")
    settings = ball.particle_systems[0].settings
    settings.type = "HAIR"
    settings.count, settings.hair_length = 300, 0.8
    settings.brownian_factor = 0.1
    settings.render_step = 3
    settings.child_type = "INTERPOLATED"
    settings.rendered_child_count = 4
    settings.root_radius, settings.tip_radius, settings.radius_scale = 2.0, 0.5, 0.02


def _sun() -> None:
    parts.light("sun", "SUN", energy=3, angle=0.1).rotation_euler = (math.radians(50), 0.3, 0.4)


def _window() -> None:
    """A wide light beside the camera, which few samples find in highlights as well as many."""
    parts.light("window", "AREA", (-3, -4, 4), energy=400, shape="SQUARE", size=4).rotation_euler = (0.9, 0, -0.6)


def _bright_card() -> None:
    """A window as a mesh that Cycles meets by chance: 5.2 loses a sixth of a lamp on Principled Hair, but not of it."""
    ball = bpy.context.object
    bpy.ops.mesh.primitive_plane_add(size=4, location=(-3, -4, 4), rotation=(0.9, 0, -0.6))
    material, _ = parts.shaded("card", "ShaderNodeEmission", Strength=8)
    if hasattr(material.cycles, "emission_sampling"):  # from Blender 3.5
        material.cycles.emission_sampling = "NONE"
    else:
        material.cycles.sample_as_light = False
    bpy.context.object.data.materials.append(material)
    bpy.context.view_layer.objects.active = ball


def _diffuse_in_sun() -> None:
    parts.shaded("fur", "ShaderNodeBsdfDiffuse", Color=BROWN)
    _sun()


def _diffuse_in_sky() -> None:
    parts.shaded("fur", "ShaderNodeBsdfDiffuse", Color=BROWN)
    parts.world((0.5, 0.7, 0.9))


def _glossy() -> None:
    _, node = parts.shaded("fur", "ShaderNodeBsdfGlossy", Color=BROWN, Roughness=0.4)
    node.distribution = "GGX"
    _window()
    parts.world((0.3, 0.4, 0.5))


def _hair_of_color() -> None:
    _hair("COLOR", {"Color": (0.5, 0.2, 0.08, 1)})
    _bright_card()
    parts.world((0.2, 0.2, 0.3))


def _hair_of_melanin() -> None:
    """In an even sky alone: few samples in either engine find how a sun shines through hair upon hair."""
    _hair("MELANIN", {"Melanin": 0.5, "Melanin Redness": 0.6, "Random Color": 0.8, "Random Roughness": 0.5})
    parts.world((0.6, 0.7, 0.8))


def _hair(parametrization: str, inputs: dict[str, Any]) -> None:
    _, node = parts.shaded("fur", "ShaderNodeBsdfHairPrincipled")
    if hasattr(node, "model"):  # from Blender 4.0
        node.model = "CHIANG"
    node.parametrization = parametrization
    for socket in node.inputs:
        if socket.identifier in inputs:
            socket.default_value = inputs[socket.identifier]


def _curves() -> None:
    """A Curves object beside the fur, with radii of its points; and one without."""
    _diffuse_in_sun()
    bpy.ops.object.curves_random_add()
    curves = bpy.context.object
    curves.data.materials.append(parts.shaded("red", "ShaderNodeBsdfDiffuse", Color=(0.8, 0.1, 0.1, 1))[0])
    curves.scale = (0.9, 0.9, 0.6)
    bpy.context.view_layer.objects.active = bpy.data.objects["Sphere"]


def _points() -> None:
    """A point cloud of the ball's vertices beside it; evenly scaled: else the Blenders' Cycles disagree."""
    _diffuse_in_sun()
    parts.world((0.2, 0.2, 0.2))
    group = bpy.data.node_groups.new("points", "GeometryNodeTree")
    if hasattr(group, "interface"):  # from Blender 4.0
        for in_out in ("INPUT", "OUTPUT"):
            group.interface.new_socket("Geometry", in_out=in_out, socket_type="NodeSocketGeometry")
    else:
        group.inputs.new("NodeSocketGeometry", "Geometry")
        group.outputs.new("NodeSocketGeometry", "Geometry")
    nodes = [group.nodes.new(kind) for kind in ("NodeGroupInput", "GeometryNodeMeshToPoints", "NodeGroupOutput")]
    nodes[1].inputs["Radius"].default_value = 0.12
    for a, b in itertools.pairwise(nodes):
        group.links.new(a.outputs[0], b.inputs[0])
    ball = bpy.data.objects["Sphere"]
    beside = parts.link("beads", ball.data.copy(), (1, -1, 0.5))
    beside.data.materials.append(parts.shaded("red", "ShaderNodeBsdfDiffuse", Color=(0.8, 0.1, 0.1, 1))[0])
    beside.scale = (0.8, 0.8, 0.8)
    beside.modifiers.new("points", "NODES").node_group = group


def _points_told() -> None:
    """What Point Info tells of them, as colours that shine."""
    _points()
    tree = bpy.data.materials["red"].node_tree
    info, apart, joined, shines = (
        tree.nodes.new(f"ShaderNode{kind}") for kind in ("PointInfo", "SeparateXYZ", "CombineXYZ", "Emission")
    )
    radius = tree.nodes.new("ShaderNodeMath")
    radius.operation, radius.inputs[1].default_value = "MULTIPLY", 5
    for output, end in (
        (info.outputs["Radius"], radius.inputs[0]),
        (info.outputs["Position"], apart.inputs[0]),
        (info.outputs["Random"], joined.inputs["X"]),
        (radius.outputs[0], joined.inputs["Y"]),
        (apart.outputs["X"], joined.inputs["Z"]),
        (joined.outputs[0], shines.inputs["Color"]),
        (shines.outputs[0], tree.nodes["Material Output"].inputs["Surface"]),
    ):
        tree.links.new(output, end)


def _strand_on_mesh() -> None:
    """A ball beside it of Hair BSDF, which on a mesh lies along edges of the triangles, and no Offset counts."""
    _diffuse_in_sun()
    parts.world((0.2, 0.2, 0.2))
    _, node = parts.shaded("strand", "ShaderNodeBsdfHair", Color=BROWN, RoughnessU=0.3, Offset=0.5)
    node.component = "Reflection"
    bpy.ops.mesh.primitive_uv_sphere_add(radius=0.7, location=(1, -1.5, 0.5))
    bpy.context.object.data.materials.append(bpy.data.materials["strand"])
    bpy.context.view_layer.objects.active = bpy.data.objects["Sphere"]


def _round() -> None:
    _diffuse_in_sun()
    bpy.context.scene.cycles_curves.shape = "THICK"


def _told() -> None:
    """What Hair Info tells, as colours that shine."""
    material, node = parts.shaded("fur", "ShaderNodeEmission")
    tree = material.node_tree
    info, joined = tree.nodes.new("ShaderNodeHairInfo"), tree.nodes.new("ShaderNodeCombineXYZ")
    thickness = tree.nodes.new("ShaderNodeMath")
    thickness.operation = "MULTIPLY"
    thickness.inputs[1].default_value = 30
    tree.links.new(info.outputs["Thickness"], thickness.inputs[0])
    for source, target in (("Intercept", "X"), ("Random", "Y")):
        tree.links.new(info.outputs[source], joined.inputs[target])
    tree.links.new(thickness.outputs[0], joined.inputs["Z"])
    tree.links.new(joined.outputs[0], node.inputs["Color"])


CASES = {
    "diffuse_in_sun": _diffuse_in_sun,
    "diffuse_in_sky": _diffuse_in_sky,
    "glossy": _glossy,
    "round": _round,
    "hair_of_color": _hair_of_color,
    "hair_of_melanin": _hair_of_melanin,
    "told": _told,
    "curves": _curves,
    "points": _points,
    "points_told": _points_told,
}
if bpy.app.version >= (4, 0):  # 3.4's lamps, which no light tree chooses, leave out more of what is behind the surface
    CASES["strand_on_mesh"] = _strand_on_mesh
