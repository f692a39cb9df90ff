"""Evaluated meshes as arrays."""

from __future__ import annotations

import ctypes
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from typing import Any

import bpy
import numpy as np
from numpy.typing import DTypeLike, NDArray

# Blender 4.1 dropped the calls that compute corner normals and triangles: both are computed when read.
_LAZY = bpy.app.version >= (4, 1)


@dataclass(frozen=True)
class MeshArrays:
    """V vertices, C face corners, T triangles; the arguments of pivot_core.Scene.add_mesh."""

    positions: NDArray[np.float32]  # (V, 3)
    corner_vertices: NDArray[np.int32]  # (C,)
    triangle_corners: NDArray[np.int32]  # (T, 3)
    corner_normals: NDArray[np.float32] | None  # (C, 3), unit; 0: the triangle's own
    vertex_normals: NDArray[np.float32] | None  # (V, 3), unit, where no corner has its own; without both: flat
    triangle_slots: NDArray[np.int32] | None  # (T,); None: all 0

    def parted(self, slots_apart: frozenset[int], last_slot: int) -> list[tuple[MeshArrays, bool]]:
        """The triangles of the slots apart and the others, where there are any, and whether they are apart.

        A slot past the last stands for it.
        """
        if not slots_apart:
            return [(self, False)]
        slots = np.zeros(1, np.int32) if self.triangle_slots is None else self.triangle_slots.clip(max=last_slot)
        is_apart = np.isin(slots, list(slots_apart))
        if is_apart.all() or not is_apart.any():
            return [(self, bool(is_apart[0]))]
        return [
            (
                replace(
                    self,
                    triangle_corners=self.triangle_corners[is_apart == part],
                    triangle_slots=slots[is_apart == part],
                ),
                part,
            )
            for part in (False, True)
        ]


@contextmanager
def edits_applied(blender_object: bpy.types.Object) -> Iterator[bpy.types.Mesh]:
    """The mesh of an evaluated object, with what is edited in Edit Mode.

    There an evaluated mesh without a visible modifier only stands for the edited one and has no triangles of its own.
    """
    if not blender_object.data.is_editmode:
        yield blender_object.data
        return
    try:
        yield blender_object.to_mesh()
    finally:
        blender_object.to_mesh_clear()


def mesh_arrays(mesh: bpy.types.Mesh) -> MeshArrays:
    """The triangles of an evaluated mesh that has polygons. The arrays are copies."""
    if not _LAZY:
        mesh.calc_loop_triangles()
    corner_vertices, triangle_corners = _corner_vertices(mesh), _triangle_corners(mesh)
    slots = _polygon_slots(mesh)
    at_corners, at_vertices = _normals(mesh, corner_vertices, triangle_corners)
    return MeshArrays(
        positions=positions(mesh),
        corner_vertices=corner_vertices,
        triangle_corners=triangle_corners,
        corner_normals=at_corners,
        vertex_normals=at_vertices,
        triangle_slots=None if slots is None else slots[_triangle_polygons(mesh)],
    )


def _read(collection: Any, attribute: str, dtype: DTypeLike, width: int = 1) -> NDArray[Any]:
    values = np.empty(len(collection) * width, dtype)
    collection.foreach_get(attribute, values)
    return values.reshape(-1, width) if width > 1 else values


def _triangle_corners(mesh: bpy.types.Mesh) -> NDArray[np.int32]:
    """(T, 3), read where Blender keeps them: foreach_get takes 0.15 s a million.

    Blender keeps three corners a triangle, before 4.1 followed by the polygon. The layout is no promise, so the first,
    middle and last triangle are compared with what RNA says, and foreach_get is used should they differ.
    """
    triangles = mesh.loop_triangles
    count = len(triangles)
    stride = 3 if _LAZY else 4
    address = triangles[0].as_pointer()
    block = np.ctypeslib.as_array((ctypes.c_int32 * (count * stride)).from_address(address)).reshape(count, stride)
    if all(tuple(block[i, :3]) == tuple(triangles[i].loops) for i in (0, count // 2, count - 1)):
        return np.array(block[:, :3])
    return _read(triangles, "loops", np.int32, 3)


def _triangle_polygons(mesh: bpy.types.Mesh) -> NDArray[np.int32]:
    if _LAZY:
        return _read(mesh.loop_triangle_polygons, "value", np.int32)
    return _read(mesh.loop_triangles, "polygon_index", np.int32)


def positions(mesh: bpy.types.Mesh) -> NDArray[np.float32]:
    """(V, 3), a copy."""
    attribute = mesh.attributes.get("position")  # from Blender 3.5
    if attribute is not None:
        return _read(attribute.data, "vector", np.float32, 3)
    return _read(mesh.vertices, "co", np.float32, 3)


def _corner_vertices(mesh: bpy.types.Mesh) -> NDArray[np.int32]:
    attribute = mesh.attributes.get(".corner_vert")
    if attribute is not None:
        return _read(attribute.data, "value", np.int32)
    return _read(mesh.loops, "vertex_index", np.int32)


def _normals(
    mesh: bpy.types.Mesh, corner_vertices: NDArray[np.int32], triangle_corners: NDArray[np.int32]
) -> tuple[NDArray[np.float32] | None, NDArray[np.float32] | None]:
    """Those of the corners or of the vertices as Cycles has them, neither where all is flat.

    Before Blender 5.2, without sharp edges and custom normals its smooth faces have the normals of their vertices, to
    which the flat faces beside them add, and which Blender's own corner normals leave out.
    """
    domain = _normals_domain(mesh)
    if domain == "CORNER":
        return corner_normals(mesh), None
    if domain == "FACE":
        return None, None
    vertex_normals = _read(mesh.vertex_normals, "vector", np.float32, 3)
    if domain == "POINT":
        return None, vertex_normals
    is_flat = ~_read(mesh.polygons, "use_smooth", np.bool_)[_triangle_polygons(mesh)]
    normals = vertex_normals[corner_vertices]
    normals[triangle_corners[is_flat]] = 0
    return normals, None


def _normals_domain(mesh: bpy.types.Mesh) -> str:
    """POINT: all corners at a vertex share its normal; FACE: all is flat; MIXED: one or the other; else CORNER."""
    if bpy.app.version >= (5, 2):
        return mesh.normals_domain
    if _LAZY:
        is_mixed = mesh.normals_domain == "CORNER" and not mesh.has_custom_normals and not _has_sharp_edges(mesh)
        return "MIXED" if is_mixed else mesh.normals_domain
    if mesh.use_auto_smooth:
        return "CORNER"
    is_smooth = _read(mesh.polygons, "use_smooth", np.bool_)
    return "POINT" if is_smooth.all() else "MIXED" if is_smooth.any() else "FACE"


def _has_sharp_edges(mesh: bpy.types.Mesh) -> bool:
    sharp = mesh.attributes.get("sharp_edge")
    return sharp is not None and bool(_read(sharp.data, "value", np.bool_).any())


def corner_normals(mesh: bpy.types.Mesh) -> NDArray[np.float32]:
    """Blender's own, unit: flat and smooth faces, sharp edges, auto smooth and custom normals."""
    if _LAZY:
        return _read(mesh.corner_normals, "vector", np.float32, 3)
    mesh.calc_normals_split()
    normals = _read(mesh.loops, "normal", np.float32, 3)
    mesh.free_normals_split()
    return normals


def _polygon_slots(mesh: bpy.types.Mesh) -> NDArray[np.int32] | None:
    attribute = mesh.attributes.get("material_index")  # absent when every polygon has slot 0
    return None if attribute is None else _read(attribute.data, "value", np.int32)
