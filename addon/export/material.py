"""Materials: each of Blender's becomes one of the core's, made when first met.

What fills an object and varies within it is a material of the core's for each such object.
"""

from __future__ import annotations

from collections.abc import Hashable
from dataclasses import dataclass
from typing import Any

import bpy

from ..report import naming
from .aovs import aov_shaders
from .attributes import is_of_mesh
from .baked import Interior, is_placed, reads_place
from .context import Context
from .dielectric import Dielectric
from .grids import Lattice
from .media import core_medium, report_analytic
from .microfacets import with_ndf
from .nodes import Owner, active_tree, output_socket
from .program import Program
from .shader import grey, material_surface
from .surface import Surface
from .volume import Volume, default_volume, node_volume, output_volume

_SMOOTH_ALPHA = 0.01  # as core/integrators/look_rays.h has it


@dataclass(frozen=True)
class Slots:
    """The materials of an object."""

    ids: tuple[int, ...]  # the core's, at least one
    attributes: frozenset[str]  # that they read of their meshes
    without_surface: frozenset[int]  # those whose faces only bound what fills the object
    is_placed: bool  # what fills the object is as its first instance has it
    is_filled: bool = False
    shines: bool = False
    is_holdout: bool = False

    def of_mesh(self) -> frozenset[str]:
        """The attributes that are of meshes and curves."""
        return frozenset(filter(is_of_mesh, self.attributes))

    def ids_without_surface(self) -> tuple[int, ...]:
        """Of faces that all have none: what the other slots have does not count."""
        stand_in = self.ids[min(self.without_surface)]
        return tuple(id_ if slot in self.without_surface else stand_in for slot, id_ in enumerate(self.ids))


@dataclass(frozen=True)
class Filling:
    """What an object is full of, without a surface."""

    id: int  # the core's
    lattice: Lattice | None  # of the grids that it reads; None: none
    is_placed: bool


@dataclass(frozen=True)
class _Look:
    """A material's surface."""

    shader: Any  # the core's
    is_there: bool
    shines: bool
    is_holdout: bool
    attributes: frozenset[str]
    aovs: tuple[tuple[int, Any], ...]  # each by its place and the core's shader that emits its value


