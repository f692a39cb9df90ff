"""Inside Blender as a module: a scene of monte_carlo_scenes.py, or the default one, by Cycles or Pivot.

monte_carlo_blender.py < JOBS: does the jobs (see monte_carlo_worker.py).
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import partial
from typing import Any

import bpy

# isort: split
import indirect_scenes
import mathutils
import monte_carlo_renderers as renderers
import monte_carlo_scenes as scenes
import monte_carlo_worker as worker
import numpy as np
from numpy.typing import NDArray


def build(scene: scenes.Scene) -> None:
    bpy.ops.wm.read_factory_settings(use_empty=True)
    meshes = {"SPHERE": _sphere(), "PLANE": _plane()}
    for index, shape in enumerate(scene.shapes):
        mesh = meshes[shape.kind].copy()
        mesh.materials.append(_material(shape.material))
        _link(bpy.data.objects.new(f"{shape.kind} {index}", mesh), shape.world_from_object())
    for light in scene.lights:
        _link(_light(light), scenes.look_at(light.location, light.target))
    camera = bpy.data.cameras.new("camera")
    camera.angle = 2 * math.atan(scene.half_width)
    bpy.context.scene.camera = _link(bpy.data.objects.new("camera", camera), scenes.look_at(scene.eye, scene.target))
    bpy.context.scene.render.resolution_x = scenes.WIDTH
    bpy.context.scene.render.resolution_y = scenes.HEIGHT


def _link(blender_object: bpy.types.Object, world_from_object: NDArray[np.float64]) -> bpy.types.Object:
    blender_object.matrix_world = mathutils.Matrix(world_from_object.tolist())
    bpy.context.scene.collection.objects.link(blender_object)
    return blender_object


def _sphere() -> bpy.types.Mesh:
    vertices, triangles = scenes.sphere_mesh()
    mesh = bpy.data.meshes.new("sphere")
    mesh.from_pydata(vertices.tolist(), [], triangles.tolist())
    mesh.polygons.foreach_set("use_smooth", [True] * len(mesh.polygons))
    return mesh


def _plane() -> bpy.types.Mesh:
    mesh = bpy.data.meshes.new("plane")
    mesh.from_pydata([(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)], [], [(0, 1, 2, 3)])
    return mesh


def _material(material: scenes.Material) -> bpy.types.Material:
    blender_material = bpy.data.materials.new(material.kind)
    blender_material.use_nodes = True
    tree = blender_material.node_tree
    tree.nodes.clear()
    kind = {"DIFFUSE": "BsdfDiffuse", "GLOSSY": "BsdfGlossy", "PLASTIC": "BsdfPrincipled"}[material.kind]
    node: Any = tree.nodes.new(f"ShaderNode{kind}")
    node.inputs[0].default_value = (*material.color, 1)
    if material.kind != "DIFFUSE":
        node.inputs["Roughness"].default_value = material.roughness
        node.distribution = "GGX"
    tree.links.new(node.outputs[0], tree.nodes.new("ShaderNodeOutputMaterial").inputs[0])
    return blender_material


def _light(light: scenes.LightSource) -> bpy.types.Object:
    area = light.kind in {"RECTANGLE", "ELLIPSE"}
    data: Any = bpy.data.lights.new(light.kind, "AREA" if area else light.kind)
    data.energy = light.power_w
    data.color = light.color
    if area:
        data.shape = light.kind
        data.size, data.size_y = light.size_m
    else:
        data.shadow_soft_size = light.size_m[0]
        data.use_soft_falloff = False
    if light.kind == "SPOT":
        data.spot_size, data.spot_blend = light.cone_rad, 0.5
    return bpy.data.objects.new(light.kind, data)


if __name__ == "__main__":
    builders: dict[str, Callable[[], None]] = {name: partial(build, scene) for name, scene in scenes.SCENES.items()}
    builders["default"] = indirect_scenes.SCENES["default"]
    worker.main({"cycles": renderers.Cycles, "pivot": renderers.Pivot}, builders)
