"""What Ambient Occlusion nodes tell, as light that shines from balls on a floor, by Cycles and by Pivot; as files."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import bpy
import parts

SAMPLES = 64
CASES: dict[str, dict[str, Any]] = {
    "around": {},
    "near": {"Distance": 0.4},
    "inside": {"inside": True, "Distance": 0.8},
    "own": {"only_local": True, "Distance": 3},
    "few": {"samples": 1, "Color": (0.8, 0.4, 0.2, 1)},
}


def main(folder: Path) -> Any:
    """Returns the names of the pictures."""
    _balls()
    for name, settings in CASES.items():
        material, tree = parts.material(name)
        _occlusion(tree, settings)
        for blender_object in bpy.context.scene.objects:
            if blender_object.type == "MESH":
                blender_object.data.materials.clear()
                blender_object.data.materials.append(material)
        for engine in ("CYCLES", "PIVOT"):
            parts.render_steady(folder / f"{name}_{engine}.exr", engine, SAMPLES, 1.0)
    return list(CASES)


def _occlusion(tree: Any, settings: dict[str, Any]) -> None:
    node, emission = (tree.nodes.new(f"ShaderNode{kind}") for kind in ("AmbientOcclusion", "Emission"))
    for name, value in settings.items():
        if name in node.inputs:
            node.inputs[name].default_value = value
        else:
            setattr(node, name, value)
    tree.links.new(node.outputs["Color"], emission.inputs["Color"])
    tree.links.new(emission.outputs[0], tree.nodes["Material Output"].inputs["Surface"])


def _balls() -> None:
    """Two that touch, over a floor that is bent upwards at the back."""
    parts.clear()
    parts.size(48, 32)
    parts.camera((0, -7, 3.5), (math.radians(66), 0, 0)).data.lens = 42
    parts.quad("floor").scale = (4, 4, 1)
    wall = parts.quad("wall", (0, 1.5, 1))
    wall.rotation_euler.x = math.radians(70)
    for x in (-0.8, 0.8):
        bpy.ops.mesh.primitive_uv_sphere_add(segments=32, ring_count=16, radius=0.8, location=(x, 0, 0.8))
        bpy.context.object.data.polygons.foreach_set("use_smooth", [True] * 512)
