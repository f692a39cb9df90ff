"""The scenes of indirect_scenes.py as Mitsuba can show them too; a name in SCENES builds one in Blender.

Mitsuba has no material like Blender's Principled: what is metallic becomes Glossy (GGX of one colour), all else
Diffuse. Point lights are spheres, without soft falloff.
"""

from __future__ import annotations

from collections.abc import Callable

import bpy

# isort: split
import indirect_scenes as scenes


def _make_plain(material: bpy.types.Material) -> None:
    tree = material.node_tree
    node = next((node for node in tree.nodes if node.type == "BSDF_PRINCIPLED"), None)
    if node is None:
        return
    color, roughness = tuple(node.inputs["Base Color"].default_value), node.inputs["Roughness"].default_value
    is_metal = node.inputs["Metallic"].default_value > 0.5
    tree.nodes.clear()
    plain = tree.nodes.new("ShaderNodeBsdfGlossy" if is_metal else "ShaderNodeBsdfDiffuse")
    plain.inputs["Color"].default_value = color
    if is_metal:
        plain.distribution = "GGX"
        plain.inputs["Roughness"].default_value = roughness
    tree.links.new(plain.outputs[0], tree.nodes.new("ShaderNodeOutputMaterial").inputs["Surface"])


def _plain(build: Callable[[], None]) -> Callable[[], None]:
    def build_plain() -> None:
        build()
        for material in bpy.data.materials:
            if material.node_tree:
                _make_plain(material)
        for light in bpy.data.lights:
            if light.type == "POINT":
                light.use_soft_falloff = False

    return build_plain


SCENES = {f"{name}-plain": _plain(build) for name, build in scenes.SCENES.items()}
