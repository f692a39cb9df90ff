"""Materials: each of Blender's becomes one of the core's, made when first met."""

from __future__ import annotations

import bpy
import numpy as np

from ..report import naming
from .context import Context
from .nodes import Owner, active_tree
from .shader import GREY, material_surface
from .surface import Surface


class MaterialTable:
    """The core's ids of the materials met so far."""

    def __init__(self, context: Context) -> None:
        self._context = context
        self._ids: dict[int, int] = {}  # by the address of the Blender material; 0: none
        self._override = context.depsgraph.view_layer_eval.material_override

    def slots(self, slot_materials: list[bpy.types.Material | None], user: bpy.types.Object) -> tuple[int, ...]:
        """One id per slot, at least one. user: the object to name in reports."""
        return tuple(self._id(self._override or material, user) for material in slot_materials or [None])

    def _id(self, material: bpy.types.Material | None, user: bpy.types.Object) -> int:
        key = material.as_pointer() if material else 0
        if key not in self._ids:
            name = material.name if material else "none"
            surface = _surface(material, Owner(f"object '{user.name}', material '{name}'", self._context.reporter))
            self._warn_of_emission(surface, user, name)
            with naming(f"object '{user.name}', material '{name}'", "give its colours and numbers finite values"):
                self._ids[key] = self._context.scene.add_material(name, surface.core_material(self._context.core))
        return self._ids[key]

    def _warn_of_emission(self, surface: Surface, user: bpy.types.Object, name: str) -> None:
        if self._context.depsgraph.scene_eval.pivot.integrator == "ANALYTIC" and surface.emission.any():
            self._context.reporter.warn(
                f"object '{user.name}', material '{name}': in the analytic integrator its emission is shown, but "
                "lights nothing. Fix: use Monte Carlo"
            )


def _surface(material: bpy.types.Material | None, owner: Owner) -> Surface:
    if material is None:
        return GREY
    tree = active_tree(material)
    if tree is None:
        return Surface(diffuse=np.array(material.diffuse_color[:3]))  # as Cycles has it
    return material_surface(tree, owner)
