"""Meshes and instances as exported."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import bpy
import numpy as np
import parts
from recording import Recording, record

PRISM = (  # two squares that meet at a right angle along the y axis
    [(-1, -1, 0), (0, -1, 0), (0, 1, 0), (-1, 1, 0), (0, -1, -1), (0, 1, -1)],
    [(0, 1, 2, 3), (1, 4, 5, 2)],
)


def main(folder: Path) -> Any:
    return {
        "arrays": _arrays(),
        "normals": {name: _normals(name) for name in ("flat", "smooth", "sharp", "custom")},
        "instances": _instances(),
        "shapes": _shapes(),
        "empty": _empty(),
    }


def _mesh(name: str, geometry: Any = PRISM) -> Any:
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(geometry[0], [], geometry[1])
    return mesh


def _arrays() -> Any:
    """A mesh of a quad and a triangle with two UV maps and two material slots, its x doubled by a modifier."""
    parts.clear()
    parts.camera()
    mesh = _mesh("odd", ([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (2, 0, 0)], [(0, 1, 2, 3), (1, 4, 2)]))
    for name in ("first", "second"):
        layer = mesh.uv_layers.new(name=name)
        for corner, data in enumerate(layer.data):
            data.uv = (corner / 8, 1.0 if name == "second" else 0.0)
    mesh.uv_layers["second"].active_render = True
    mesh.polygons[1].material_index = 1
    mesh.materials.append(reading_uvs("a"))
    mesh.materials.append(parts.shaded("b", "ShaderNodeBsdfDiffuse")[0])
    odd = parts.link("odd", mesh)
    modifier = odd.modifiers.new("double", "ARRAY")
    modifier.use_relative_offset, modifier.use_constant_offset = False, True
    modifier.constant_offset_displace = (10, 0, 0)
    recording = record()
    exported = recording.meshes[0]
    return {
        "positions": exported.positions.tolist(),
        "corner_vertices": exported.corner_vertices.tolist(),
        "triangle_corners": exported.triangle_corners.tolist(),
        "corner_uvs": exported.corner_attributes["uv:"].tolist(),
        "triangle_slots": exported.triangle_slots.tolist(),
        "materials": recording.instances[0].materials,
    }


def reading_uvs(name: str) -> Any:
    """A material that reads the UV map that is active for rendering."""
    material, diffuse = parts.shaded(name, "ShaderNodeBsdfDiffuse")
    tree = diffuse.id_data
    tree.links.new(tree.nodes.new("ShaderNodeUVMap").outputs[0], diffuse.inputs["Color"])
    return material


def _normals(kind: str) -> Any:
    """(8, 3) normals at the prism's corners, those of the first face first. None: flat shading."""
    parts.clear()
    parts.camera()
    mesh = _mesh(kind)
    mesh.polygons.foreach_set("use_smooth", [kind != "flat"] * 2)
    if kind == "sharp":
        if bpy.app.version < (4, 1):
            mesh.use_auto_smooth, mesh.auto_smooth_angle = True, math.radians(30)
        else:
            mesh.set_sharp_from_angle(angle=math.radians(30))
    if kind == "custom":
        if bpy.app.version < (4, 1):
            mesh.use_auto_smooth = True
        mesh.normals_split_custom_set([(0, 0.6, 0.8)] * 8)
    parts.link(kind, mesh)
    exported = record().meshes[0]
    if exported.corner_normals is not None:
        return exported.corner_normals.tolist()
    if exported.vertex_normals is not None:
        return exported.vertex_normals[exported.corner_vertices].tolist()
    return None


