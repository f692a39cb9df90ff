"""Leaves cut out by a picture's alpha, coloured panes and stacked veils, rendered by Cycles and by Pivot."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import bpy
import numpy as np
import parts
from cycles_cases import SPHERE, by_both, directly_by_both

ANALYTIC_SAMPLES = 32
CASES = ("leaves", "panes", "veils")


def main(folder: Path) -> Any:
    for name in CASES:
        parts.clear()
        parts.size(64, 48)
        parts.camera((0, -7, 4.5), (math.radians(60), 0, 0)).data.lens = 38
        clay, _ = parts.shaded("clay", "ShaderNodeBsdfDiffuse", Color=(0.7, 0.6, 0.5, 1))
        parts.quad("ground", material=clay).scale = (6, 6, 1)
        bpy.context.scene.cycles.transparent_max_bounces = 3
        globals()[f"_{name}"]()
        by_both(folder, name, 1)
        # The analytic integrator counts what is seen through, and what shades, each by itself.
        bpy.context.scene.cycles.transparent_max_bounces = 30
        directly_by_both(folder, name, ANALYTIC_SAMPLES)
    return list(CASES)


def _leaves() -> None:
    size = 64
    y, x = np.mgrid[0:size, 0:size] / (size - 1) * 2 - 1
    edge = 0.8 + 0.15 * np.cos(7 * np.arctan2(y, x)) - np.hypot(1.6 * x, y)
    pixels = np.ones((size, size, 4), np.float32) * np.array((0.3, 0.6, 0.2, 1), np.float32)
    pixels[..., 3] = np.clip(20 * edge, 0, 1)
    image = bpy.data.images.new("leaf", size, size, alpha=True)
    image.pixels.foreach_set(pixels.ravel())
    image.pack()
    material, tree = parts.material("leaf")
    picture, mix = tree.nodes.new("ShaderNodeTexImage"), tree.nodes.new("ShaderNodeMixShader")
    clear, green = (tree.nodes.new(f"ShaderNodeBsdf{kind}") for kind in ("Transparent", "Diffuse"))
    picture.image = image
    tree.links.new(picture.outputs["Alpha"], mix.inputs[0])
    tree.links.new(picture.outputs["Color"], green.inputs["Color"])
    tree.links.new(clear.outputs[0], mix.inputs[1])
    tree.links.new(green.outputs[0], mix.inputs[2])
    tree.links.new(mix.outputs[0], tree.nodes["Material Output"].inputs["Surface"])
    random = np.random.default_rng(1)
    for i in range(10):
        leaf = parts.quad(f"leaf {i}", random.uniform((-2.4, -1.5, 0.6), (2.4, 2, 2.2)), material)
        uv = leaf.data.uv_layers.new(name="UVMap")
        uv.data.foreach_set("uv", [0.0, 0.0, 1.0, 0.0, 1.0, 1.0, 0.0, 1.0])
        leaf.rotation_euler = random.uniform(-1.2, 1.2, 3)
        leaf.scale = (0.7,) * 3
    parts.light("sun", "SUN", energy=3, angle=0.05).rotation_euler = (0.5, 0.3, 0)
    parts.light("ball", "POINT", (2, -2, 3), energy=80, **SPHERE)


def _panes() -> None:
    for i, color in enumerate(((1, 0.5, 0.3, 1), (0.4, 0.9, 0.5, 1), (0.5, 0.5, 1, 1))):
        material, _ = parts.shaded(f"pane {i}", "ShaderNodeBsdfTransparent", Color=color)
        parts.quad(f"pane {i}", (1.1 * i - 1.2, 0.2 * i, 1 + 0.35 * i), material)
    lamp = parts.light("lamp", "AREA", (1.5, -1, 4.5), energy=150, shape="SQUARE", size=1.5)
    lamp.rotation_euler = (0.2, 0.2, 0)
    shining, _ = parts.shaded("shining", "ShaderNodeEmission", Color=(0.3, 0.5, 1, 1), Strength=2)
    parts.quad("shining", (0, 2, 1.5), shining).rotation_euler = (math.radians(90), 0, 0)


def _veils() -> None:
    """More of them than light may pass."""
    material, tree = parts.material("veil")
    mix = tree.nodes.new("ShaderNodeMixShader")
    mix.inputs[0].default_value = 0.3
    for index, kind in enumerate(("Transparent", "Diffuse"), start=1):
        tree.links.new(tree.nodes.new(f"ShaderNodeBsdf{kind}").outputs[0], mix.inputs[index])
    tree.links.new(mix.outputs[0], tree.nodes["Material Output"].inputs["Surface"])
    for i in range(7):
        parts.quad(f"upright {i}", (-1.5, 0.15 * i - 0.5, 1), material).rotation_euler = (math.radians(85), 0, 0)
        parts.quad(f"level {i}", (1.5, 0, 0.7 + 0.15 * i), material)
    parts.light("sun", "SUN", energy=3, angle=0.05).rotation_euler = (0.5, 0.3, 0)
    parts.world((0.3, 0.3, 0.3))
