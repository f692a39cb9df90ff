"""Inside a Python with Mitsuba 3 and Blender as a module: the scenes of indirect_plain.py by Mitsuba.

indirect_mitsuba.py < JOBS: does the jobs (see monte_carlo_worker.py).
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import bpy

# isort: split
import indirect_plain
import mitsuba_parts as parts
import monte_carlo_worker as worker
import numpy as np
from numpy.typing import NDArray

Corners = tuple[NDArray[np.float64], NDArray[np.float64]]  # of triangles: positions and normals, in world space


def _read(collection: Any, name: str, shape: tuple[int, ...], kind: Any) -> NDArray[Any]:
    array = np.empty(shape, kind)
    collection.foreach_get(name, array.ravel())
    return array


def _corners(mesh: bpy.types.Mesh, world_from_object: NDArray[np.float64], slot: int) -> Corners:
    """Of the triangles with the slot's material."""
    mesh.calc_loop_triangles()
    count = len(mesh.loop_triangles)
    loops = _read(mesh.loop_triangles, "loops", (count, 3), np.int32)
    loops = loops[_read(mesh.loop_triangles, "material_index", (count,), np.int32) == slot].ravel()
    vertices = _read(mesh.loops, "vertex_index", (len(mesh.loops),), np.int32)[loops]
    positions = _read(mesh.vertices, "co", (len(mesh.vertices), 3), np.float32)[vertices]
    normals = _read(mesh.corner_normals, "vector", (len(mesh.loops), 3), np.float32)[loops]
    linear = world_from_object[:3, :3]
    return positions @ linear.T + world_from_object[:3, 3], normals @ np.linalg.inv(linear)


def _light(data: Any, place: NDArray[np.float64]) -> parts.Description:
    color, power = tuple(data.color), data.energy
    if data.type == "POINT":
        return parts.sphere_light(tuple(place[:3, 3]), data.shadow_soft_size, power, color)
    if data.type == "SUN":
        return parts.sun_light(place, data.angle, power, color)
    if data.type == "AREA":
        size_y = data.size_y if data.shape in {"RECTANGLE", "ELLIPSE"} else data.size
        return parts.area_light(place, (data.size, size_y), data.shape in {"DISK", "ELLIPSE"}, power, color)
    raise ValueError(f"light '{data.name}': Mitsuba's scenes have no light of type {data.type}")


def _shader(material: bpy.types.Material) -> Any:
    """The only node beside the output."""
    return next(node for node in material.node_tree.nodes if node.type != "OUTPUT_MATERIAL")


def _mesh(material: bpy.types.Material, corners: list[Corners]) -> Any:
    """All that has the material."""
    positions, normals = (np.concatenate(arrays) for arrays in zip(*corners, strict=True))
    triangles = np.arange(len(positions), dtype=np.int32).reshape(-1, 3)
    node = _shader(material)
    color = tuple(node.inputs["Color"].default_value)[:3]
    match node.type:
        case "EMISSION":  # to the outside alone: what shines is closed
            radiance = tuple(node.inputs["Strength"].default_value * c for c in color)
            surface = {"bsdf": parts.diffuse((0.0, 0.0, 0.0)), "emitter": parts.emission(radiance)}
        case "BSDF_GLOSSY":
            surface = {"bsdf": parts.two_sided(parts.glossy(color, node.inputs["Roughness"].default_value))}
        case "BSDF_DIFFUSE":
            surface = {"bsdf": parts.two_sided(parts.diffuse(color))}
        case other:
            raise ValueError(f"material '{material.name}': Mitsuba's scenes have no {other}")
    return parts.mesh(material.name, positions, normals, triangles, **surface)


def _world() -> parts.Description | None:
    inputs = bpy.context.scene.world.node_tree.nodes["Background"].inputs
    radiance = tuple(inputs["Strength"].default_value * c for c in inputs["Color"].default_value[:3])
    return {"type": "constant", "radiance": parts.rgb(radiance)} if any(radiance) else None


def make(build: Callable[[], None], settings: dict[str, Any]) -> parts.Mitsuba:
    """settings: max_bounces."""
    build()
    corners: dict[str, list[Corners]] = {}
    lamps: parts.Description = {}
    for instance in bpy.context.evaluated_depsgraph_get().object_instances:
        seen, place = instance.object, np.array(instance.matrix_world)
        if seen.type == "LIGHT":
            lamps[f"lamp{len(lamps)}"] = _light(seen.data, place)
        elif seen.type == "MESH" and instance.show_self:
            for slot, material in enumerate(seen.data.materials):
                corners.setdefault(material.name, []).append(_corners(seen.data, place, slot))
    things = {f"mesh{i}": _mesh(bpy.data.materials[name], of) for i, (name, of) in enumerate(corners.items())}
    world = _world()
    if world:
        lamps["world"] = world
    shines = any(_shader(bpy.data.materials[name]).type == "EMISSION" for name in corners)
    if shines and lamps:
        raise ValueError("Mitsuba hides lamps and the world from the camera, or shows meshes that shine: not both")
    render, camera = bpy.context.scene.render, bpy.context.scene.camera
    half_width = math.tan(camera.data.angle / 2)
    sensor = parts.camera(np.array(camera.matrix_world), half_width, render.resolution_x, render.resolution_y)
    return parts.Mitsuba(things | lamps, sensor, settings["max_bounces"], hide_emitters=not shines)


if __name__ == "__main__":
    worker.main({"mitsuba": make}, indirect_plain.SCENES)
