"""What Cycles needs on virtual_lights_scenes.py: CPU seconds a sample, and relMSE times samples; one bounce.

The error is against a reference of its own.

The scenes' functions are run with recorders in the place of pivot_core, and what they recorded is built in Blender.
"""

from __future__ import annotations

import sys
import tempfile
import time
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import bpy
import numpy as np
import virtual_lights_scenes as own
from mathutils import Matrix
from virtual_lights_measure import relmse


class Recorder:
    """Stands for pivot_core.Scene."""

    def __init__(self) -> None:
        self.materials: list[dict[str, Any]] = []
        self.meshes: list[SimpleNamespace] = []
        self.instances: list[tuple[int, Any, int]] = []
        self.lights: list[SimpleNamespace] = []

    def add_material(self, name: str, material: dict[str, Any]) -> int:
        self.materials.append(material)
        return len(self.materials) - 1

    def add_mesh(self, name: str, positions: Any, corners: Any, triangles: Any, corner_normals: Any = None) -> int:
        faces = np.asarray(corners)[np.asarray(triangles)]
        self.meshes.append(SimpleNamespace(positions=positions, faces=faces, smooth=corner_normals is not None))
        return len(self.meshes) - 1

    def add_instances(self, name: str, mesh: int, matrices: Any, materials: list[int]) -> None:
        self.instances.append((mesh, matrices[0], materials[0]))

    def add_light(self, name: str, light: SimpleNamespace) -> None:
        self.lights.append(light)

    def set_camera(self, matrix: Any, plane: tuple[float, ...], width: int, height: int) -> None:
        self.camera = SimpleNamespace(matrix=matrix, half_width=plane[1], width=width, height=height)


def record(name: str) -> Recorder:
    own.pivot_core = SimpleNamespace(  # type: ignore[assignment]
        Scene=Recorder,
        Material=dict,
        SphereLight=lambda *a: SimpleNamespace(kind="POINT", place=a[0], radius=a[1], intensity=a[2]),
        SpotLight=lambda *a: SimpleNamespace(
            kind="SPOT", place=a[0], radius=a[1], intensity=a[2], direction=a[3], cosine=a[4], blend=a[5]
        ),
        AreaLight=lambda *a: SimpleNamespace(kind="AREA", place=a[0], u=a[1], v=a[2], radiance=a[3]),
    )
    return own.SCENES[name](0.0, 0.0)  # type: ignore[return-value]


def make_material(numbers: dict[str, Any]) -> bpy.types.Material:
    material = bpy.data.materials.new("m")
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    output = tree.nodes.new("ShaderNodeOutputMaterial")
    roughness = numbers.get("alpha", 0.25) ** 0.5
    if "conductor_f0" in numbers:
        node = tree.nodes.new("ShaderNodeBsdfAnisotropic")
        node.distribution = "MULTI_GGX"
        node.inputs["Color"].default_value = (*numbers["conductor_f0"], 1)
        node.inputs["Roughness"].default_value = roughness
    elif "dielectric_weight" in numbers:
        node = tree.nodes.new("ShaderNodeBsdfPrincipled")
        node.inputs["Base Color"].default_value = (*numbers["diffuse"], 1)
        node.inputs["Roughness"].default_value = roughness
    else:
        node = tree.nodes.new("ShaderNodeBsdfDiffuse")
        node.inputs["Color"].default_value = (*numbers["diffuse"], 1)
    tree.links.new(node.outputs[0], output.inputs["Surface"])
    return material


def aim(z: Any) -> Matrix:
    return Matrix(own.parts.look_at((0, 0, 0), tuple(-np.asarray(z, float))).tolist())


def make_light(light: SimpleNamespace) -> None:
    data: Any = bpy.data.lights.new("lamp", light.kind)
    lamp = bpy.data.objects.new("lamp", data)
    bpy.context.collection.objects.link(lamp)
    if light.kind == "AREA":
        u, v = np.asarray(light.u), np.asarray(light.v)
        data.shape, data.size, data.size_y = "RECTANGLE", 2 * np.linalg.norm(u), 2 * np.linalg.norm(v)
        peak = max(light.radiance)
        data.energy, data.color = np.pi * data.size * data.size_y * peak, np.asarray(light.radiance) / peak
        x, y = u / np.linalg.norm(u), v / np.linalg.norm(v)
        matrix = np.eye(4)
        matrix[:3, :3] = np.stack([x, -y, -np.cross(x, y)], 1)
        lamp.matrix_world = Matrix.Translation(light.place) @ Matrix(matrix.tolist())
        return
    data.energy, data.shadow_soft_size = 4 * np.pi * light.intensity[0], light.radius
    lamp.matrix_world = Matrix.Translation(light.place)
    if light.kind == "SPOT":
        data.spot_size, data.spot_blend = 2 * np.arccos(light.cosine), light.blend
        lamp.matrix_world = lamp.matrix_world @ aim(light.direction)


def build(name: str) -> None:
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene, recorded = bpy.context.scene, record(name)
    materials = [make_material(numbers) for numbers in recorded.materials]
    for mesh, matrix, material in recorded.instances:
        of = recorded.meshes[mesh]
        data = bpy.data.meshes.new("mesh")
        data.from_pydata(of.positions.tolist(), [], of.faces.tolist())
        data.polygons.foreach_set("use_smooth", [of.smooth] * len(data.polygons))
        data.materials.append(materials[material])
        thing = bpy.data.objects.new("object", data)
        thing.matrix_world = Matrix(np.asarray(matrix).tolist())
        bpy.context.collection.objects.link(thing)
    for light in recorded.lights:
        make_light(light)
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.data.sensor_width, camera.data.lens = 36.0, 18.0 / recorded.camera.half_width
    camera.matrix_world = Matrix(recorded.camera.matrix.tolist())
    bpy.context.collection.objects.link(camera)
    scene.camera = camera
    scene.render.engine = "CYCLES"
    scene.render.resolution_x, scene.render.resolution_y = recorded.camera.width, recorded.camera.height
    cycles: Any = scene.cycles
    cycles.use_adaptive_sampling = cycles.use_denoising = False
    cycles.sample_clamp_indirect = cycles.blur_glossy = 0.0
    cycles.filter_width = 0.75  # Pivot's 1.5 pixels
    cycles.max_bounces = cycles.diffuse_bounces = cycles.glossy_bounces = 1
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_depth = "32"


def render(samples: int, seed: int) -> tuple[Any, float]:
    """The picture, and CPU seconds."""
    scene: Any = bpy.context.scene
    scene.cycles.samples, scene.cycles.seed = samples, seed
    with tempfile.TemporaryDirectory() as folder:
        scene.render.filepath = str(Path(folder) / "picture.exr")
        began = time.process_time()
        bpy.ops.render.render(write_still=True)
        cpu_s = time.process_time() - began
        image = bpy.data.images.load(scene.render.filepath)
        pixels = np.empty(len(image.pixels), np.float32)
        image.pixels.foreach_get(pixels)
        bpy.data.images.remove(image)
    return pixels.reshape(scene.render.resolution_y, scene.render.resolution_x, 4)[..., :3], cpu_s


def main() -> None:
    for name in sys.argv[1:] or own.SCENES:
        build(name)
        reference, _ = render(2048, 1)
        _, low_s = render(8, 2)
        high, high_s = render(72, 2)
        print(f"{name} {(high_s - low_s) / 64:.5f} {relmse(high, reference) * 72:.5f}", flush=True)


if __name__ == "__main__":
    main()
