"""How Curves, point clouds and strands deform while the shutter is open."""

from __future__ import annotations

from collections.abc import Iterable

import bpy
import numpy as np

from .context import Context
from .curves import Array, CurveSource, curve_source
from .strands import strand_sources

_ROUNDING = 1e-5  # of their extent: strands that move with their object are read in world space


def sources_of(blender_object: bpy.types.Object, is_render: bool) -> list[CurveSource]:
    """What curves of an evaluated object are read from."""
    if blender_object.type == "MESH":
        return strand_sources(blender_object, is_render)
    return [curve_source(blender_object.data)]


class CurveMotion:
    """Of the core's curves that the exported scene has; `look` at all times but the middle, then `finish`."""

    def __init__(self, context: Context, deforming: Iterable[int]) -> None:
        """deforming: the depsgraph's instances that are asked how they deform."""
        self._context = context
        self._is_render = context.depsgraph.mode == "RENDER"
        asked = set(deforming)
        # By the instance: the core's id of each of its sources by name.
        self._ids: dict[int, dict[str, int]] = {}
        for id_, (index, name) in context.placed.curves.items():
            if index in asked:
                self._ids.setdefault(index, {})[name] = id_
        self._rest: dict[int, Array] = {}
        self._looks: dict[int, dict[float, Array | None]] = {}  # by id; None: of other points
        if self._ids:
            for index, instance in enumerate(context.depsgraph.object_instances):
                for name, positions in self._positions(index, instance.object).items():
                    self._rest[self._ids[index][name]] = positions

    def _positions(self, index: int, blender_object: bpy.types.Object) -> dict[str, Array]:
        if index not in self._ids:
            return {}
        sources = [each for each in sources_of(blender_object, self._is_render) if each.name in self._ids[index]]
        return {source.name: source.read(frozenset()).positions for source in sources}

    def look(self, index: int, blender_object: bpy.types.Object, time: float) -> None:
        """Note where the points of an instance are at a time, at which its object is evaluated."""
        if index not in self._ids:
            return
        found = self._positions(index, blender_object)
        for name, id_ in self._ids[index].items():
            rest, now = self._rest[id_], found.get(name)
            if now is None or now.shape != rest.shape:
                self._looks.setdefault(id_, {})[time] = None
            elif rest.size and np.abs(now - rest).max() > _ROUNDING * np.abs(rest).max():
                self._looks.setdefault(id_, {})[time] = now

    def finish(self, times: dict[int, list[float]]) -> None:
        """Tell the core's scene. times: at which each instance was looked at."""
        for id_, looks in self._looks.items():
            index, _ = self._context.placed.curves[id_]
            steps = [looks.get(time, self._rest[id_]) for time in times[index]]
            if any(step is None for step in steps):
                self._report(index)
            else:
                self._context.scene.set_mesh_motion(id_, positions=steps)

    def _report(self, index: int) -> None:
        for number, instance in enumerate(self._context.depsgraph.object_instances):
            if number == index:
                self._context.reporter.warn(
                    f"object '{instance.object.name}': its curves have other points at other times of the shutter, "
                    "they move as they are in the middle"
                )
