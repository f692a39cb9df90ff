"""What nodes compute within an object, baked to voxels: what varies within a volume is a grid of the core's.

A world has no bounds, so what varies in its volume cannot be baked.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import bpy
import numpy as np
from numpy.typing import NDArray

from .attributes import is_of_mesh, object_attributes
from .context import Context
from .grids import NO_GRIDS, Grids, Lattice
from .program import Program, Register, Value

Array = NDArray[np.float32]
LONGEST = 128  # voxels along the longest side of an object's bounds
_POINTS_AT_ONCE = 1 << 18

_OF_RAYS = """
    position_camera window camera_data camera_from_world_point camera_from_world_vector world_from_camera_point
    world_from_camera_vector ray_is ray_length ray_depth incoming reflection
"""
_OF_SURFACES = """
    normal normal_object true_normal parametric backfacing wireframe tangent fresnel layer_weight_fresnel
    layer_weight_facing
"""
_OF_INSTANCES = "instance_generated instance_uv particle_index particle_random"
# Ops that ask for what a place within a volume does not have, and what that is to a user.
_UNKNOWN = {
    **dict.fromkeys(_OF_RAYS.split(), "the ray or the camera"),
    **dict.fromkeys(_OF_SURFACES.split(), "the surface"),
    **dict.fromkeys(_OF_INSTANCES.split(), "the instance"),
}
# Ops that give something else for each instance of an object.
_PLACED = frozenset(
    [
        *("position", "position_in", "object_location", "object_random"),
        *(f"world_from_object_{kind}" for kind in ("point", "vector", "normal")),
        *(f"object_from_world_{kind}" for kind in ("point", "vector", "normal")),
    ]
)


@dataclass(frozen=True)
class Interior:
    """What shaders are told within an object."""

    blender_object: bpy.types.Object  # evaluated
    mesh: bpy.types.Mesh | None  # around it, with what is edited in Edit Mode; None: of a Volume object
    object_to_world: Array  # (4, 4)
    random: float  # Object Info's
    grids: Grids = NO_GRIDS

    def lattice(self, grid_names: frozenset[str]) -> Lattice | None:
        """Where voxels lie: those of the grids of these names, else LONGEST along the longest side of the mesh.

        None for a Volume object without any of the grids.
        """
        of_grids = self.grids.lattice(grid_names)
        return bounds_lattice(self.mesh) if of_grids is None and self.mesh is not None else of_grids


def is_placed(program: Program) -> bool:
    """Whether it may give something else for each instance of an object."""
    return not _PLACED.isdisjoint(program.program.ops)


def reads_place(program: Program) -> bool:
    """Whether it asks for more of a place or an object than the grids there."""
    asks_elsewhere = any(op != "attribute" and program.ops[op][2] for op in program.program.ops)
    return asks_elsewhere or "generated:" in program.attributes


def bake(
    context: Context, program: Program, values: Sequence[Value], lattice: Lattice, interior: Interior, owner: str
) -> list[Array]:
    """(N, parts) of each value at a lattice's points, x fastest; (1, parts) of one that is a constant.

    What varies is taken as 0 where it is negative or not finite. owner: how reports name it. As in Cycles, Generated
    coordinates are those of the mesh's texture space, and attributes that are no grids are 0.
    """
    _report_unknown(context, program, owner)
    registers = sorted({part.index for value in values for part in value.parts if isinstance(part, Register)})
    columns = np.empty((lattice.count, len(registers)), np.float32)
    blender_object, scene = interior.blender_object, context.scene
    of_object = object_attributes(frozenset(program.attributes), blender_object, None, context.depsgraph)
    told = {
        "color": tuple(blender_object.color),
        "pass_index": blender_object.pass_index,
        "random": interior.random,
        "object_attributes": {scene.attribute_id(name): numbers for name, numbers in of_object.items()},
    }
    tables = _grid_tables(program, lattice, interior.grids) if registers else {}
    for first in range(0, lattice.count if registers else 0, _POINTS_AT_ONCE):
        part = slice(first, min(first + _POINTS_AT_ONCE, lattice.count))
        points = lattice.points(part).astype(np.float32)
        attributes = {scene.attribute_id(name): table[part] for name, table in tables.items()}
        if "generated:" in program.attributes:
            attributes[scene.attribute_id("generated:")] = _generated(interior.mesh, points)
        columns[part] = program.program.run_at(
            points, interior.object_to_world, registers, attributes=attributes, **told
        )
    columns[~(np.isfinite(columns) & (columns > 0))] = 0
    return [_joined(value, registers, columns) for value in values]


def _joined(value: Value, registers: list[int], columns: Array) -> Array:
    if value.is_constant:
        return np.array([value.numbers], np.float32)
    parts = [columns[:, registers.index(part.index)] if isinstance(part, Register) else part for part in value.parts]
    return np.stack(np.broadcast_arrays(*parts), axis=1).astype(np.float32, copy=False)


def bounds_lattice(mesh: bpy.types.Mesh) -> Lattice:
    """LONGEST points along the longest side of a mesh's bounds, the outermost on them; one along what is flat."""
    positions = np.empty((len(mesh.vertices), 3), np.float32)
    mesh.vertices.foreach_get("co", positions.ravel())
    low, high = positions.min(axis=0).astype(float), positions.max(axis=0).astype(float)
    extent = high - low
    spacing = extent.max() / (LONGEST - 1)
    counts = np.rint(extent / spacing if spacing > 0 else extent).astype(int) + 1
    # What is flat takes any spacing: its voxels fall to 0 within one of it.
    apart = np.where(counts > 1, extent / np.maximum(counts - 1, 1), max(spacing, 1e-6))
    grid_from_object = np.diag([*(1 / apart), 1.0])
    grid_from_object[:3, 3] = -low / apart
    x, y, z = (int(count) for count in counts)
    return Lattice((x, y, z), grid_from_object)


def _grid_tables(program: Program, lattice: Lattice, grids: Grids) -> dict[str, Array]:
    """(N, 1..4) of each attribute that a program reads but Generated coordinates: 0 with an alpha of 0 without one."""
    tables = {}
    for name in filter(is_of_mesh, program.attributes - {"generated:"}):
        kind, _, inner = name.partition(":")
        is_grid = kind == "attribute" and grids.has(inner)
        tables[name] = (
            _straight(grids.found[inner].at(lattice)) if is_grid else np.zeros((lattice.count, 4), np.float32)
        )
    return tables


def _straight(values: Array) -> Array:
    """Colours with an alpha are kept multiplied by it. [Cycles 4.5 geom/volume.h]"""
    if values.shape[1] != 4:
        return values
    alpha = values[:, 3:]
    is_scaled = (alpha > 1e-6) & (alpha != 1)
    return np.where(is_scaled, np.hstack([values[:, :3] / np.where(is_scaled, alpha, 1), alpha]), values)


def _generated(mesh: bpy.types.Mesh | None, points: Array) -> Array:
    """Generated coordinates, which go on within a mesh; a Volume object has none. [Cycles 4.5 kernel/geom/volume.h]"""
    if mesh is None:
        return points
    half = 2 * np.array(mesh.texspace_size, np.float32)
    half[half == 0] = 1
    return (points - np.array(mesh.texspace_location, np.float32)) / half + np.float32(0.5)


def _report_unknown(context: Context, program: Program, owner: str) -> None:
    for what in sorted({_UNKNOWN[op] for op in program.program.ops if op in _UNKNOWN}):
        context.reporter.warn(f"{owner}: what depends on {what} is not supported in a volume, which is baked without")
