"""Densities and glows that nodes compute, baked to voxels: what varies within a volume is a grid of the core's.

A world has no bounds, so what varies in its volume cannot be baked.
"""

from __future__ import annotations

from typing import Any

import bpy
import numpy as np
from numpy.typing import NDArray

from .attributes import object_attributes
from .context import Context
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


def bake(
    context: Context,
    program: Program,
    value: Value,
    blender_object: bpy.types.Object,
    object_to_world: Array,
    owner: str,
    random: float = 0.0,
) -> Any:
    """A pivot_core.VoxelGrid, in object space, of what a program makes of a value within an object's bounds.

    value: a number or a colour, taken as 0 where it is negative or not finite. blender_object: evaluated, a mesh.
    object_to_world: (4, 4). owner: how reports name it. random: Object Info's. LONGEST voxels lie along the longest
    side of the bounds, the outermost on them. As in Cycles, Generated coordinates are those of the mesh's texture
    space, and attributes of the mesh are 0.
    """
    _report_unknown(context, program, owner)
    low, high = _bounds(blender_object)
    size, spacing = _lattice(high - low)
    x, y, z = (start + step * np.arange(count) for start, step, count in zip(low, spacing, size, strict=True))
    registers = [part.index for part in value.parts if isinstance(part, Register)]
    values = np.empty((len(z), len(y), len(x), len(value.parts)), np.float32)
    told = {
        "color": tuple(blender_object.color),
        "pass_index": blender_object.pass_index,
        "random": random,
        "object_attributes": {
            context.scene.attribute_id(name): numbers
            for name, numbers in object_attributes(
                frozenset(program.attributes), blender_object, None, context.depsgraph
            ).items()
        },
    }
    layers = max(1, _POINTS_AT_ONCE // (len(y) * len(x)))
    for first in range(0, len(z), layers):
        chunk = values[first : first + layers]
        points = np.stack(np.meshgrid(z[first : first + layers], y, x, indexing="ij")[::-1], -1).reshape(-1, 3)
        points = points.astype(np.float32)
        attributes = _attributes(context, program, blender_object.data, points)
        columns = iter(program.program.run_at(points, object_to_world, registers, attributes=attributes, **told).T)
        for index, part in enumerate(value.parts):
            chunk[..., index] = next(columns).reshape(chunk.shape[:3]) if isinstance(part, Register) else part
    values[~(np.isfinite(values) & (values > 0))] = 0
    grid_from_object = np.diag([*(1 / spacing), 1.0])
    grid_from_object[:3, 3] = -low / spacing
    numbers = values if len(value.parts) == 3 else values[..., 0]
    return context.core.VoxelGrid(numbers, grid_from_object.astype(np.float32))


def _lattice(extent: NDArray[np.float64]) -> tuple[tuple[int, int, int], NDArray[np.float64]]:
    """How many voxels lie along each side of a box, one along what is flat, and how far apart."""
    spacing = extent.max() / (LONGEST - 1)
    counts = np.rint(extent / spacing if spacing > 0 else extent).astype(int) + 1
    # What is flat takes any spacing: its voxels fall to 0 within one of it.
    apart = np.where(counts > 1, extent / np.maximum(counts - 1, 1), max(spacing, 1e-6))
    return (int(counts[0]), int(counts[1]), int(counts[2])), apart


def _bounds(blender_object: bpy.types.Object) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """The lowest and highest corner in object space, of the mesh as it is evaluated."""
    mesh = blender_object.data
    positions = np.empty((len(mesh.vertices), 3), np.float32)
    mesh.vertices.foreach_get("co", positions.ravel())
    if len(positions) == 0:
        return np.zeros(3), np.zeros(3)
    return positions.min(axis=0).astype(float), positions.max(axis=0).astype(float)


def _attributes(context: Context, program: Program, mesh: bpy.types.Mesh, points: Array) -> dict[int, Array]:
    """Generated coordinates, which alone of a mesh's attributes go on within it. [Cycles 4.5 kernel/geom/volume.h]"""
    if "generated:" not in program.attributes:
        return {}
    half = 2 * np.array(mesh.texspace_size, np.float32)
    half[half == 0] = 1
    generated = (points - np.array(mesh.texspace_location, np.float32)) / half + np.float32(0.5)
    return {context.scene.attribute_id("generated:"): generated}


def _report_unknown(context: Context, program: Program, owner: str) -> None:
    for what in sorted({_UNKNOWN[op] for op in program.program.ops if op in _UNKNOWN}):
        context.reporter.warn(f"{owner}: what depends on {what} is not supported in a volume, which is baked without")
