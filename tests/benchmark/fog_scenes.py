"""The scenes of fog.py, built in Blender; a name in SCENES tells how, and how many times light scatters.

Metres and watts, z up. What surrounds the fog never shares a plane with what stands in it.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

import bpy

# isort: split
import indirect_scenes as parts
from mathutils import Matrix

WIDTH, HEIGHT = 320, 180
SMOKE = Path(__file__).resolve().parents[2] / "build" / "fog" / "smoke.vdb"  # by fog_smoke.py


# -- media
def fog(anisotropy: float, density: float) -> bpy.types.Material:
    """Of white particles; density: 1/m."""
    material = bpy.data.materials.new("fog")
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    node, output = tree.nodes.new("ShaderNodeVolumeScatter"), tree.nodes.new("ShaderNodeOutputMaterial")
    for key, value in {"Color": (1.0, 1.0, 1.0, 1.0), "Density": density, "Anisotropy": anisotropy}.items():
        node.inputs[key].default_value = value
    tree.links.new(node.outputs[0], output.inputs["Volume"])
    return material


def smoke(anisotropy: float, density: float) -> bpy.types.Material:
    """Of what a volume's grid holds, times density."""
    material = bpy.data.materials.new("smoke")
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    node, output = tree.nodes.new("ShaderNodeVolumePrincipled"), tree.nodes.new("ShaderNodeOutputMaterial")
    for key, value in {"Color": (0.85, 0.85, 0.85, 1.0), "Density": density, "Anisotropy": anisotropy}.items():
        node.inputs[key].default_value = value
    tree.links.new(node.outputs[0], output.inputs["Volume"])
    return material


def fill_world(anisotropy: float, density: float) -> None:
    parts.world((0.0, 0.0, 0.0))
    tree: Any = bpy.context.scene.world.node_tree
    node = tree.nodes.new("ShaderNodeVolumeScatter")
    node.inputs["Density"].default_value, node.inputs["Anisotropy"].default_value = density, anisotropy
    output = next(node for node in tree.nodes if node.type == "OUTPUT_WORLD")
    tree.links.new(node.outputs[0], output.inputs["Volume"])


# -- scenes
def one_sphere(anisotropy: float, world: bool, soft_falloff: bool) -> None:
    """A lamp behind a screen of slats, which throws shafts at the camera, and a ball beside it.

    world: fog everywhere, else in a box around the camera. soft_falloff: Blender's default, a disk that faces what it
    lights, in the place of a sphere.
    """
    floor = parts.principled("floor", (0.25, 0.24, 0.23), Roughness=0.7)
    parts.box("floor", (-6.0, -5.0, -0.3), (6.0, 6.0, 0.0), floor)
    wood = parts.principled("wood", (0.3, 0.2, 0.12), Roughness=0.5)
    for number in range(8):
        x = -1.5 + 0.4 * number
        parts.box(f"slat {number}", (x, 1.0, -0.1), (x + 0.2, 1.06, 2.3), wood)
    parts.box("rail", (-1.6, 0.99, 2.25), (1.7, 1.07, 2.4), wood)
    parts.ball("ball", (0.9, -0.3, 0.4), 0.4, parts.metal("steel", (0.7, 0.7, 0.72), 0.3))
    settings = {"energy": 300.0, "shadow_soft_size": 0.15, "use_soft_falloff": soft_falloff}
    parts.light("lamp", "POINT", (0.1, 2.2, 1.5), (0.0, 0.0, 0.0), (1.0, 0.9, 0.75), **settings)
    if world:
        fill_world(anisotropy, 0.08)
    else:
        parts.world((0.0, 0.0, 0.0))
        parts.box("fog", (-3.5, -4.5, -0.15), (3.5, 4.0, 3.2), fog(anisotropy, 0.15))
    parts.camera((-0.6, -4.0, 1.3), (0.15, 1.0, 1.15), 32.0)


