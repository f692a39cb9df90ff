"""Materials: each of Blender's becomes one of the core's, made when first met.

What fills an object that keeps grids is a material of the core's for each such object.
"""

from __future__ import annotations

from collections.abc import Hashable
from dataclasses import dataclass
from typing import Any

import bpy

from ..report import naming
from .context import Context
from .grids import Grids, Lattice
from .media import NO_GRIDS, core_medium
from .microfacets import with_ndf
from .nodes import Owner, active_tree, output_socket
from .program import Program
from .shader import grey, material_surface
from .surface import Surface
from .volume import default_volume, node_volume, output_volume


@dataclass(frozen=True)
class _Exported:
    id: int  # the core's
    attributes: frozenset[str]  # that it reads of its meshes


@dataclass(frozen=True)
class Filling:
    """What an object is full of, without a surface."""

    id: int  # the core's
    lattice: Lattice | None  # of the grids that it reads; None: it is the same everywhere


class MaterialTable:
    """The core's ids of the materials met so far."""

    def __init__(self, context: Context) -> None:
        self._context = context
        self._materials: dict[int, _Exported] = {}  # by the address of the Blender material; 0: none
        self._fillings: dict[Hashable, Filling] = {}  # by that and the key of an object's grids
        self._override = context.depsgraph.view_layer_eval.material_override

    def slots(
        self, slot_materials: list[bpy.types.Material | None], user: bpy.types.Object
    ) -> tuple[tuple[int, ...], frozenset[str]]:
        """One id per slot, at least one, and the attributes that they read. user: the object to name in reports."""
        slots = [self._exported(self._override or material, user) for material in slot_materials or [None]]
        return tuple(slot.id for slot in slots), frozenset().union(*(slot.attributes for slot in slots))

    def filling(
        self, slot_materials: list[bpy.types.Material | None], user: bpy.types.Object, grids: Grids
    ) -> Filling | None:
        """What the first of the materials that has a volume makes of an object's grids; None where none has.

        As in Cycles, an object without a material is filled only if it is a Volume.
        """
        materials = [self._override] if self._override else [each for each in slot_materials if each is not None]
        material = next((each for each in materials if _volume_input(each) is not None), None)
        if material is None and (materials or user.type != "VOLUME"):
            return None
        key = (material.as_pointer() if material else 0, grids.key)
        if key not in self._fillings:
            owner = self._owner(material, user)
            target = material and _volume_input(material)
            volume = node_volume(target, owner, grids.has) if target else default_volume(owner.program)
            medium = core_medium(self._context.core, volume, owner, grids, _phase(material))
            name = f"{material.name if material else 'none'} in {user.name}"
            nothing = Surface.of(owner.program).core_shader(self._context.core)
            id_ = self._context.scene.add_material(name, nothing, medium=medium, has_surface=False)
            self._fillings[key] = Filling(id_, grids.lattice(volume.grid_names))
        return self._fillings[key]

    def _exported(self, material: bpy.types.Material | None, user: bpy.types.Object) -> _Exported:
        key = material.as_pointer() if material else 0
        if key not in self._materials:
            owner = self._owner(material, user)
            has_surface = material is None or _volume_input(material) is None or _has_surface(material)
            surface = _surface(material, owner) if has_surface else Surface.of(owner.program)
            if material is not None and has_surface:
                surface = with_ndf(surface, material, owner, self._context)
            self._warn_of_emission(surface, owner)
            with naming(owner.name, "give its colours and numbers finite values"):
                shader = surface.core_shader(self._context.core)
            medium = self._medium(material, user)
            name = material.name if material else "none"
            id_ = self._context.scene.add_material(name, shader, medium=medium, has_surface=has_surface)
            self._materials[key] = _Exported(id_, frozenset(owner.program.attributes))
        return self._materials[key]

    def _medium(self, material: bpy.types.Material | None, user: bpy.types.Object) -> Any:
        """What meshes of a material are full of; None: nothing."""
        target = material and _volume_input(material)
        if not target:
            return None
        owner = self._owner(material, user)  # with a program of its own: what it reads are no attributes of meshes
        return core_medium(self._context.core, node_volume(target, owner), owner, NO_GRIDS, _phase(material))

    def _owner(self, material: bpy.types.Material | None, user: bpy.types.Object) -> Owner:
        where = f"object '{user.name}', material '{material.name if material else 'none'}'"
        program = Program(self._context.core, self._context.scene, self._context.images)
        return Owner(where, self._context.reporter, program, material)

    def _warn_of_emission(self, surface: Surface, owner: Owner) -> None:
        if self._context.depsgraph.scene_eval.pivot.integrator == "ANALYTIC" and not surface.emission.is_always(0):
            self._context.reporter.warn(
                f"{owner.name}: in the analytic integrator its emission is shown, but lights nothing. "
                "Fix: use Monte Carlo"
            )


def _volume_input(material: bpy.types.Material) -> Any:
    """The Volume input of its nodes that something is linked to, None without."""
    tree = active_tree(material)
    return None if tree is None else output_volume(tree)


def _has_surface(material: bpy.types.Material) -> bool:
    """Of one whose nodes have an output."""
    return output_socket(active_tree(material), "Surface").socket.is_linked


def _phase(material: bpy.types.Material | None) -> str:
    return material.pivot.phase if material else "HENYEY_GREENSTEIN"


def _surface(material: bpy.types.Material | None, owner: Owner) -> Surface:
    if material is None:
        return grey(owner.program)
    tree = active_tree(material)
    if tree is None:
        return Surface.of(owner.program, diffuse=owner.program.colour(material.diffuse_color[:3]))  # as Cycles has it
    return material_surface(tree, owner)
