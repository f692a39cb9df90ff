"""Worlds that light some things only, shadows of glass that is opaque to them, and paths bounded by kind, by Cycles and
by Pivot."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import bpy
import parts
from cycles_cases import SPHERE, _ball, _cycles, _pivot, _save, on_clay
from visibility_cases import _glossy

WORLDS = {"no_diffuse": "diffuse", "no_glossy": "glossy", "no_transmission": "transmission"}
LIMITS = {"diffuse_limit": "diffuse", "glossy_limit": "glossy", "transmission_limit": "transmission"}
CASES = (*WORLDS, "uneven_no_diffuse", "few_world_bounces", "opaque_to_shadows", *LIMITS)


def main(folder: Path) -> Any:
    for name in CASES:
        clay, _ = on_clay()
        _ball("clay", (-2, 0, 0.8), clay).scale = (0.8,) * 3
        _ball("shiny", (0, 0, 0.8), _glossy("shiny", 0.3)).scale = (0.8,) * 3
        glass, node = parts.shaded("glass", "ShaderNodeBsdfGlass", Roughness=0.3)
        node.distribution = "GGX"
        _ball("glass", (2, 0, 0.8), glass).scale = (0.8,) * 3
        world = parts.world((0.4, 0.5, 0.6))
        if name in WORLDS:
            setattr(world.cycles_visibility, WORLDS[name], False)
        elif name not in LIMITS:
            globals()[f"_{name}"](world)
        if name in LIMITS:
            _render_limited(folder, name, LIMITS[name])
            continue
        _cycles(folder / f"{name}_CYCLES.exr", 2)
        _pivot(folder / f"{name}_MONTE_CARLO.exr", 2, "JOINT")
    return list(CASES)


def _render_limited(folder: Path, name: str, kind: str) -> None:
    parts.light("lamp", "POINT", (0, -2, 3.5), energy=150, **SPHERE)
    scene = bpy.context.scene
    _cycles(folder / f"{name}_CYCLES.exr", 4, samples=1)
    scene.cycles.samples = 256
    setattr(scene.cycles, f"{kind}_bounces", 1 if kind != "transmission" else 0)
    _save(folder / f"{name}_CYCLES.exr")
    setattr(scene.pivot, f"{kind}_bounces", 1 if kind != "transmission" else 0)
    _pivot(folder / f"{name}_MONTE_CARLO.exr", 4, "JOINT")


def _uneven_no_diffuse(world: Any) -> None:
    """A world that is sampled: bright to the left and to the right."""
    tree = world.node_tree
    split = tree.nodes.new("ShaderNodeSeparateXYZ")
    tree.links.new(tree.nodes.new("ShaderNodeTexCoord").outputs["Generated"], split.inputs[0])
    size = tree.nodes.new("ShaderNodeMath")
    size.operation = "ABSOLUTE"
    tree.links.new(split.outputs["X"], size.inputs[0])
    tree.links.new(size.outputs[0], tree.nodes["Background"].inputs["Color"])
    world.cycles_visibility.diffuse = False


def _few_world_bounces(world: Any) -> None:
    _uneven_no_diffuse(world)
    world.cycles_visibility.diffuse = True
    world.cycles.max_bounces = 0


def _opaque_to_shadows(world: Any) -> None:
    veil, tree = parts.material("veil")
    mix = tree.nodes.new("ShaderNodeMixShader")
    mix.inputs[0].default_value = 0.3
    for index, kind in enumerate(("Transparent", "Diffuse"), start=1):
        tree.links.new(tree.nodes.new(f"ShaderNodeBsdf{kind}").outputs[0], mix.inputs[index])
    tree.links.new(mix.outputs[0], tree.nodes["Material Output"].inputs["Surface"])
    settings = veil if hasattr(veil, "use_transparent_shadow") else veil.cycles
    settings.use_transparent_shadow = False
    parts.quad("veil", (0, -0.5, 2), veil).scale = (1.5, 0.7, 1)
    parts.light("sun", "SUN", energy=2, angle=0.05).rotation_euler = (0.3, 0.2, 0)
