"""Anisotropic highlights, those that are not GGX's, coats and metals by their index of refraction, rendered by Cycles
and by Pivot.

Before Blender 4.0 Principled is another than what Pivot follows, and only Glossy BSDF is compared.
"""

from __future__ import annotations

import math
import sys
from pathlib import Path
from typing import Any

import bpy
import parts
from cycles_cases import OLD, SPHERE, _ball, by_both, directly_by_both

PRINCIPLED, METALLIC = "ShaderNodeBsdfPrincipled", "ShaderNodeBsdfMetallic"
GOLD, PAINT = (0.9, 0.6, 0.3, 1), (0.5, 0.05, 0.03, 1)
COATED = {"Base_Color": PAINT, "Roughness": 0.6, "Coat_Weight": 1.0}


def cases() -> list[str]:
    return ["brushed", "facets"] + ([] if OLD else ["coats"]) + (["metals"] if bpy.app.version >= (4, 3) else [])


def main(folder: Path) -> Any:
    for name in cases():
        parts.clear()
        parts.size(80, 32)
        parts.camera((0, -8, 2.5), (math.radians(74), 0, 0)).data.lens = 26
        globals()[f"_{name}"]()
        parts.light("ball", "POINT", (-2, -2.5, 3.5), energy=150, **SPHERE)
        lamp = parts.light("lamp", "AREA", (2.5, -1, 4), energy=150, shape="RECTANGLE", size=2, size_y=0.8)
        lamp.rotation_euler = (0.3, 0.4, 0)
        parts.world((0.2, 0.2, 0.2))
        by_both(folder, name, 1)
        directly_by_both(folder, name, samples=8)
    return cases()


def _place(*looks: tuple[str, str, dict[str, Any]]) -> list[Any]:
    """Materials, of a ground and of balls upon it: kind, distribution and inputs. Their nodes."""
    nodes = []
    for index, (kind, distribution, inputs) in enumerate(looks):
        material, node = parts.shaded(f"look {index}", kind, **inputs)
        node.distribution = distribution
        nodes.append(node)
        if index == 0:
            parts.quad("ground", (0, 1, -1), material).scale = (6, 4, 1)
        else:
            _ball(f"ball {index}", (2.2 * (index - len(looks) / 2), 0, 0), material)
    return nodes


def _feed(node: Any, socket: str, kind: str, **settings: Any) -> Any:
    """A new node linked to an input of another."""
    tree = node.id_data
    feeding = tree.nodes.new(kind)
    for name, value in settings.items():
        setattr(feeding, name, value)
    tree.links.new(feeding.outputs[0], node.inputs[socket])
    return feeding


def _brushed() -> None:
    glossy = "ShaderNodeBsdfAnisotropic"
    inputs = {"Color": GOLD, "Roughness": 0.4}
    looks = [
        (glossy, "GGX", inputs | {"Anisotropy": -0.7, "Rotation": 0.1}),
        (glossy, "GGX", inputs | {"Anisotropy": 0.7}),
        (glossy, "GGX", inputs | {"Anisotropy": 0.9, "Roughness": 0.6}),
    ]
    if not OLD:
        brushed = {"Base_Color": GOLD, "Metallic": 1.0, "Roughness": 0.4, "Anisotropic": 0.8}
        plastic = {"Base_Color": PAINT, "Roughness": 0.4, "Anisotropic": 1.0, "Anisotropic_Rotation": 0.3}
        looks += [(PRINCIPLED, "MULTI_GGX", brushed), (PRINCIPLED, "MULTI_GGX", plastic)]
    nodes = _place(*looks)
    _feed(nodes[2], "Tangent", "ShaderNodeTangent", direction_type="UV_MAP")
    _feed(nodes[1], "Tangent", "ShaderNodeTangent", direction_type="RADIAL", axis="X")


def _facets() -> None:
    """Beckmann's and Ashikhmin's and Shirley's."""
    brushed = "ShaderNodeBsdfAnisotropic"
    inputs = {"Color": GOLD, "Roughness": 0.5}
    looks = [
        ("ShaderNodeBsdfGlossy", "BECKMANN", inputs),
        (brushed, "BECKMANN", inputs | {"Anisotropy": 0.6}),
        (brushed, "ASHIKHMIN_SHIRLEY", inputs),
        (brushed, "ASHIKHMIN_SHIRLEY", inputs | {"Anisotropy": -0.6}),
        ("ShaderNodeBsdfGlossy", "BECKMANN", inputs | {"Roughness": 0.9}),
    ]
    _place(*looks)


def _coats() -> None:
    looks = [
        COATED | {"Roughness": 0.5, "Coat_Roughness": 0.2},
        COATED | {"Coat_Roughness": 0.3, "Coat_IOR": 2.0},
        COATED | {"Base_Color": GOLD, "Metallic": 1.0, "Coat_Tint": (0.3, 0.7, 0.9, 1)},
        COATED
        | {"Coat_Weight": 0.5, "Coat_Roughness": 0.3, "Coat_Tint": (0.9, 0.3, 0.1, 1), "Base_Color": (1, 1, 1, 1)},
        COATED | {"Coat_Roughness": 0.2},
    ]
    nodes = _place(*((PRINCIPLED, "MULTI_GGX", inputs) for inputs in looks))
    bump = _feed(nodes[4], "Normal", "ShaderNodeBump")
    bump.inputs["Strength"].default_value, bump.inputs["Distance"].default_value = 0.5, 0.1
    _feed(bump, "Height", "ShaderNodeTexNoise")


def _metals() -> None:
    tinted = {"Base_Color": GOLD, "Metallic": 1.0, "Specular_Tint": (0.2, 0.4, 0.6, 1), "Roughness": 0.2}
    nodes = _place(
        (METALLIC, "MULTI_GGX", {"Roughness": 0.3}),
        (METALLIC, "GGX", {"Roughness": 0.5}),
        (METALLIC, "MULTI_GGX", {"Base_Color": GOLD, "Edge_Tint": (0.3, 0.6, 0.9, 1), "Roughness": 0.4}),
        (METALLIC, "MULTI_GGX", {"Roughness": 0.5, "Anisotropy": 0.8, "Rotation": 0.2}),
        (PRINCIPLED, "GGX", tinted),
    )
    nodes[2].fresnel_type = "F82"
    indices = {
        0: ((0.14, 0.4, 1.5), (4, 2.4, 1.6)),
        1: ((2.7, 2.5, 2.3), (3, 2.5, 2)),
        3: ((0.2, 0.9, 1.1), (3.9, 2.4, 2.2)),
    }
    for place, (ior, extinction) in indices.items():
        nodes[place].fresnel_type = "PHYSICAL_CONDUCTOR"
        nodes[place].inputs["IOR"].default_value = ior
        nodes[place].inputs["Extinction"].default_value = extinction


if __name__ == "__main__":
    main(Path(sys.argv[-1]))
