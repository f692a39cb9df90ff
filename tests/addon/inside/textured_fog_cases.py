"""Fog whose nodes give something else at each place, as exported: some of its voxels, and what is said."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import bpy
import numpy as np
import parts
from recording import Recording, VoxelGrid, record

COLOR = (0.8, 0.4, 0.2, 1)
STEP = 16  # voxels, from one that is returned to the next


def main(folder: Path) -> Any:
    made = {}
    for make in (_density, _glow, _mixed, _colored, _shared, _same, _placed, _world):
        parts.clear()
        parts.camera()
        make()
        made[make.__name__[1:]] = _values(record())
    return made


def _box(name: str, material: Any) -> Any:
    """4 m long, 2 m wide and high."""
    bpy.ops.mesh.primitive_cube_add(size=2)
    made = bpy.context.object
    made.name, made.scale = name, (1, 1, 1)
    for vertex in made.data.vertices:
        vertex.co.x *= 2
    made.data.materials.append(material)
    return made


def _fog(kind: str, **inputs: Any) -> tuple[Any, Any, Any]:
    """A material of one volume node, that, and what is 0 at x = -1 m of the object and 1 at 1 m."""
    material, tree = parts.material("fog")
    node = tree.nodes.new(f"ShaderNode{kind}")
    for key, value in inputs.items():
        node.inputs[key.replace("_", " ")].default_value = value
    tree.links.new(node.outputs[0], tree.nodes["Material Output"].inputs["Volume"])
    coordinates, parts_of, ramp = (
        tree.nodes.new(f"ShaderNode{each}") for each in ("TexCoord", "SeparateXYZ", "MapRange")
    )
    ramp.inputs["From Min"].default_value = -1
    tree.links.new(coordinates.outputs["Object"], parts_of.inputs[0])
    tree.links.new(parts_of.outputs["X"], ramp.inputs[0])
    return material, node, ramp.outputs[0]


def _density() -> None:
    material, node, ramp = _fog("VolumePrincipled", Color=COLOR, Anisotropy=0.5)
    material.node_tree.links.new(ramp, node.inputs["Density"])
    _box("box", material)


def _glow() -> None:
    """With a density that is the same everywhere."""
    material, node, ramp = _fog("VolumePrincipled", Color=COLOR, Emission_Color=COLOR)
    material.node_tree.links.new(ramp, node.inputs["Emission Strength"])
    _box("box", material)


def _mixed() -> None:
    """Scattering where x is low, absorption of the same grey where it is high."""
    material, mix, ramp = _fog("MixShader")
    tree = material.node_tree
    for index, (kind, grey) in enumerate((("Scatter", 0.5), ("Absorption", 0.5)), start=1):
        node = tree.nodes.new(f"ShaderNodeVolume{kind}")
        node.inputs["Color"].default_value = (grey, grey, grey, 1)
        tree.links.new(node.outputs[0], mix.inputs[index])
    tree.links.new(ramp, mix.inputs[0])
    _box("box", material)


def _colored() -> None:
    material, node, ramp = _fog("VolumeScatter")
    ramp_of_colors = material.node_tree.nodes.new("ShaderNodeCombineXYZ")
    material.node_tree.links.new(ramp, ramp_of_colors.inputs["X"])
    ramp_of_colors.inputs["Y"].default_value = 0.5
    material.node_tree.links.new(ramp_of_colors.outputs[0], node.inputs["Color"])
    _box("box", material)


def _shared() -> None:
    """A material of two objects, one of which is longer."""
    material, node, ramp = _fog("VolumeScatter", Color=COLOR)
    material.node_tree.links.new(ramp, node.inputs["Density"])
    _box("short", material)
    _box("long", material).data.vertices[0].co.x = -6


def _same() -> None:
    """What depends on the object alone is the same everywhere in it."""
    material, node, _ = _fog("VolumeScatter", Color=COLOR)
    info = material.node_tree.nodes.new("ShaderNodeObjectInfo")
    material.node_tree.links.new(info.outputs["Object Index"], node.inputs["Density"])
    for index in (2, 3):
        _box(f"box {index}", material).pass_index = index


def _placed() -> None:
    """Instances of one object, with a density by where they are in the world."""
    material, node, _ = _fog("VolumeScatter", Color=COLOR)
    tree = material.node_tree
    geometry, parts_of = tree.nodes.new("ShaderNodeNewGeometry"), tree.nodes.new("ShaderNodeSeparateXYZ")
    tree.links.new(geometry.outputs["Position"], parts_of.inputs[0])
    tree.links.new(parts_of.outputs["Z"], node.inputs["Density"])
    box = _box("box", material)
    parent = parts.quad("parent")
    box.parent, parent.instance_type = parent, "VERTS"


def _world() -> None:
    tree = parts.world((0, 0, 0)).node_tree
    scatter, noise = tree.nodes.new("ShaderNodeVolumeScatter"), tree.nodes.new("ShaderNodeTexNoise")
    tree.links.new(noise.outputs[0], scatter.inputs["Density"])
    output = next(each for each in tree.nodes if each.type == "OUTPUT_WORLD")
    tree.links.new(scatter.outputs[0], output.inputs["Volume"])


def _values(recording: Recording) -> Any:
    media = {**recording.media, "world": recording.world_medium}
    return {
        "media": {name: _medium(medium) for name, medium in media.items() if medium is not None},
        "instances": [[group.name, group.materials] for group in recording.instances],
        "reports": recording.reports,
    }


def _medium(medium: Any) -> Any:
    plain = {name: getattr(medium, name) for name in ("scattering", "absorption", "emission")}
    return plain | {name: _voxels(getattr(medium, name)) for name in ("density", "emission_grid")}


def _voxels(grid: VoxelGrid | None) -> Any:
    """Where some are in object space, and what they hold; along x."""
    if grid is None:
        return None
    values = np.asarray(grid.values)
    z, y, count = values.shape[0] // 3, values.shape[1] // 3, values.shape[2]
    index = np.arange(0, count, STEP)
    places = np.stack([index, np.full(len(index), y), np.full(len(index), z), np.ones(len(index))], axis=1)
    return {
        "size": values.shape[:3],
        "places": (places @ np.linalg.inv(np.asarray(grid.grid_from_object, float)).T)[:, :3].tolist(),
        "values": values[z, y, index].tolist(),
    }
