"""What shaders read of meshes and objects, by the names that the nodes' rows ask for.

A name is a kind and a name within it, "uv:UVMap", or a kind alone, "generated:".
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import bpy
import numpy as np
from numpy.typing import NDArray

from .islands import random_of_islands
from .mesh import MeshArrays, corner_normals
from .pointiness import pointiness
from .tangents import corner_tangents

Array = NDArray[np.float32]

UV_OF_PASS = "uv:"  # what the pass shows: the map that is active for rendering

# By the data type of Blender's attributes: the property of their elements, and how many numbers it has.
VALUES = {
    "FLOAT": ("value", 1),
    "INT": ("value", 1),
    "INT8": ("value", 1),
    "BOOLEAN": ("value", 1),
    "FLOAT2": ("vector", 2),
    "FLOAT_VECTOR": ("vector", 3),
    "FLOAT_COLOR": ("color", 4),
    "BYTE_COLOR": ("color", 4),
    "QUATERNION": ("value", 4),
}


@dataclass(frozen=True)
class MeshAttributes:
    """V vertices, C face corners; arguments of pivot_core.Scene.add_mesh."""

    vertex_attributes: dict[str, Array] = field(default_factory=dict)  # (V, 1..4)
    corner_attributes: dict[str, Array] = field(default_factory=dict)  # (C, 1..4)


def is_of_mesh(name: str) -> bool:
    return name.partition(":")[0] in _OF_MESH


def mesh_attributes(mesh: bpy.types.Mesh, arrays: MeshArrays, names: frozenset[str]) -> MeshAttributes:
    """Those of the attributes that an evaluated mesh has. arrays: its own."""
    result = MeshAttributes()
    for name in sorted(names):
        kind, _, inner = name.partition(":")
        _OF_MESH[kind](mesh, arrays, inner, name, result)
    return result


def object_attributes(
    names: frozenset[str], blender_object: bpy.types.Object, instancer: Any, depsgraph: bpy.types.Depsgraph
) -> dict[str, tuple[float, ...]]:
    """Four numbers for each of the attributes that an object, its instancer or its view layer has."""
    layer, scene = depsgraph.view_layer, depsgraph.scene_eval
    owners = {
        "object": (blender_object, blender_object.data),
        "instancer": (instancer or blender_object, (instancer or blender_object).data),
        "layer": (layer, scene, scene.world),
    }
    result = {}
    for name in sorted(names):
        kind, _, inner = name.partition(":")
        values = (_property(owner, inner) for owner in owners.get(kind, ()) if owner is not None)
        value = next((value for value in values if value is not None), None)
        if value is not None:
            result[name] = value
    return result


def _property(owner: Any, name: str) -> tuple[float, ...] | None:
    """A custom property or one of Blender's as four numbers; None where it is not one to four numbers."""
    value = owner.get(name)
    if value is None:
        try:
            value = owner.path_resolve(name)
        except ValueError:
            return None
    if isinstance(value, bool | int | float):
        return (float(value),) * 3 + (1.0,)
    numbers = [number for number in value if isinstance(number, float)] if hasattr(value, "__len__") else []
    if not numbers or len(numbers) != len(value) or len(numbers) > 4:
        return None
    return tuple(numbers + [0.0, 0.0, 0.0, 1.0][len(numbers) :])


def _uv(mesh: bpy.types.Mesh, arrays: MeshArrays, inner: str, name: str, result: MeshAttributes) -> None:
    values = _uv_values(mesh, inner)
    if values is not None:
        result.corner_attributes[name] = values


def _uv_values(mesh: bpy.types.Mesh, inner: str) -> Array | None:
    """inner: a UV map's name; none: the one that is active for rendering."""
    layers = mesh.uv_layers
    layer = layers.get(inner) if inner else next((layer for layer in layers if layer.active_render), None)
    if layer is None:
        return None
    values = np.empty((len(mesh.loops), 2), np.float32)
    if hasattr(layer, "uv"):  # from Blender 3.5
        layer.uv.foreach_get("vector", values.ravel())
    else:
        layer.data.foreach_get("uv", values.ravel())
    return values


def _tangent(mesh: bpy.types.Mesh, arrays: MeshArrays, inner: str, name: str, result: MeshAttributes) -> None:
    uv = _uv_values(mesh, inner)
    if uv is not None:
        result.corner_attributes[name] = corner_tangents(arrays, corner_normals(mesh), uv)


