"""Fog rendered by Cycles and by Pivot, as files in the folder; both with as many bounces."""

from __future__ import annotations

import math
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

import bpy
import numpy as np
import parts
import smoke_cases

SIZE = 24
SAMPLES = {"CYCLES": 256, "PIVOT": 128}
COLOR = (0.8, 0.5, 0.3, 1)
SPHERE: dict[str, Any] = {"shadow_soft_size": 0.4}
if bpy.app.version >= (4, 0):
    SPHERE["use_soft_falloff"] = False


def main(folder: Path) -> list[str]:
    """Returns the scenes' names."""
    names = []
    for make, bounces in SCENES:
        name = make.__name__[1:] + ("" if bounces == 0 else f"_{bounces}")
        with tempfile.TemporaryDirectory() as scratch:
            if make(Path(scratch)) is None:
                continue
            for engine in ("CYCLES", "PIVOT"):
                _render(folder / f"{name}_{engine}.exr", engine, bounces)
        names.append(name)
    return names


def _scene() -> None:
    """A grey ground under a ball lamp and a little sky."""
    parts.clear()
    parts.size(SIZE, SIZE)
    parts.camera((0, -6, 2), (math.radians(76), 0, 0)).data.lens = 45
    ground = parts.quad(
        "ground", (0, 0, -1), parts.shaded("ground", "ShaderNodeBsdfDiffuse", Color=(0.6, 0.6, 0.6, 1))[0]
    )
    ground.scale = (4, 4, 1)
    parts.world((0.1, 0.1, 0.15))
    parts.light("lamp", "POINT", (1.5, -1.5, 3), energy=300, **SPHERE)


def _box(*nodes: tuple[str, dict[str, Any]]) -> Any:
    """A box filled with the sum of these volume shaders, which stands on the ground."""
    material, tree = parts.material("fog")
    total = None
    for kind, inputs in nodes:
        node = tree.nodes.new(f"ShaderNode{kind}")
        for key, value in inputs.items():
            node.inputs[key.replace("_", " ")].default_value = value
        if total:
            add = tree.nodes.new("ShaderNodeAddShader")
            tree.links.new(total.outputs[0], add.inputs[0])
            tree.links.new(node.outputs[0], add.inputs[1])
            node = add
        total = node
    tree.links.new(total.outputs[0], tree.nodes["Material Output"].inputs["Volume"])
    bpy.ops.mesh.primitive_cube_add(size=1.9, location=(0, 0, 0))
    bpy.context.object.rotation_euler = (0, 0, 0.5)
    bpy.context.object.data.materials.append(material)
    return material


def _scatter(scratch: Path) -> Any:
    _scene()
    return _box(("VolumeScatter", {"Color": COLOR, "Density": 0.8, "Anisotropy": 0.6}))


def _absorption(scratch: Path) -> Any:
    _scene()
    return _box(("VolumeAbsorption", {"Color": COLOR, "Density": 1.5}))


def _principled(scratch: Path) -> Any:
    _scene()
    inputs = {"Color": COLOR, "Density": 1.0, "Absorption_Color": (0.3, 0.4, 0.8, 1), "Anisotropy": -0.3}
    glow = {"Emission_Strength": 0.05, "Blackbody_Intensity": 0.5, "Temperature": 1200.0}
    return _box(("VolumePrincipled", inputs | glow))


def _two_lobes(scratch: Path) -> Any:
    """Before Blender 4.3 Cycles adds the phase functions of several lobes, and so light."""
    if bpy.app.version < (4, 3):
        return None
    _scene()
    forward = {"Color": COLOR, "Density": 0.5, "Anisotropy": 0.7}  # of two colors Cycles mixes the directions
    backward = {"Color": COLOR, "Density": 0.7, "Anisotropy": -0.5}
    emission = {"Color": (0.1, 0.5, 0.1, 1), "Strength": 0.1}
    return _box(("VolumeScatter", forward), ("VolumeScatter", backward), ("Emission", emission))


def _world_fog(scratch: Path) -> Any:
    _scene()
    tree = bpy.context.scene.world.node_tree
    node = tree.nodes.new("ShaderNodeVolumeScatter")
    node.inputs["Color"].default_value, node.inputs["Density"].default_value = COLOR, 0.08
    output = next(each for each in tree.nodes if each.type == "OUTPUT_WORLD")
    return tree.links.new(node.outputs[0], output.inputs["Volume"])


