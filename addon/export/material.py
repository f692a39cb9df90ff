"""Materials: each of Blender's becomes one of the core's, made when first met."""

from __future__ import annotations

from dataclasses import dataclass

import bpy

from ..report import naming
from .context import Context
from .microfacets import with_ndf
from .nodes import Owner, active_tree
from .program import Program
from .shader import grey, material_surface
from .surface import Surface


@dataclass(frozen=True)
class _Exported:
    id: int  # the core's
    attributes: frozenset[str]  # that it reads of its meshes


class MaterialTable:
    """The core's ids of the materials met so far."""

    def __init__(self, context: Context) -> None:
        self._context = context
        self._materials: dict[int, _Exported] = {}  # by the address of the Blender material; 0: none
        self._override = context.depsgraph.view_layer_eval.material_override

    def slots(
        self, slot_materials: list[bpy.types.Material | None], user: bpy.types.Object
    ) -> tuple[tuple[int, ...], frozenset[str]]:
        """One id per slot, at least one, and the attributes that they read. user: the object to name in reports."""
        slots = [self._exported(self._override or material, user) for material in slot_materials or [None]]
        return tuple(slot.id for slot in slots), frozenset().union(*(slot.attributes for slot in slots))

    def _exported(self, material: bpy.types.Material | None, user: bpy.types.Object) -> _Exported:
        key = material.as_pointer() if material else 0
        if key not in self._materials:
            name = material.name if material else "none"
            where = f"object '{user.name}', material '{name}'"
            program = Program(self._context.core, self._context.scene, self._context.images)
            owner = Owner(where, self._context.reporter, program, material)
            surface = _surface(material, owner)
            if material is not None:
                surface = with_ndf(surface, material, owner, self._context)
            self._warn_of_emission(surface, user, name)
            with naming(where, "give its colours and numbers finite values"):
                id_ = self._context.scene.add_material(name, surface.core_shader(self._context.core))
            self._materials[key] = _Exported(id_, frozenset(program.attributes))
        return self._materials[key]

    def _warn_of_emission(self, surface: Surface, user: bpy.types.Object, name: str) -> None:
        if self._context.depsgraph.scene_eval.pivot.integrator == "ANALYTIC" and not surface.emission.is_always(0):
            self._context.reporter.warn(
                f"object '{user.name}', material '{name}': in the analytic integrator its emission is shown, but "
                "lights nothing. Fix: use Monte Carlo"
            )


def _surface(material: bpy.types.Material | None, owner: Owner) -> Surface:
    if material is None:
        return grey(owner.program)
    tree = active_tree(material)
    if tree is None:
        return Surface.of(owner.program, diffuse=owner.program.colour(material.diffuse_color[:3]))  # as Cycles has it
    return material_surface(tree, owner)
