"""The core's meshes of exports before, for those to come: what Blender says has changed is exported again."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from types import ModuleType
from typing import Any

import bpy

_GEOMETRY = tuple(
    getattr(bpy.types, kind) for kind in ("Mesh", "Curve", "MetaBall", "Lattice", "Key", "Curves", "PointCloud")
)


@dataclass(frozen=True)
class _Entry:
    state: tuple[int, ...]  # of the evaluated data: another count of parts is another mesh, whatever Blender says
    meshes: list[tuple[Any, bool]]  # pivot_core.Mesh, and whether rays pass it


class MeshCache:
    """Of one depsgraph, all of whose updates it must be told."""

    def __init__(self, core: ModuleType) -> None:
        self.shared = core.SharedMeshes()
        self._entries: dict[
            tuple[Any, ...], _Entry
        ] = {}  # by the original object and its data, the evaluated mesh, how
        self._used: set[tuple[Any, ...]] = set()

    def forget(self, updates: Iterable[bpy.types.DepsgraphUpdate]) -> None:
        """Forget the meshes that these have changed."""
        changed = {
            update.id.original.as_pointer()
            for update in updates
            if update.is_updated_geometry or isinstance(update.id, _GEOMETRY)
        }
        if changed:
            self._entries = {key: entry for key, entry in self._entries.items() if changed.isdisjoint(key[:2])}

    def take(
        self,
        scene: Any,
        blender_object: bpy.types.Object,
        how: tuple[Any, ...],
        state: tuple[int, ...],
        add: Callable[[], list[tuple[int, bool]]],
    ) -> list[tuple[int, bool]]:
        """Ids in a pivot_core.Scene, and whether rays pass these; what `add` returns, which adds them, if need be.

        blender_object: evaluated. how: what besides it the meshes depend on. state: how many parts it has.
        """
        data, original = blender_object.data, blender_object.original
        if getattr(data, "is_editmode", False):
            return add()
        key = (original.as_pointer(), original.data.as_pointer(), data.as_pointer(), *how)
        self._used.add(key)
        entry = self._entries.get(key)
        if entry is not None and entry.state == state:
            return [(scene.add_shared_mesh(shared), is_passed) for shared, is_passed in entry.meshes]
        added = add()
        self._entries[key] = _Entry(state, [(scene.mesh(id_), is_passed) for id_, is_passed in added])
        return added

    def sweep(self) -> None:
        """Forget what nobody took since the last sweep."""
        self._entries = {key: entry for key, entry in self._entries.items() if key in self._used}
        self._used = set()