def _noise(scratch: Path) -> Any:
    """Noise through a ramp, as fog and as a glow, in the sum of two shaders."""
    _scene()
    material = _box(
        ("VolumePrincipled", {"Color": COLOR, "Anisotropy": 0.4}), ("Emission", {"Color": (0.1, 0.3, 0.2, 1)})
    )
    tree = material.node_tree
    texture, ramp = (tree.nodes.new(f"ShaderNode{kind}") for kind in ("TexNoise", "ValToRGB"))
    texture.inputs["Scale"].default_value, texture.inputs["Detail"].default_value = 3, 1
    for stop, (place, value) in zip(ramp.color_ramp.elements, ((0.4, 0), (0.7, 5)), strict=True):
        stop.position, stop.color = place, (value, value, value, 1)
    tree.links.new(texture.outputs[0], ramp.inputs[0])
    tree.links.new(ramp.outputs[0], tree.nodes["Principled Volume"].inputs["Density"])
    return tree.links.new(texture.outputs[0], tree.nodes["Emission"].inputs["Strength"])


def _room(scratch: Path) -> Any:
    """Mist on the ground of a box with all in it, the camera too, thinner with height."""
    _scene()
    material = _box(("VolumeScatter", {"Color": (0.9, 0.8, 0.7, 1)}))
    room, tree = bpy.context.object, material.node_tree
    room.scale, room.location = (8, 10, 5), (0, 0, 3)
    coordinates, height, fall = (
        tree.nodes.new(f"ShaderNode{kind}") for kind in ("TexCoord", "SeparateXYZ", "MapRange")
    )
    for name, value in (("From Min", -0.45), ("From Max", 0.3), ("To Min", 0.1), ("To Max", 0)):
        fall.inputs[name].default_value = value
    tree.links.new(coordinates.outputs["Object"], height.inputs[0])
    tree.links.new(height.outputs["Z"], fall.inputs[0])
    return tree.links.new(fall.outputs[0], tree.nodes["Volume Scatter"].inputs["Density"])


def _cloud(scratch: Path) -> Any:
    """An OpenVDB file of few voxels, where this Blender's Python writes and reads them."""
    vdb = sys.modules["pivot.export.vdb"].openvdb_module()
    if vdb is None:
        return None
    _scene()
    grid = vdb.FloatGrid()
    grid.name, grid.transform = "density", vdb.createLinearTransform(voxelSize=0.4)
    grid.copyFromArray(np.random.default_rng(1).random((5, 4, 4), np.float32), ijk=(-2, -2, -2))
    path = Path(tempfile.mkdtemp(dir=scratch.parent)) / "cloud.vdb"
    vdb.write(str(path), grids=[grid])
    data = bpy.data.volumes.new("cloud")
    data.filepath, data.render.step_size = str(path), 0.1
    material, tree = parts.material("cloud")
    node = tree.nodes.new("ShaderNodeVolumePrincipled")
    node.inputs["Color"].default_value, node.inputs["Density"].default_value = COLOR, 2
    tree.links.new(node.outputs[0], tree.nodes["Material Output"].inputs["Volume"])
    data.materials.append(material)
    cloud = parts.link("cloud", data)
    cloud.scale = (1.1, 1.1, 1.1)
    return cloud


def _smoke(scratch: Path) -> Any:
    """A domain, where this Blender can simulate it."""
    if "blender" not in Path(bpy.app.binary_path).name:
        return None
    domain = smoke_cases.smoke_domain(str(scratch))
    scene = bpy.context.scene
    for frame in range(1, smoke_cases.FRAMES + 1):
        scene.frame_set(frame)
    domain.data.materials.append(smoke_cases.principled("smoke", Color=COLOR, Density=3))
    parts.size(SIZE, SIZE)
    scene.camera.location = (1, 0, 12)
    parts.quad("ground", (0, 0, -3.1)).scale = (4, 4, 1)
    parts.world((0.1, 0.1, 0.15))
    parts.light("lamp", "POINT", (4, -3, 5), energy=2000, **SPHERE)
    return domain


SCENES: tuple[tuple[Callable[[Path], Any], int], ...] = (
    (_scatter, 0),
    (_scatter, 3),
    (_absorption, 0),
    (_principled, 2),
    (_two_lobes, 1),
    (_world_fog, 0),
    (_noise, 1),
    (_room, 0),
    (_cloud, 0),
    (_smoke, 0),
)


def _render(path: Path, engine: str, bounces: int) -> None:
    scene = bpy.context.scene
    scene.pivot.max_bounces = bounces
    cycles = scene.cycles
    for limit in ("max", "diffuse", "glossy", "volume"):
        setattr(cycles, f"{limit}_bounces", bounces)
    cycles.sample_clamp_indirect, cycles.blur_glossy, cycles.volume_step_rate = 0, 0, 0.2
    if hasattr(cycles, "volume_biased"):  # from Blender 5.0
        cycles.volume_biased = False
    parts.render_steady(path, engine, SAMPLES[engine], filter_px=1.0)
