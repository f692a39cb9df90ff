"""Lights that light some things only, and objects that some rays only meet, rendered by Cycles and by Pivot."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import bpy
import parts
from cycles_cases import SPHERE, _ball, by_both, directly_by_both, on_clay

ANALYTIC_SAMPLES = 32
BOUNCES = {"few_bounces": 2, "spread": 0}  # 1 of the others
LIGHTS, OBJECTS = ("unshadowed", "spread", "excluded", "few_bounces"), ("hidden", "holdout", "indirect_only")


def main(folder: Path) -> Any:
    for name in LIGHTS + OBJECTS:
        clay, _ = on_clay((6, 6))
        globals()[f"_{name}"](clay)
        by_both(folder, name, BOUNCES.get(name, 1))
        directly_by_both(folder, name, ANALYTIC_SAMPLES, is_analytic=name != "hidden")  # of meshes that shine
    return [*LIGHTS, *OBJECTS]


def _glossy(name: str, roughness: float) -> Any:
    """A diffuse material under a glossy one, half of each."""
    material, tree = parts.material(name)
    mix = tree.nodes.new("ShaderNodeMixShader")
    diffuse, glossy = (tree.nodes.new(f"ShaderNodeBsdf{kind}") for kind in ("Diffuse", "Glossy"))
    diffuse.inputs["Color"].default_value = (0.3, 0.5, 0.8, 1)
    glossy.inputs["Roughness"].default_value = roughness
    glossy.distribution = "GGX"
    for index, node in enumerate((diffuse, glossy), start=1):
        tree.links.new(node.outputs[0], mix.inputs[index])
    tree.links.new(mix.outputs[0], tree.nodes["Material Output"].inputs["Surface"])
    return material


def _set_shadow(light: Any, casts: bool) -> None:
    data = light.data
    if hasattr(data.cycles, "cast_shadow"):
        data.cycles.cast_shadow = casts
    else:
        data.use_shadow = casts


def _unshadowed(clay: Any) -> None:
    _ball("ball", (0.3, 0, 1), _glossy("shiny", 0.4))
    _set_shadow(parts.light("open", "POINT", (2.5, -1, 3), energy=150, **SPHERE), False)
    _set_shadow(parts.light("dark", "AREA", (-2.5, 1, 3), energy=60, shape="SQUARE", size=1), False)
    parts.light("sun", "SUN", energy=0.5, angle=0.05).rotation_euler = (0.6, 0.3, 0)


def _spread(clay: Any) -> None:
    _ball("ball", (1.2, 0, 0.8), _glossy("shiny", 0.3))
    for x, degrees, shape in ((-1.5, 30, "SQUARE"), (1, 90, "DISK")):
        light = parts.light(f"{degrees} degrees", "AREA", (x, 0, 3), energy=60, shape=shape, size=0.8)
        light.data.spread = math.radians(degrees)
        light.rotation_euler = (0.2, -0.2 * x, 0)


def _excluded(clay: Any) -> None:
    for x, kind in ((-1.2, "diffuse"), (1.2, "glossy")):
        _ball(f"ball {kind}", (x, 0, 1), _glossy(f"shiny {kind}", 0.35))
    for x, kind in ((-3, "diffuse"), (3, "glossy")):
        light = parts.light(f"no {kind}", "POINT", (x, -2, 3), energy=200, **SPHERE)
        setattr(light, f"visible_{kind}", False)


def _few_bounces(clay: Any) -> None:
    parts.quad("wall", (0, 2, 1), clay).rotation_euler = (math.radians(90), 0, 0)
    _ball("ball", (0, 0.5, 1), clay)
    for x, bounces in ((-2, 0), (2, 1)):
        light = parts.light(f"{bounces} bounces", "POINT", (x, -1, 2.5), energy=100, **SPHERE)
        light.data.cycles.max_bounces = bounces


def _hidden(clay: Any) -> None:
    glow, _ = parts.shaded("glow", "ShaderNodeEmission", Color=(1, 0.4, 0.2, 1), Strength=3)
    mirror, _ = parts.shaded("mirror", "ShaderNodeBsdfGlossy", Roughness=0.1)
    parts.quad("mirror", (0, 2.5, 1), mirror).rotation_euler = (math.radians(90), 0, 0)
    for x, kind in enumerate(("camera", "diffuse", "glossy", "shadow"), start=-2):
        ball = _ball(f"no {kind}", (1.3 * x + 0.6, 0, 0.5), glow if kind != "shadow" else clay)
        ball.scale = (0.5,) * 3
        setattr(ball, f"visible_{kind}", False)
    parts.light("sun", "SUN", energy=1.5, angle=0.05).rotation_euler = (0.5, 0.3, 0)
    parts.world((0.2, 0.2, 0.2))


def _holdout(clay: Any) -> None:
    bpy.context.scene.render.film_transparent = True
    _ball("hole", (-1, 0, 1), clay).is_holdout = True
    _in_collection(_ball("in a collection", (1, 0, 1), clay)).holdout = True
    _ball("by its shader", (0, 2, 1.6), parts.shaded("hole", "ShaderNodeHoldout")[0])
    veil, tree = parts.material("veil")
    mix = tree.nodes.new("ShaderNodeMixShader")
    mix.inputs[0].default_value = 0.3
    for index, kind in enumerate(("Transparent", "Diffuse"), start=1):
        tree.links.new(tree.nodes.new(f"ShaderNodeBsdf{kind}").outputs[0], mix.inputs[index])
    tree.links.new(mix.outputs[0], tree.nodes["Material Output"].inputs["Surface"])
    upright = parts.quad("veil", (0, -1, 0.6), veil)
    upright.rotation_euler = (math.radians(80), 0, 0)
    upright.scale = (0.6,) * 3
    upright.is_holdout = True
    parts.light("sun", "SUN", energy=3, angle=0.05).rotation_euler = (0.5, 0.3, 0)


def _indirect_only(clay: Any) -> None:
    _in_collection(_ball("unseen", (0, 0, 1), clay)).indirect_only = True
    parts.light("sun", "SUN", energy=3, angle=0.05).rotation_euler = (0.5, 0.3, 0)


def _in_collection(blender_object: Any) -> Any:
    """The layer collection that now holds the object."""
    collection = bpy.data.collections.new(blender_object.name)
    for holder in list(blender_object.users_collection):
        holder.objects.unlink(blender_object)
    collection.objects.link(blender_object)
    bpy.context.scene.collection.children.link(collection)
    return bpy.context.view_layer.layer_collection.children[collection.name]