class MaterialTable:
    """The core's ids of the materials met so far."""

    def __init__(self, context: Context, world_shines: bool) -> None:
        self._context = context
        self._world_shines = world_shines
        self._looks: dict[int, _Look] = {}  # by the address of the Blender material; 0: none
        self._volumes: dict[Hashable, Volume | None] = {}  # by that and the key of an object's grids
        self._materials: dict[Hashable, int] = {}  # by the material, and the object where what fills it varies
        self._fillings: dict[Hashable, Filling] = {}  # by the material, the grids, and the object likewise
        self._override = context.depsgraph.view_layer_eval.material_override

    def slots(self, slot_materials: list[bpy.types.Material | None], interior: Interior) -> Slots:
        """The materials of an object's slots."""
        materials = [self._override or material for material in slot_materials or [None]]
        looks = [self._look(material, interior.blender_object) for material in materials]
        volumes = [self._volume(material, interior) for material in materials]
        holdouts = [look.is_holdout for look in looks]
        if any(holdouts) and not all(holdouts):
            self._context.reporter.warn(
                f"object '{interior.blender_object.name}': a Holdout is supported where all slots have one, "
                "some faces are black"
            )
        return Slots(
            ids=tuple(self._exported(material, interior) for material in materials),
            attributes=frozenset().union(*(look.attributes for look in looks)),
            without_surface=frozenset(slot for slot, look in enumerate(looks) if not look.is_there),
            is_placed=any(volume is not None and is_placed(volume.program) for volume in volumes),
            is_filled=any(volume is not None for volume in volumes),
            shines=any(look.shines for look in looks),
            is_holdout=all(holdouts),
        )

    def filling(self, slot_materials: list[bpy.types.Material | None], interior: Interior) -> Filling | None:
        """What the first of the materials that has a volume makes of an object's grids; None where none has.

        As in Cycles, an object without a material is filled only if it is a Volume.
        """
        materials = [self._override] if self._override else [each for each in slot_materials if each is not None]
        material = next((each for each in materials if _volume_input(each) is not None), None)
        if material is None and (materials or interior.blender_object.type != "VOLUME"):
            return None
        volume = self._volume(material, interior) or default_volume(self._program())
        key = (_address(material), interior.grids.key, _user_key(interior) if reads_place(volume.program) else None)
        if key not in self._fillings:
            name = f"{material.name if material else 'none'} in {interior.blender_object.name}"
            nothing = Surface.of(self._program()).core_shader(self._context.core)
            medium = self._medium(material, volume, interior)
            id_ = self._context.scene.add_material(name, nothing, medium=medium, has_surface=False)
            lattice = interior.grids.lattice(volume.grid_names)
            self._fillings[key] = Filling(id_, lattice, is_placed(volume.program))
        return self._fillings[key]

    def _exported(self, material: bpy.types.Material | None, interior: Interior) -> int:
        user, volume = interior.blender_object, self._volume(material, interior)
        varies = volume is not None and not volume.is_constant
        key = (_address(material), _user_key(interior) if varies else None)
        if key not in self._materials:
            look = self._look(material, user)
            medium = None if volume is None else self._medium(material, volume, interior)
            name = material.name if material else "none"
            with naming(_where(material, user), "give its colours and numbers finite values"):
                self._materials[key] = id_ = self._context.scene.add_material(
                    f"{name} in {user.name}" if varies else name,
                    look.shader,
                    medium=medium,
                    has_surface=look.is_there,
                    pass_index=material.pass_index if material else 0,
                    filters_shadows=_filters_shadows(material),
                    matte=self._context.mattes.id_of("MATERIAL", material.name if material else "default_surface"),
                )
                for aov, shader in look.aovs:
                    self._context.scene.set_aov(
                        id_, aov, self._context.scene.add_material(f"AOV {aov} of {name}", shader)
                    )
        return self._materials[key]

    def _look(self, material: bpy.types.Material | None, user: bpy.types.Object) -> _Look:
        key = _address(material)
        if key not in self._looks:
            owner = self._owner(material, user)
            is_there = material is None or _volume_input(material) is None or _has_surface(material)
            surface = _surface(material, owner) if is_there else Surface.of(owner.program)
            if material is not None and is_there:
                surface = with_ndf(surface, material, owner, self._context)
            self._warn_of_analytic(surface, owner)
            with naming(owner.name, "give its colours and numbers finite values"):
                shader = surface.core_shader(self._context.core)
                values = self._owner(material, user)  # with a program of its own: few rays ask it
                aovs = self._aovs(material, values)
            attributes = frozenset(owner.program.attributes | values.program.attributes)
            shines = not surface.emission.is_always(0)
            self._looks[key] = _Look(shader, is_there, shines, surface.is_holdout, attributes, aovs)
        return self._looks[key]

    def _aovs(self, material: bpy.types.Material | None, owner: Owner) -> tuple[tuple[int, Any], ...]:
        tree = None if material is None else active_tree(material)
        return () if tree is None else tuple(aov_shaders(tree, owner, self._context.depsgraph.view_layer))

    def _volume(self, material: bpy.types.Material | None, interior: Interior) -> Volume | None:
        """What a material is full of; None: nothing is linked there."""
        key = (_address(material), interior.grids.key)
        if key not in self._volumes:
            target = material and _volume_input(material)
            owner = self._owner(material, interior.blender_object)  # with a program of its own: it reads no mesh
            self._volumes[key] = node_volume(target, owner, interior.grids.has) if target else None
        return self._volumes[key]

    def _medium(self, material: bpy.types.Material | None, volume: Volume, interior: Interior) -> Any:
        phase = material.pivot.phase if material else "HENYEY_GREENSTEIN"
        owner = _where(material, interior.blender_object)
        if self._world_shines:
            report_analytic(self._context, volume, owner)
        return core_medium(self._context, volume, owner, interior, phase)

    def _program(self) -> Program:
        return Program(self._context.core, self._context.scene, self._context.images)

    def _owner(self, material: bpy.types.Material | None, user: bpy.types.Object) -> Owner:
        return Owner(_where(material, user), self._context.reporter, self._program(), material)

    def _warn_of_analytic(self, surface: Surface, owner: Owner) -> None:
        """What the analytic integrator leaves out of a surface."""
        if self._context.depsgraph.scene_eval.pivot.integrator != "ANALYTIC":
            return
        left_out = []
        if not surface.emission.is_constant:
            left_out.append("its triangles light others by a mean of each, in grey")
        if any(_is_frosted(dielectric) for dielectric in surface.dielectrics):
            left_out.append("lamps do not shine through its rough glass")
        if any(not dielectric.film_nm.is_always(0) for dielectric in surface.dielectrics):
            left_out.append("lamps are mirrored by its glass without the thin film")
        if any(lobe.kind == "subsurface" for lobe in surface.lobes):
            left_out.append("what is scattered beneath its surface comes out where it entered, as from a diffuse one")
        for what in left_out:
            self._context.reporter.warn(f"{owner.name}: in the analytic integrator {what}. Fix: use Monte Carlo")


def _is_frosted(dielectric: Dielectric) -> bool:
    """Whether what is behind it is seen by a few rays of a lobe: core/integrators/look_rays.h."""
    alpha = dielectric.alpha
    return not dielectric.transmission.is_always(0) and not (alpha.is_constant and alpha.numbers[0] <= _SMOOTH_ALPHA)


def _volume_input(material: bpy.types.Material) -> Any:
    """The Volume input of its nodes that something is linked to, None without."""
    tree = active_tree(material)
    return None if tree is None else output_volume(tree)


def _has_surface(material: bpy.types.Material) -> bool:
    """Of one whose nodes have an output."""
    return output_socket(active_tree(material), "Surface").socket.is_linked


def _filters_shadows(material: bpy.types.Material | None) -> bool:
    """Blender has Cycles' own switch from 4.2 on."""
    for settings in (material, getattr(material, "cycles", None)):
        if hasattr(settings, "use_transparent_shadow"):
            return bool(settings.use_transparent_shadow)
    return True


def _address(material: bpy.types.Material | None) -> int:
    return material.as_pointer() if material else 0


def _user_key(interior: Interior) -> Hashable:
    """Tells an object and what it is now from others."""
    user = interior.blender_object
    return user.original.as_pointer(), user.data.as_pointer()


def _where(material: bpy.types.Material | None, user: bpy.types.Object) -> str:
    return f"object '{user.name}', material '{material.name if material else 'none'}'"


def _surface(material: bpy.types.Material | None, owner: Owner) -> Surface:
    if material is None:
        return grey(owner.program)
    tree = active_tree(material)
    if tree is None:
        return Surface.of(owner.program, diffuse=owner.program.colour(material.diffuse_color[:3]))  # as Cycles has it
    return material_surface(tree, owner)
