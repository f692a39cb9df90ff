"""Hair particle systems as curves: the strands that their children and settings make, as Cycles has them."""

from __future__ import annotations

import functools
from collections.abc import Iterator
from typing import Any, NamedTuple

import bpy
import numpy as np
from numpy.typing import NDArray

from .curves import CurveArrays, CurveSource, add_strand_attributes, ways_along
from .strand_cache import cached_positions

Array = NDArray[np.float32]


def strand_sources(blender_object: bpy.types.Object, is_render: bool) -> list[CurveSource]:
    """One for each particle system of an evaluated object that shows strands. None in Edit and Particle Edit Mode."""
    sources = []
    for modifier in _strand_modifiers(blender_object, is_render):
        counts, slot = strand_counts(modifier, is_render), max(modifier.particle_system.settings.material - 1, 0)
        if counts.count:
            read = functools.partial(strand_arrays, blender_object, modifier, counts)
            sources.append(CurveSource(f"strands {modifier.name}", slot, tuple(counts), read))
    return sources


def _strand_modifiers(blender_object: bpy.types.Object, is_render: bool) -> list[Any]:
    if blender_object.type != "MESH" or blender_object.mode in {"EDIT", "PARTICLE_EDIT"}:
        return []
    return [
        modifier
        for modifier in blender_object.modifiers
        if modifier.type == "PARTICLE_SYSTEM"
        and (modifier.show_render if is_render else modifier.show_viewport)
        and modifier.particle_system.settings.type == "HAIR"
        and modifier.particle_system.settings.render_type == "PATH"
    ]


class StrandCounts(NamedTuple):
    """Of one particle system."""

    first: int  # as Blender numbers them: parents come before their children, which are shown in their place
    count: int
    steps: int  # points of each


def strand_counts(modifier: Any, is_render: bool) -> StrandCounts:
    """[Cycles 4.5 blender/curves.cpp]"""
    system = modifier.particle_system
    settings, parents, children = system.settings, len(system.particles), len(system.child_particles)
    if not is_render:
        children = int(children * settings.display_percentage / 100)
    first = parents if settings.child_type != "NONE" and children else 0
    steps = (1 << (settings.render_step if is_render else settings.display_step)) + 1
    if settings.kink == "SPIRAL":
        steps += settings.kink_extra_steps
    return StrandCounts(first, parents + children - first, steps)


def strand_arrays(
    blender_object: bpy.types.Object, modifier: Any, counts: StrandCounts, names: frozenset[str]
) -> CurveArrays:
    """The strands of one of its systems, object space. names: of the attributes that its material asks for."""
    system, (first, count, steps) = modifier.particle_system, counts
    positions = _positions(system, blender_object, first, count, steps)
    offsets = np.arange(count + 1, dtype=np.int32) * np.int32(steps)
    arrays = CurveArrays(positions, np.empty(len(positions), np.float32), offsets)
    arrays.radii_m[:] = _radii(system.settings, arrays, steps)
    add_strand_attributes(arrays, names)
    _add_emitter_attributes(blender_object, modifier, range(first, first + count), arrays, names)
    return arrays


def _positions(system: Any, blender_object: bpy.types.Object, first: int, count: int, steps: int) -> Array:
    """(count * steps, 3)."""

    def coordinates() -> Iterator[float]:
        of_hair = system.co_hair
        for strand in range(first, first + count):
            for step in range(steps):
                yield from of_hair(object=blender_object, particle_no=strand, step=step)

    world = cached_positions(blender_object, system, first, count, steps)
    if world is None:  # a call for each point takes long
        world = np.fromiter(coordinates(), np.float32, 3 * count * steps)
    to_world = blender_object.matrix_world
    to_object = np.array(to_world.to_3x3().inverted_safe(), np.float32)
    return (world.reshape(-1, 3) - np.array(to_world.translation, np.float32)) @ to_object.T


def _radii(settings: Any, arrays: CurveArrays, steps: int) -> Array:
    """[Cycles 4.5 blender/curves.cpp]"""
    along, lengths = ways_along(arrays)
    left = 1 - (along.reshape(-1, steps) / np.where(lengths > 0, lengths, 1)[:, None]).clip(0, 1)
    if settings.shape < 0:
        left = left ** (1 + settings.shape)
    elif settings.shape > 0:
        left = left ** (1 / max(1 - settings.shape, 1e-6))
    root, tip = (0.5 * settings.radius_scale * each for each in (settings.root_radius, settings.tip_radius))
    radii = left * (root - tip) + tip
    if settings.use_close_tip:
        radii[:, -1] = 0
    return radii.ravel().astype(np.float32)


def _add_emitter_attributes(
    blender_object: bpy.types.Object, modifier: Any, strands: range, arrays: CurveArrays, names: frozenset[str]
) -> None:
    """What strands have of the place on the mesh that they grow from."""
    mesh, system = blender_object.data, modifier.particle_system
    for name in names:
        kind, _, inner = name.partition(":")
        layers = mesh.uv_layers.keys()
        if kind == "generated":
            half = 2 * np.array(mesh.texspace_size, np.float32)
            half[half == 0] = 1
            roots = arrays.positions[arrays.offsets[:-1]]
            arrays.add_of_curves(name, (roots - np.array(mesh.texspace_location, np.float32)) / half + np.float32(0.5))
        elif kind == "uv" or (kind == "attribute" and inner in layers):
            chosen = inner if inner else next((layer.name for layer in mesh.uv_layers if layer.active_render), None)
            if chosen in layers:
                number = layers.index(chosen)
                uv = [
                    system.uv_on_emitter(modifier, particle=particle, particle_no=strand, uv_no=number)
                    for strand, particle in zip(strands, _emitted_by(system, strands), strict=True)
                ]
                arrays.add_of_curves(name, np.array(uv, np.float32).reshape(-1, 2))


def _emitted_by(system: Any, strands: range) -> Iterator[Any]:
    """The particle to name with each strand: its own, or of children any."""
    parents = system.particles
    for strand in strands:
        yield parents[strand if strand < len(parents) else 0]
