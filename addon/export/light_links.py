"""Which objects a light lights and whose shadows it casts: light linking and shadow linking, from Blender 4.0 on.

A collection with objects or collections that are included is of these alone, and else of all but those that are
excluded. Objects that the same lights light are one set of the core's. [Blender 4.5 deg_light_linking.cc]
"""

from __future__ import annotations

from collections.abc import Hashable
from dataclasses import dataclass
from typing import Any

import bpy

from ..report import Reporter

_MAX_SETS = 64
_ALL = 2**_MAX_SETS - 1


class _Sets:
    """Of receivers, or of blockers."""

    def __init__(self, depsgraph: bpy.types.Depsgraph, pointer: str, reporter: Reporter) -> None:
        self._pointer = pointer
        self._members: dict[Hashable, tuple[bool, dict[int, bool]]] = {}  # by a collection's address
        for blender_object in depsgraph.objects:
            collection = self._collection_of(blender_object)
            if collection is not None:
                self._members.setdefault(collection.as_pointer(), _members(collection))
        self._sets: dict[tuple[bool, ...], int] = {self._signature(0): 0}
        for address in {address for _, states in self._members.values() for address in states}:
            self._sets.setdefault(self._signature(address), len(self._sets))
        if len(self._sets) > _MAX_SETS:
            reporter.warn(
                f"view layer '{depsgraph.view_layer.name}': more than {_MAX_SETS} sets of objects that lights "
                "tell apart by their linking are not supported, further ones are lit as objects that no light names"
            )

    def _collection_of(self, blender_object: bpy.types.Object) -> Any:
        collection = getattr(getattr(blender_object, "light_linking", None), self._pointer, None)
        return None if collection is None else collection.original

    def _signature(self, address: int) -> tuple[bool, ...]:
        """By which of the collections' lights an object is found."""
        return tuple(states.get(address, otherwise) for otherwise, states in self._members.values())

    def set_of(self, blender_object: bpy.types.Object) -> int:
        number = self._sets[self._signature(blender_object.original.as_pointer())] if self._members else 0
        return number if number < _MAX_SETS else 0

    def mask_of(self, light: bpy.types.Object) -> int:
        collection = self._collection_of(light)
        if collection is None:
            return _ALL
        place = list(self._members).index(collection.as_pointer())
        return sum(1 << number for signature, number in self._sets.items() if signature[place] and number < _MAX_SETS)


@dataclass(frozen=True)
class LightLinks:
    """The sets of all objects of a depsgraph."""

    receivers: _Sets
    blockers: _Sets

    @staticmethod
    def read(depsgraph: bpy.types.Depsgraph, reporter: Reporter) -> LightLinks:
        return LightLinks(
            _Sets(depsgraph, "receiver_collection", reporter), _Sets(depsgraph, "blocker_collection", reporter)
        )

    def masks(self, light: bpy.types.Object) -> tuple[int, int]:
        """Of the sets that a lamp, or an object that shines, is for."""
        return self.receivers.mask_of(light), self.blockers.mask_of(light)

    def sets(self, blender_object: bpy.types.Object) -> tuple[int, int]:
        """That an object is in."""
        return self.receivers.set_of(blender_object), self.blockers.set_of(blender_object)


NO_LINKS = (_ALL, _ALL)


def _members(collection: Any) -> tuple[bool, dict[int, bool]]:
    """Whether objects that it does not name are found, and, by their addresses, whether those are that it names."""
    states: dict[int, bool] = {}
    own = [*zip(collection.children, collection.collection_children, strict=True)]
    for child, linked in own:
        for blender_object in child.all_objects:
            states[blender_object.original.as_pointer()] = linked.light_linking.link_state == "INCLUDE"
    for blender_object, linked in zip(collection.objects, collection.collection_objects, strict=True):
        states[blender_object.original.as_pointer()] = linked.light_linking.link_state == "INCLUDE"
    return not any(states.values()), states