def four_lights(anisotropy: float) -> None:
    """A sphere, an area light, a sun and a spot over glossy things, in a box of fog seen from without."""
    floor = parts.principled("floor", (0.2, 0.2, 0.22), Roughness=0.25)
    parts.box("floor", (-5.0, -4.0, -0.3), (5.0, 5.0, 0.0), floor)
    metals = (((0.95, 0.64, 0.54), 0.12), ((0.9, 0.9, 0.92), 0.25), ((1.0, 0.77, 0.34), 0.4))
    for number, (color, roughness) in enumerate(metals):
        x, radius_m = -1.3 + 1.25 * number, 0.45 - 0.05 * number
        shine = parts.metal(f"metal {number}", color, roughness)
        parts.ball(f"ball {number}", (x, 0.3 * number, radius_m), radius_m, shine)
    lacquer = parts.principled("lacquer", (0.05, 0.2, 0.3), Roughness=0.15)
    parts.box("pillar", (-2.3, 1.2, -0.1), (-1.9, 1.6, 2.2), lacquer)
    parts.box("shelf", (1.2, 1.0, 1.2), (2.4, 2.0, 1.26), lacquer)
    parts.light("lamp", "POINT", (2.0, 1.5, 2.1), (0, 0, 0), (1.0, 0.75, 0.5), energy=80.0, shadow_soft_size=0.1)
    spot = {"spot_size": math.radians(34), "spot_blend": 0.3, "shadow_soft_size": 0.06}
    parts.light("spot", "SPOT", (-2.6, -1.4, 2.8), (-0.2, 0.4, 0.2), (0.6, 0.8, 1.0), energy=500.0, **spot)
    size = {"shape": "RECTANGLE", "size": 0.8, "size_y": 0.4}
    parts.light("panel", "AREA", (0.4, -0.5, 2.9), (0.2, 0.4, 0.0), (0.9, 1.0, 0.9), energy=60.0, **size)
    parts.light("sun", "SUN", (6.0, 4.0, 5.0), (0, 0, 0), (1.0, 0.6, 0.4), energy=0.8, angle=math.radians(2.0))
    parts.world((0.01, 0.01, 0.012))
    parts.box("fog", (-3.1, -2.1, -0.15), (3.1, 3.2, 3.1), fog(anisotropy, 0.1))
    parts.camera((-0.3, -6.0, 1.7), (0.0, 0.2, 1.0), 38.0)


def puffs(anisotropy: float) -> None:
    """Heterogeneous smoke over a floor, under a lamp."""
    parts.box("floor", (-4.0, -4.0, -0.3), (4.0, 4.0, 0.0), parts.principled("floor", (0.3, 0.3, 0.3), Roughness=0.6))
    data = bpy.data.volumes.new("smoke")
    data.filepath = str(SMOKE)
    data.materials.append(smoke(anisotropy, 6.0))
    parts.link("smoke", data, Matrix.Translation((0.0, 0.0, 1.2)))
    settings = {"energy": 250.0, "shadow_soft_size": 0.15, "use_soft_falloff": False}
    parts.light("lamp", "POINT", (1.5, 0.7, 2.9), (0.0, 0.0, 0.0), (1.0, 0.9, 0.8), **settings)
    parts.world((0.02, 0.025, 0.03))
    parts.camera((0.0, -5.5, 1.6), (0.0, 0.0, 0.95), 42.0)


@dataclass(frozen=True)
class FogScene:
    build: Callable[[], None]
    bounces: int = 0  # 0: light scatters once
    several_lights: bool = False


# Where light scatters more than once, Cycles (4.5 to 5.3) loses some of what a sphere without soft falloff gives fog
# within itself: 4 % of the picture, tried against a direct double integral. So there the falloff is soft.
SCENES = {
    f"sphere {anisotropy} {name}": FogScene(
        partial(one_sphere, anisotropy, world=False, soft_falloff=bounces > 0), bounces
    )
    for bounces, name in ((0, "single"), (2, "2 bounces"))
    for anisotropy in (0.3, 0.8, 0.9)
} | {
    "sphere 0.8 world": FogScene(partial(one_sphere, 0.8, world=True, soft_falloff=False)),
    "lights 0.6 single": FogScene(partial(four_lights, 0.6), several_lights=True),
    "lights 0.6 2 bounces": FogScene(partial(four_lights, 0.6), 2, several_lights=True),
    "smoke 0.3 single": FogScene(partial(puffs, 0.3)),
    "smoke 0.3 2 bounces": FogScene(partial(puffs, 0.3), 2),
}


def build(name: str) -> None:
    bpy.ops.wm.read_factory_settings(use_empty=True)
    SCENES[name].build()
    render = bpy.context.scene.render
    render.resolution_x, render.resolution_y, render.resolution_percentage = WIDTH, HEIGHT, 100