def _instances() -> Any:
    parts.clear()
    parts.camera()
    red, green = (parts.shaded(name, "ShaderNodeBsdfDiffuse")[0] for name in ("red", "green"))
    shared = parts.quad("shared", (1, 0, 0), red)
    linked = parts.link("object_linked", shared.data, (2, 0, 0))
    linked.material_slots[0].link, linked.material_slots[0].material = "OBJECT", green
    parts.link("unseen", shared.data, (3, 0, 0)).visible_camera = False
    parts.link("hidden", shared.data).hide_render = True
    parts.link("hidden_in_viewport", shared.data, (4, 0, 0)).hide_viewport = True
    parts.link("flattened", shared.data).scale = (1, 1, 0)
    parts.link("without_material", _mesh("bare"))

    collection = bpy.data.collections.new("collection")
    collection.objects.link(bpy.data.objects.new("in_collection", shared.data))
    for x in (10, 20, 30):
        empty = parts.link(f"empty{x}", None, (x, 0, 0))
        empty.instance_type, empty.instance_collection = "COLLECTION", collection

    emitter = parts.quad("emitter")
    emitter.modifiers.new("particles", "PARTICLE_SYSTEM")
    settings = emitter.particle_systems[0].settings
    settings.count, settings.frame_start, settings.frame_end, settings.lifetime = 40, 1, 1, 100
    settings.render_type, settings.instance_object = "OBJECT", shared
    emitter.show_instancer_for_render = False

    scatter = parts.quad("scatter")
    scatter.modifiers.new("nodes", "NODES").node_group = cubes_on_points(green)
    return summary(record())


def cubes_on_points(material: Any) -> Any:
    """Geometry nodes: a cube of the material on each vertex."""
    tree = bpy.data.node_groups.new("cubes", "GeometryNodeTree")
    if bpy.app.version >= (4, 0):
        for direction in ("INPUT", "OUTPUT"):
            tree.interface.new_socket("Geometry", in_out=direction, socket_type="NodeSocketGeometry")
    else:
        tree.inputs.new("NodeSocketGeometry", "Geometry")
        tree.outputs.new("NodeSocketGeometry", "Geometry")
    kinds = ("NodeGroupInput", "GeometryNodeInstanceOnPoints", "NodeGroupOutput")
    start, instance, end = (tree.nodes.new(kind) for kind in kinds)
    cube, paint = (tree.nodes.new(kind) for kind in ("GeometryNodeMeshCube", "GeometryNodeSetMaterial"))
    paint.inputs["Material"].default_value = material
    tree.links.new(start.outputs[0], instance.inputs["Points"])
    tree.links.new(cube.outputs["Mesh"], paint.inputs["Geometry"])
    tree.links.new(paint.outputs[0], instance.inputs["Instance"])
    tree.links.new(instance.outputs[0], end.inputs[0])
    return tree


def _shapes() -> Any:
    """Curves, text, a surface and a family of two metaballs: each is there once."""
    parts.clear()
    parts.camera()
    bpy.ops.curve.primitive_bezier_circle_add()
    bpy.context.object.name = "curve"
    bpy.context.object.data.bevel_depth = 0.1
    text = bpy.data.curves.new("text", "FONT")
    text.body = "Pivot"
    text.materials.append(parts.shaded("ink", "ShaderNodeBsdfDiffuse")[0])
    parts.link("text", text)
    bpy.ops.surface.primitive_nurbs_surface_sphere_add()
    bpy.context.object.name = "surface"
    for name in ("ball", "ball.001"):
        ball = bpy.data.metaballs.new(name)
        ball.elements.new()
        parts.link(name, ball)
    return summary(record())


def _empty() -> Any:
    """Meshes without triangles and objects without a mesh are no fault."""
    parts.clear()
    parts.camera()
    parts.link("points", _mesh("points", ([(0, 0, 0), (1, 0, 0)], [])))
    parts.link("none", _mesh("none", ([], [])))
    parts.link("empty")
    parts.link("armature", bpy.data.armatures.new("armature"))
    recording = record()
    return {"meshes": len(recording.meshes), "reports": recording.reports}


def summary(recording: Recording) -> Any:
    return {
        "meshes": len(recording.meshes),
        "reports": recording.reports,
        "instances": [
            {
                "name": group.name,
                "mesh": group.mesh,
                "triangles": len(recording.meshes[group.mesh].triangle_corners),
                "materials": group.materials,
                "hidden_from": group.hidden_from,
                "translations": np.array(group.object_to_world)[:, :3, 3].tolist(),
            }
            for group in recording.instances
        ],
    }
