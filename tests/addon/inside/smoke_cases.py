"""Smoke domains as exported, where this Blender can simulate them."""

from __future__ import annotations

import tempfile
from pathlib import Path
from typing import Any

import bpy
import numpy as np
import parts
from recording import Medium, Recording, VoxelGrid, record

FRAMES = 5
COLOR = (0.8, 0.4, 0.2, 1)


def main(folder: Path) -> Any:
    with tempfile.TemporaryDirectory() as cache:
        domain = smoke_domain(cache)
        scene = bpy.context.scene
        for frame in range(1, FRAMES + 1):
            scene.frame_set(frame)
        evaluated = domain.evaluated_get(bpy.context.evaluated_depsgraph_get())
        settings = evaluated.modifiers[0].domain_settings
        result = {
            "resolution": list(settings.domain_resolution),
            "density": np.array(settings.density_grid).tolist(),
            "flame": np.array(settings.flame_grid).tolist(),
            "color": np.array(settings.color_grid).tolist(),
            "temperature": np.array(settings.temperature_grid).tolist(),
        }
        for make in (_plain, _fire, _colored, _info, _attribute, _textured, _unlit):
            material = make()
            domain.data.materials.clear()
            if material:
                domain.data.materials.append(material)
            result[make.__name__[1:]] = _plain_values(record())
        bpy.context.view_layer.use_volumes = False
        result["off"] = _plain_values(record())
        bpy.context.view_layer.use_volumes = True
        scene.frame_set(300)
        result["late"] = _plain_values(record())
    return result


def smoke_domain(cache: str) -> Any:
    """A box of 4 x 4 x 6 m, a burning ball within; the camera sees it from above."""
    parts.clear()
    parts.camera((0, 0, 9))
    bpy.ops.mesh.primitive_cube_add(size=4, location=(1, 0, 0))
    domain = bpy.context.object
    domain.name, domain.scale = "domain", (1, 1, 1.5)
    modifier = domain.modifiers.new("Fluid", "FLUID")
    modifier.fluid_type = "DOMAIN"
    settings = modifier.domain_settings
    settings.domain_type, settings.resolution_max, settings.cache_directory = "GAS", 16, cache
    settings.use_adaptive_domain = settings.use_noise = False
    settings.openvdb_data_depth = "32"  # as exact as the grids in memory
    bpy.ops.mesh.primitive_ico_sphere_add(radius=0.6, location=(1.7, 0, -1))
    flow = bpy.context.object
    flow.name, flow.hide_render = "flow", True
    modifier = flow.modifiers.new("Fluid", "FLUID")
    modifier.fluid_type = "FLOW"
    settings = modifier.flow_settings
    settings.flow_type, settings.flow_behavior, settings.smoke_color = "BOTH", "INFLOW", (0.9, 0.3, 0.1)
    return domain


def principled(name: str, **inputs: Any) -> Any:
    material, tree = parts.material(name)
    node = tree.nodes.new("ShaderNodeVolumePrincipled")
    for key, value in inputs.items():
        node.inputs[key.replace("_", " ")].default_value = value
    tree.links.new(node.outputs[0], tree.nodes["Material Output"].inputs["Volume"])
    return material


def _plain() -> Any:
    return principled("plain", Color=COLOR, Density=3)


def _fire() -> Any:
    return principled("fire", Density=0, Blackbody_Intensity=1, Temperature=1500, Temperature_Attribute="flame")


def _colored() -> Any:
    return principled("colored", Color_Attribute="color", Color=(1, 1, 1, 1), Absorption_Color=(1, 1, 1, 1))


def _info() -> Any:
    """As colored, by nodes."""
    material, tree = parts.material("info")
    scatter, info = (tree.nodes.new(f"ShaderNodeVolume{kind}") for kind in ("Scatter", "Info"))
    for name in ("Color", "Density"):
        tree.links.new(info.outputs[name], scatter.inputs[name])
    tree.links.new(scatter.outputs[0], tree.nodes["Material Output"].inputs["Volume"])
    return material


def _attribute() -> Any:
    """Half the density above 0.25, by nodes."""
    material, tree = parts.material("attribute")
    scatter, half, read = (tree.nodes.new(f"ShaderNode{kind}") for kind in ("VolumeScatter", "Math", "Attribute"))
    read.attribute_name = "density"
    half.operation, half.inputs[1].default_value, half.inputs[2].default_value = "MULTIPLY_ADD", 0.5, -0.125
    scatter.inputs["Color"].default_value = COLOR
    tree.links.new(read.outputs["Fac"], half.inputs[0])
    tree.links.new(half.outputs[0], scatter.inputs["Density"])
    tree.links.new(scatter.outputs[0], tree.nodes["Material Output"].inputs["Volume"])
    return material


def _textured() -> Any:
    """The density times the object's own x."""
    material = principled("textured", Color=COLOR)
    tree = material.node_tree
    coordinates, parts_of = (tree.nodes.new(f"ShaderNode{kind}") for kind in ("TexCoord", "SeparateXYZ"))
    tree.links.new(coordinates.outputs["Object"], parts_of.inputs[0])
    tree.links.new(parts_of.outputs["X"], tree.nodes["Principled Volume"].inputs["Density"])
    return material


def _unlit() -> None:
    """No material: nothing is there."""


def _plain_values(recording: Recording) -> Any:
    return {
        "media": {name: _medium(medium) for name, medium in recording.media.items()},
        "without_surface": sorted(recording.without_surface),
        "instances": {group.name: group.materials for group in recording.instances},
        "reports": recording.reports,
    }


def _medium(medium: Medium) -> Any:
    values = {name: _grid(getattr(medium, name)) for name in ("density", "emission_grid")}
    return values | {"scattering": medium.scattering, "absorption": medium.absorption, "emission": medium.emission}


def _grid(grid: VoxelGrid | None) -> Any:
    if grid is None:
        return None
    return {"values": grid.values.tolist(), "grid_from_object": np.array(grid.grid_from_object).tolist()}
