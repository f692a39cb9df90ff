"""What Geometry Nodes keep for each instance: attributes of the domain Instance, which materials read of Instancers."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

import bpy
import numpy as np

from .attributes import VALUES, Array, attribute_values

CAN_READ = hasattr(bpy.types.Object, "evaluated_geometry")  # not in Blender 3.4
_NO_ID = 0x7FFFFFFF


class InstanceAttributes:
    """Those of the instances of one evaluated object, and of what these instance in turn."""

    def __init__(self, instancer: bpy.types.Object, depsgraph: bpy.types.Depsgraph) -> None:
        self._instancer = instancer
        self._depsgraph = depsgraph
        self._levels: dict[int, _Level] = {}  # by the object's address

    def value(self, name: str, persistent_id: Sequence[int]) -> Array | None:
        """(4,) of the innermost instance that has the attribute; None where none has.

        persistent_id: of the depsgraph's instance, which tells the way to it from within.
        """
        way = [id_ for id_ in reversed(persistent_id) if id_ != _NO_ID]
        value = None
        for level, row in self._rows(self._instancer, way):
            values = level.values(name)
            value = value if values is None else values[row]
        return value

    def _rows(self, owner: Any, way: list[int]) -> Iterator[tuple[_Level, int]]:
        """The instances on a way, the outermost first. owner: of the first, an object, a collection or a level."""
        if isinstance(owner, bpy.types.Object):
            owner = owner.instance_collection if owner.instance_type == "COLLECTION" else self._level_of(owner)
        if isinstance(owner, bpy.types.Collection):
            if way and 0 <= way[0] < len(owner.all_objects):
                yield from self._rows(owner.all_objects[way[0]].evaluated_get(self._depsgraph), way[1:])
        elif isinstance(owner, _Level) and way and way[0] in owner.rows:
            row = owner.rows[way[0]]
            shown = owner.shown(row)
            if len(way) > 1 or not isinstance(shown, _Level):  # else the last id tells the kind of geometry
                yield owner, row
                yield from self._rows(shown, way[1:])

    def _level_of(self, blender_object: bpy.types.Object) -> _Level:
        key = blender_object.as_pointer()
        if key not in self._levels:
            self._levels[key] = _Level(blender_object.evaluated_geometry())
        return self._levels[key]


class _Level:
    """The instances in one of Blender's GeometrySets. rows: by their ids, of which each is the first's that has it."""

    def __init__(self, geometry: Any) -> None:
        self._geometry = geometry  # keeps what is read of it
        self._cloud = geometry.instances_pointcloud()
        self._shown: dict[int, Any] = {}  # by the number of the reference
        self._values: dict[str, Array | None] = {}
        count = len(self._cloud.points) if self._cloud is not None else 0
        ids = self._whole_numbers("id", count)
        self.rows = {id_: row for row, id_ in reversed(list(enumerate(range(count) if ids is None else ids)))}
        self._references = self._whole_numbers(".reference_index", count)

    def _whole_numbers(self, name: str, count: int) -> list[int] | None:
        attribute = self._cloud.attributes.get(name) if count else None
        if attribute is None:
            return None
        numbers = np.empty(count, np.int32)
        attribute.data.foreach_get("value", numbers)
        return numbers.tolist()

    def shown(self, row: int) -> Any:
        """What an instance shows: an object, a collection, a level of instances, or None."""
        number = 0 if self._references is None else self._references[row]
        if number not in self._shown:
            reference = self._geometry.instance_references()[number]
            self._shown[number] = _Level(reference) if isinstance(reference, bpy.types.GeometrySet) else reference
        return self._shown[number]

    def values(self, name: str) -> Array | None:
        """(instances, 4) of an attribute, as Cycles widens it."""
        if name not in self._values:
            attribute = self._cloud.attributes.get(name)
            known = attribute is not None and attribute.data_type in VALUES
            self._values[name] = _four(attribute_values(attribute)) if known else None
        return self._values[name]


def _four(values: Array) -> Array:
    """(N, 1..4) as colours: one number is grey, what lacks is 0, and alpha 1."""
    wide = np.repeat(values, 3, axis=1) if values.shape[1] == 1 else values
    result = np.tile(np.array((0, 0, 0, 1), np.float32), (len(values), 1))
    result[:, : wide.shape[1]] = wide
    return result
