"""What a metal panel throws on a floor where glossy reflections are filtered, by Cycles and by Pivot; in the folder."""

from __future__ import annotations

import itertools
import math
from pathlib import Path

import bpy
import parts

SAMPLES = 1024


def main(folder: Path) -> None:
    """Pictures of direct light alone, and with one bounce: ENGINE_BOUNCES.exr."""
    _scene()
    scene = bpy.context.scene
    image, cycles, pivot = scene.render.image_settings, scene.cycles, scene.pivot
    image.file_format, image.color_depth = "OPEN_EXR", "32"
    cycles.device, cycles.use_adaptive_sampling, cycles.use_denoising = "CPU", False, False
    cycles.sample_clamp_indirect = 0
    cycles.samples = pivot.samples = SAMPLES
    cycles.blur_glossy = pivot.filter_glossy = 1
    for engine, bounces in itertools.product(("CYCLES", "PIVOT"), (0, 1)):
        scene.render.engine = engine
        cycles.max_bounces = pivot.max_bounces = bounces
        scene.render.filepath = str(folder / f"{engine}_{bounces}.exr")
        bpy.ops.render.render(write_still=True)


def _scene() -> None:
    """The camera sees the floor alone; the panel stands before a small light, and its two highlights are sharp."""
    parts.clear()
    parts.size(32, 32)
    parts.camera((0, -1.5, 6)).data.angle = math.radians(30)
    floor = parts.quad("floor", material=parts.shaded("floor", "ShaderNodeBsdfDiffuse", Color=(0.8, 0.8, 0.8, 1))[0])
    floor.scale = (5, 5, 1)
    metal, tree = parts.material("metal")
    mix = tree.nodes.new("ShaderNodeMixShader")
    for index, (roughness, color) in enumerate(((0.25, (0.9, 0.5, 0.2, 1)), (0.35, (0.2, 0.5, 0.9, 1))), start=1):
        glossy = tree.nodes.new("ShaderNodeBsdfGlossy")
        glossy.distribution = "GGX"
        glossy.inputs["Roughness"].default_value, glossy.inputs["Color"].default_value = roughness, color
        tree.links.new(glossy.outputs[0], mix.inputs[index])
    tree.links.new(mix.outputs[0], tree.nodes["Material Output"].inputs["Surface"])
    panel = parts.quad("panel", (0, 0.5, 0.8), metal)
    panel.rotation_euler, panel.scale = (math.pi / 2, 0, 0), (0.7, 0.7, 1)
    parts.light("lamp", "POINT", (0.6, -1.5, 1.8), energy=100, shadow_soft_size=0.1)
