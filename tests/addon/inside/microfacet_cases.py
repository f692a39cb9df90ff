"""Materials of which an image tells the microfacets, rendered: beside the roughness that was drawn, beside the map
whose normals were gathered, and where the image cannot be one. Pictures as files."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import bpy
import numpy as np
import parts
from recording import record

ROUGHNESS = 0.4
TILES = 64  # of the map, so that a pixel sees many of its texels


def main(folder: Path) -> Any:
    _drawn(folder)
    _from_afar(folder)
    return {"said": _said(), "lobes": _lobes(folder)}


def _start(kind: str, **inputs: Any) -> tuple[Any, Any]:
    """A quad of one shader with a UV map, seen and lit from the side; its material and the shader's node."""
    parts.clear()
    material, node = parts.shaded("metal", kind, **inputs)
    quad = parts.quad("quad", material=material)
    layer = quad.data.uv_layers.new(name="UVMap")
    for corner, place in zip(layer.data, ((0, 0), (1, 0), (1, 1), (0, 1)), strict=True):
        corner.uv = place
    bpy.context.view_layer.objects.active = quad
    parts.camera((0, -4, 4), (np.pi / 4, 0, 0))
    parts.light("lamp", "AREA", (1, 3, 3), energy=200, size=1.5).rotation_euler = (-0.8, 0.2, 0)
    parts.size(24, 24)
    return material, node


def _render(folder: Path, name: str, engine: str, samples: int, filter_px: float = 0.01, **settings: Any) -> None:
    for key, value in settings.items():
        setattr(bpy.context.scene.pivot, key, value)
    bpy.context.scene.cycles.max_bounces = bpy.context.scene.pivot.max_bounces = 0
    parts.render_steady(folder / f"{name}.exr", engine, samples, filter_px)


def _drawn(folder: Path) -> None:
    for name, integrator in (("monte carlo", "MONTE_CARLO"), ("analytic", "ANALYTIC")):
        material, _ = _start("ShaderNodeBsdfGlossy", Roughness=ROUGHNESS)
        bpy.ops.pivot.ndf_draw(roughness_x=ROUGHNESS, roughness_y=ROUGHNESS, size=256)
        for part, is_used in (("image", True), ("node", False)):
            material.pivot.use_ndf_image = is_used
            _render(folder, f"{name} {part}", "PIVOT", 64, integrator=integrator)


def _from_afar(folder: Path) -> None:
    """A map of bumps, tiled: by Cycles with its texels below a pixel, and by Pivot as microfacets."""
    _, node = _start("ShaderNodeBsdfGlossy", Roughness=0.3)
    tree = node.id_data
    image = bpy.data.images.new("bumps", 64, 64, float_buffer=True, is_data=True)
    places = (np.arange(64) + 0.5) / 64 * 2 * np.pi
    x, y = np.meshgrid(places, places)
    normal = np.stack([-0.25 * np.cos(x), -0.1 * np.cos(2 * y), np.ones_like(x)], -1)
    normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
    image.pixels.foreach_set(np.dstack([normal * 0.5 + 0.5, np.ones_like(x)]).astype(np.float32).ravel())
    image.pack()
    texture, turned = tree.nodes.new("ShaderNodeTexImage"), tree.nodes.new("ShaderNodeNormalMap")
    texture.image = image
    places_of, scaled = tree.nodes.new("ShaderNodeUVMap"), tree.nodes.new("ShaderNodeMapping")
    scaled.inputs["Scale"].default_value = (TILES, TILES, 1)
    tree.links.new(places_of.outputs[0], scaled.inputs["Vector"])
    tree.links.new(scaled.outputs[0], texture.inputs["Vector"])
    tree.links.new(texture.outputs["Color"], turned.inputs["Color"])
    link = tree.links.new(turned.outputs[0], node.inputs["Normal"])
    _render(folder, "map", "CYCLES", 256, filter_px=1.5)
    bpy.ops.pivot.ndf_from_map(image="bumps", roughness=0.3, size=256)
    tree.links.remove(link)
    _render(folder, "gathered", "PIVOT", 256, filter_px=1.5)


def _reports() -> list[str]:
    try:
        return record().reports
    except RuntimeError as error:
        return [str(error)]


def _said() -> dict[str, list[str]]:
    result = {}
    for name in ("black", "negative", "oblong", "unread", "none"):
        material, _ = _start("ShaderNodeBsdfGlossy", Roughness=ROUGHNESS)
        material.pivot.use_ndf_image = True
        if name != "none":
            image = bpy.data.images.new(name, 16 if name == "oblong" else 8, 8, float_buffer=True, is_data=True)
            image.pixels.foreach_set(np.full(image.size[0] * 32, -1.0 if name == "negative" else 0.0, np.float32))
            if name == "unread":
                image.source, image.filepath = "FILE", "//nowhere.exr"
            material.pivot.ndf_image = image
        result[name] = _reports()
    return result


def _lobes(folder: Path) -> list[str]:
    """All lobes of a mix keep their colours; what is too many is said."""
    _, node = _start("ShaderNodeBsdfGlossy", Roughness=ROUGHNESS, Color=(1, 0, 0, 1))
    tree = node.id_data
    whole = node
    for kind, colour in (("Glossy", (0, 1, 0, 1)), ("Translucent", (0, 0, 1, 1)), ("Diffuse", (1, 1, 1, 1))):
        other, added = tree.nodes.new(f"ShaderNodeBsdf{kind}"), tree.nodes.new("ShaderNodeAddShader")
        other.inputs["Color"].default_value = colour
        tree.links.new(whole.outputs[0], added.inputs[0])
        tree.links.new(other.outputs[0], added.inputs[1])
        whole = added
    tree.links.new(whole.outputs[0], tree.nodes["Material Output"].inputs["Surface"])
    bpy.ops.pivot.ndf_weave(size=128)
    _render(folder, "lobes", "PIVOT", 16)
    return _reports()