def _generated(mesh: bpy.types.Mesh, arrays: MeshArrays, inner: str, name: str, result: MeshAttributes) -> None:
    """0 to 1 over the texture space, of the mesh without what deforms it."""
    values = np.empty((len(mesh.vertices), 3), np.float32)
    mesh.vertices.foreach_get("undeformed_co", values.ravel())
    half = 2 * np.array(mesh.texspace_size, np.float32)
    half[half == 0] = 1
    result.vertex_attributes[name] = (values - np.array(mesh.texspace_location, np.float32)) / half + np.float32(0.5)


def _color(mesh: bpy.types.Mesh, arrays: MeshArrays, inner: str, name: str, result: MeshAttributes) -> None:
    """The colour attribute that is active for rendering."""
    index = mesh.color_attributes.render_color_index
    if 0 <= index < len(mesh.color_attributes):
        _read(mesh, mesh.color_attributes[index], name, result)


def _named(mesh: bpy.types.Mesh, arrays: MeshArrays, inner: str, name: str, result: MeshAttributes) -> None:
    attribute = mesh.attributes.get(inner)
    if mesh.uv_layers.get(inner) is not None:
        _uv(mesh, arrays, inner, name, result)
    elif attribute is not None and attribute.data_type in VALUES:
        _read(mesh, attribute, name, result)


def attribute_values(attribute: Any) -> Array:
    """(elements, numbers) of an attribute whose data type is one of VALUES."""
    key, width = VALUES[attribute.data_type]
    dtype = np.float32
    if width == 1 and attribute.data_type != "FLOAT":
        dtype = np.bool_ if attribute.data_type == "BOOLEAN" else np.int32
    raw = np.empty(len(attribute.data) * width, dtype)
    attribute.data.foreach_get(key, raw)
    return raw.reshape(-1, width).astype(np.float32)


def _read(mesh: bpy.types.Mesh, attribute: Any, name: str, result: MeshAttributes) -> None:
    values = attribute_values(attribute)
    if attribute.domain == "POINT":
        result.vertex_attributes[name] = values
    elif attribute.domain == "CORNER":
        result.corner_attributes[name] = values
    elif attribute.domain == "FACE":
        sizes = np.empty(len(mesh.polygons), np.int32)
        mesh.polygons.foreach_get("loop_total", sizes)
        result.corner_attributes[name] = np.repeat(values, sizes, axis=0)
    elif attribute.domain == "EDGE":  # its mean at each vertex
        ends = _edges(mesh).ravel()
        sums = np.zeros((len(mesh.vertices), values.shape[1]), np.float32)
        np.add.at(sums, ends, np.repeat(values, 2, axis=0))
        counts = np.bincount(ends, minlength=len(sums))
        result.vertex_attributes[name] = sums / np.maximum(counts, 1)[:, None].astype(np.float32)


def _nothing(mesh: bpy.types.Mesh, arrays: MeshArrays, inner: str, name: str, result: MeshAttributes) -> None:
    """What only curves and points have."""


def _island(mesh: bpy.types.Mesh, arrays: MeshArrays, inner: str, name: str, result: MeshAttributes) -> None:
    result.vertex_attributes[name] = random_of_islands(len(mesh.vertices), _edges(mesh))[:, None]


def _pointiness(mesh: bpy.types.Mesh, arrays: MeshArrays, inner: str, name: str, result: MeshAttributes) -> None:
    positions, normals = np.empty((2, len(mesh.vertices), 3), np.float32)
    mesh.vertices.foreach_get("co", positions.ravel())
    mesh.vertices.foreach_get("normal", normals.ravel())
    result.vertex_attributes[name] = pointiness(positions, normals, _edges(mesh))[:, None]


def _edges(mesh: bpy.types.Mesh) -> NDArray[np.int32]:
    """(E, 2) vertices."""
    edges = np.empty((len(mesh.edges), 2), np.int32)
    mesh.edges.foreach_get("vertices", edges.ravel())
    return edges


_OF_MESH: dict[str, Callable[[bpy.types.Mesh, MeshArrays, str, str, MeshAttributes], None]] = {
    "uv": _uv,
    "tangent": _tangent,
    "generated": _generated,
    "color": _color,
    "island": _island,
    "pointiness": _pointiness,
    "attribute": _named,
    "strand": _nothing,
    "point": _nothing,
}
