"""Objects left in Edit Mode as exported, beside the same scene left in Object Mode."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import bpy
import parts
from geometry_cases import cubes_on_points, reading_uvs
from recording import record

NORMALS = ("corner_normals", "vertex_normals")
ARRAYS = ("positions", "corner_vertices", "triangle_corners", *NORMALS, "triangle_slots")


def main(folder: Path) -> Any:
    scenes = {name: {mode: _shown(make, mode) for mode in ("OBJECT", "EDIT")} for name, make in SCENES.items()}
    return {"scenes": scenes, "edits": _edits()} | _saved(folder)


def _shown(make: Any, mode: str) -> Any:
    """What is exported of a scene whose chosen objects are in the mode: by object its place and every array."""
    parts.clear()
    parts.camera()
    _enter(make(), mode)
    recording = record()
    objects = {}
    for group in recording.instances:
        mesh = recording.meshes[group.mesh]
        arrays = {name: None if getattr(mesh, name) is None else getattr(mesh, name).tolist() for name in ARRAYS}
        places = group.object_to_world[:, :3, 3].tolist()
        uvs = {name: values.tolist() for name, values in mesh.corner_attributes.items()}
        objects[group.name] = {"places": places, "materials": group.materials, "uvs": uvs} | arrays
    return {"objects": objects, "reports": recording.reports}


def _enter(objects: list[Any], mode: str) -> None:
    bpy.context.view_layer.update()
    for made in bpy.context.view_layer.objects:
        made.select_set(made in objects)
    bpy.context.view_layer.objects.active = objects[0]
    assert bpy.ops.object.mode_set(mode=mode) == {"FINISHED"}
    assert all(made.mode == mode for made in objects), [(made.name, made.mode) for made in objects]


def _detailed(name: str, location: Any = (0, 0, 0)) -> Any:
    """Two quads of two material slots, with UVs and custom normals."""
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(
        [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (2, 0, 0), (2, 1, 0)], [], [(0, 1, 2, 3), (1, 4, 5, 2)]
    )
    layer = mesh.uv_layers.new(name="map")
    for corner, data in enumerate(layer.data):
        data.uv = (corner / 8, 0.5)
    for suffix in "ab":
        mesh.materials.append(reading_uvs(f"{name} {suffix}"))
    mesh.polygons[1].material_index = 1
    if bpy.app.version < (4, 1):
        mesh.use_auto_smooth = True
    mesh.normals_split_custom_set([(0, 0.6, 0.8)] * 8)
    return parts.link(name, mesh, location)


def _mesh() -> list[Any]:
    return [_detailed("mesh")]


def _modified() -> list[Any]:
    """With a modifier that is shown in Edit Mode."""
    made = _detailed("modified")
    modifier = made.modifiers.new("double", "ARRAY")
    modifier.use_relative_offset, modifier.use_constant_offset = False, True
    modifier.constant_offset_displace = (10, 0, 0)
    return [made]


def _several() -> list[Any]:
    """Several at once, one of them not active, and one of shared data that is not itself in Edit Mode."""
    first, second = _detailed("first"), _detailed("second", (0, 3, 0))
    parts.link("sharing", first.data, (0, 6, 0))
    parts.quad("bystander", (0, 9, 0))
    return [first, second]


def _instanced() -> list[Any]:
    """In a collection that is instanced, on vertices by particles, and by geometry nodes."""
    made = _detailed("instanced")
    collection = bpy.data.collections.new("collection")
    collection.objects.link(made)
    empty = parts.link("empty", None, (20, 0, 0))
    empty.instance_type, empty.instance_collection = "COLLECTION", collection
    emitter = parts.quad("emitter")
    emitter.modifiers.new("particles", "PARTICLE_SYSTEM")
    settings = emitter.particle_systems[0].settings
    settings.count, settings.frame_start, settings.frame_end, settings.lifetime = 5, 1, 1, 100
    settings.render_type, settings.instance_object = "OBJECT", made
    points = parts.quad("points")
    points.modifiers.new("nodes", "NODES").node_group = objects_on_points(made)
    return [made]


def _emitters() -> list[Any]:
    """What instances others is in Edit Mode itself; Blender has no particles there, Cycles neither."""
    points, emitter = parts.quad("points"), parts.quad("emitter")
    points.modifiers.new("nodes", "NODES").node_group = objects_on_points(_detailed("scattered"))
    emitter.modifiers.new("particles", "PARTICLE_SYSTEM")
    return [emitter, points]


def objects_on_points(instanced: Any) -> Any:
    """Geometry nodes: the object on each vertex."""
    tree = cubes_on_points(None)
    info = tree.nodes.new("GeometryNodeObjectInfo")
    info.inputs["Object"].default_value = instanced
    info.inputs["As Instance"].default_value = True
    instance = next(node for node in tree.nodes if node.bl_idname == "GeometryNodeInstanceOnPoints")
    tree.links.new(info.outputs["Geometry"], instance.inputs["Instance"])
    return tree


def _emissive() -> list[Any]:
    return [parts.quad("emissive", material=parts.shaded("glow", "ShaderNodeEmission", Strength=3.0)[0])]


def _armature_deformed() -> list[Any]:
    """The mesh, whose armature raises it, in Edit Mode."""
    armature = parts.link("armature", bpy.data.armatures.new("armature"))
    _enter([armature], "EDIT")
    bone = armature.data.edit_bones.new("bone")
    bone.head, bone.tail = (0, 0, 0), (0, 0, 1)
    bpy.ops.object.mode_set(mode="OBJECT")
    armature.pose.bones["bone"].location = (0, 2, 0)
    made = _detailed("deformed")
    made.vertex_groups.new(name="bone").add(range(6), 1.0, "REPLACE")
    modifier = made.modifiers.new("armature", "ARMATURE")
    modifier.object = armature
    modifier.show_in_editmode = modifier.show_on_cage = True
    return [made]


def _curve() -> list[Any]:
    bpy.ops.curve.primitive_bezier_circle_add()
    bpy.context.object.name = "curve"
    bpy.context.object.data.bevel_depth = 0.1
    return [bpy.context.object]


def _text() -> list[Any]:
    data = bpy.data.curves.new("text", "FONT")
    data.body = "Pivot"
    return [parts.link("text", data)]


def _surface() -> list[Any]:
    bpy.ops.surface.primitive_nurbs_surface_sphere_add()
    bpy.context.object.name = "surface"
    return [bpy.context.object]


def _metaball() -> list[Any]:
    data = bpy.data.metaballs.new("ball")
    data.elements.new()
    return [parts.link("ball", data)]


SCENES = {
    make.__name__.lstrip("_"): make
    for make in (
        _mesh,
        _modified,
        _several,
        _instanced,
        _emitters,
        _emissive,
        _armature_deformed,
        _curve,
        _text,
        _surface,
        _metaball,
    )
}


def _edits() -> Any:
    """The x of the vertices of a quad whose edit, a move by 5, has not left Edit Mode."""
    parts.clear()
    parts.camera()
    made = parts.quad("edited")
    _enter([made], "EDIT")
    bpy.ops.mesh.select_all(action="SELECT")
    bpy.ops.transform.translate(value=(5, 0, 0))
    return record().meshes[0].positions[:, 0].tolist()


def _saved(folder: Path) -> Any:
    """The triangles of a file that was saved in Edit Mode and read again."""
    parts.clear()
    parts.camera()
    parts.light("lamp", "POINT", (0, 0, 2), energy=100)
    _enter([_detailed("mesh")], "EDIT")
    path = str(folder / "edit.blend")
    bpy.context.scene.render.engine = "PIVOT"
    bpy.ops.wm.save_as_mainfile(filepath=path)
    bpy.ops.wm.open_mainfile(filepath=path)
    assert bpy.data.objects["mesh"].mode == "EDIT"
    return {"read_again": [len(mesh.triangle_corners) for mesh in record().meshes]}
