"""What objects look like: meshes, curves and volumes of the core's, and what instances of them have in common."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import bpy

from ..report import naming
from .attributes import UV_OF_PASS, mesh_attributes
from .baked import Interior
from .census import report_left_out
from .context import Context
from .curve_motion import sources_of
from .curves import CurveSource, curve_settings
from .grids import NO_GRIDS, Grids
from .instances import Instances
from .light_groups import NO_GROUP
from .light_links import NO_LINKS
from .material import MaterialTable, Slots
from .mattes import Mattes, asset_name
from .mesh import edits_applied, mesh_arrays
from .mesh_cache import MeshCache
from .smoke import has_smoke, smoke_domain, smoke_grids
from .visibility import Visible
from .volume_object import box_arrays, density_scale, volume_grids


@dataclass(frozen=True)
class Group:
    """Instances that differ in nothing but their transform, and what each has of its own for shaders."""

    name: str  # of the Blender object
    mesh: int
    materials: tuple[int, ...]
    visible: Visible
    light_group: int  # of what shines of it
    links: tuple[int, int]  # of that light: masks of sets
    link_sets: tuple[int, int]  # its own
    is_shadow_catcher: bool
    matte: tuple[float, float]  # ids of the object and its asset
    color: tuple[float, float, float, float]
    pass_index: float
    reads: frozenset[str]  # attributes that its materials ask for
    is_placed: bool  # what fills it is as its first instance has it
    is_filled: bool
    shines: bool
    is_holdout: bool  # whatever the object says
    attributes: tuple[tuple[str, tuple[float, ...]], ...] = ()  # of the object and its instancer


def _group_of(
    blender_object: bpy.types.Object,
    mesh: int,
    materials: tuple[int, ...],
    is_placed: bool,
    mattes: Mattes,
    reads: frozenset[str] = frozenset(),
    is_filled: bool = True,
    shines: bool = False,
    is_holdout: bool = False,
) -> Group:
    matte = mattes.id_of("OBJECT", blender_object.name), mattes.id_of("ASSET", asset_name(blender_object))
    return Group(
        name=blender_object.name,
        mesh=mesh,
        materials=materials,
        visible=Visible(),
        light_group=NO_GROUP,
        links=NO_LINKS,
        link_sets=(0, 0),
        is_shadow_catcher=blender_object.is_shadow_catcher,
        matte=matte,
        color=tuple(blender_object.color),
        pass_index=blender_object.pass_index,
        reads=reads,
        is_placed=is_placed,
        is_filled=is_filled,
        shines=shines,
        is_holdout=is_holdout,
    )


def _interior(
    blender_object: bpy.types.Object, mesh: bpy.types.Mesh | None, told: Instances, index: int, grids: Grids
) -> Interior:
    """As the instance of this index has it."""
    [random] = told.random_of(blender_object.name, [index])
    return Interior(blender_object, mesh, told.object_to_world[index], float(random), grids)


class GroupMaker:
    """Makes the core's meshes of evaluated objects, each once."""

    def __init__(
        self, context: Context, check_cancel: Callable[[], None], materials: MaterialTable, meshes: MeshCache | None
    ) -> None:
        self._context = context
        self._check_cancel = check_cancel
        self._materials = materials
        self._cache = meshes
        # By the evaluated data's address, what is read, and the slots whose faces rays pass.
        self._meshes: dict[tuple[int, frozenset[str], frozenset[int]], list[tuple[int, bool]]] = {}
        self._volumes: dict[tuple[int, int, float], list[Group]] = {}  # by the object, its data and its density

    def mesh_groups(self, blender_object: bpy.types.Object, told: Instances, index: int) -> list[Group]:
        with edits_applied(blender_object) as mesh:
            if not len(mesh.polygons):
                return []
            report_left_out(blender_object, f"object '{blender_object.name}'", self._context.reporter)
            slot_materials = [slot.material for slot in blender_object.material_slots]
            domain = smoke_domain(blender_object)
            grids = NO_GRIDS if domain is None else smoke_grids(blender_object, domain)
            interior = _interior(blender_object, mesh, told, index, grids)
            if domain is not None:
                return self._smoke_groups(interior, domain, slot_materials)
            slots = self._materials.slots(slot_materials, interior)
            parts = self._core_meshes(blender_object, mesh, slots)
            for part, _ in parts:
                self._context.placed.meshes.setdefault(part, index)
            return [
                _group_of(
                    blender_object,
                    part,
                    slots.ids_without_surface() if is_passed else slots.ids,
                    slots.is_placed,
                    self._context.mattes,
                    slots.attributes,
                    slots.is_filled,
                    slots.shines,
                    slots.is_holdout,
                )
                for part, is_passed in parts
            ]

    def strand_groups(self, blender_object: bpy.types.Object, told: Instances, index: int) -> list[Group]:
        is_render = self._context.depsgraph.mode == "RENDER"
        return self._curve_groups(blender_object, sources_of(blender_object, is_render), told, index)

    def curve_object_groups(self, blender_object: bpy.types.Object, told: Instances, index: int) -> list[Group]:
        for described in (blender_object, blender_object.data):
            report_left_out(described, f"object '{blender_object.name}'", self._context.reporter)
        return self.strand_groups(blender_object, told, index)

    def _curve_groups(
        self, blender_object: bpy.types.Object, sources: list[CurveSource], told: Instances, index: int
    ) -> list[Group]:
        """What is made of curves and points of an object: one for each of their sources."""
        if not sources:
            return []
        slot_materials = [slot.material for slot in blender_object.material_slots]
        slots = self._materials.slots(slot_materials, _interior(blender_object, None, told, index, NO_GRIDS))
        groups = []
        for source in sources:
            slot = min(source.slot, len(slots.ids) - 1)
            if slot not in slots.without_surface:
                curves, material = self._core_curves(blender_object, source, slots.of_mesh()), (slots.ids[slot],)
                mattes, attributes = self._context.mattes, slots.attributes
                groups.append(
                    _group_of(
                        blender_object,
                        curves,
                        material,
                        False,
                        mattes,
                        attributes,
                        is_filled=False,
                        is_holdout=slots.is_holdout,
                    )
                )
                self._context.placed.curves.setdefault(curves, (index, source.name))
        return groups

    def _smoke_groups(self, interior: Interior, domain: Any, slot_materials: list[Any]) -> list[Group]:
        """A domain as Cycles has it: its volume within its mesh, and no surface."""
        if not self._context.depsgraph.view_layer_eval.use_volumes:
            return []
        blender_object, frame = interior.blender_object, self._context.depsgraph.scene_eval.frame_current
        if not has_smoke(domain, frame):
            self._warn(
                blender_object,
                f"it has no smoke at frame {frame} and is left out. Fix: bake it, or play it from its start",
            )
            return []
        filling = self._materials.filling(slot_materials, interior)
        if filling is None:
            return []
        slots = Slots((filling.id,), frozenset(), frozenset(), filling.is_placed)
        [(core_mesh, _)] = self._core_meshes(blender_object, interior.mesh, slots)
        return [_group_of(blender_object, core_mesh, slots.ids, slots.is_placed, self._context.mattes)]

    def volume_groups(self, blender_object: bpy.types.Object, told: Instances, index: int) -> list[Group]:
        """The box around a Volume object's grids; none where there is nothing to see."""
        scale = round(density_scale(blender_object.data, told.object_to_world[index]), 6)
        key = (blender_object.original.as_pointer(), blender_object.data.as_pointer(), scale)
        if key not in self._volumes:
            self._check_cancel()
            self._volumes[key] = self._make_volume_groups(blender_object, scale, told, index)
        return self._volumes[key]

    def _make_volume_groups(
        self, blender_object: bpy.types.Object, scale: float, told: Instances, index: int
    ) -> list[Group]:
        name, reporter = f"object '{blender_object.name}'", self._context.reporter
        for described in (blender_object, blender_object.data):
            report_left_out(described, name, reporter)
        grids = volume_grids(blender_object, scale, reporter)
        if grids is None:
            return []
        slot_materials = [slot.material for slot in blender_object.material_slots]
        interior = _interior(blender_object, None, told, index, grids)
        filling = self._materials.filling(slot_materials, interior)
        if filling is None or filling.lattice is None:  # Cycles, too, makes a volume only where it reads a grid
            return []
        mesh = self._context.scene.add_mesh(blender_object.name, **box_arrays(filling.lattice))
        return [_group_of(blender_object, mesh, (filling.id,), filling.is_placed, self._context.mattes)]

    def _core_curves(self, blender_object: bpy.types.Object, source: CurveSource, names: frozenset[str]) -> int:
        name, cache, scene = blender_object.name, self._cache, self._context.scene
        settings = curve_settings(self._context.depsgraph.scene_eval) | source.settings

        def add() -> list[tuple[int, bool]]:
            with naming(f"object '{name}'", "correct these points, or what makes them"):
                return [(scene.add_curves(name, **vars(source.read(names)), **settings), False)]

        how = (source.name, names, *settings.values())
        [(curves, _)] = add() if cache is None else cache.take(scene, blender_object, how, source.state, add)
        return curves

    def _core_meshes(
        self, blender_object: bpy.types.Object, mesh: bpy.types.Mesh, slots: Slots
    ) -> list[tuple[int, bool]]:
        """The core's mesh of an object's evaluated mesh, and whether rays pass it: in two where they pass some faces.

        The core lets rays pass all of an instance's faces or none. mesh: that, with what is edited in Edit Mode.
        """
        names, last_slot = slots.of_mesh(), len(slots.ids) - 1
        if self._context.depsgraph.view_layer.use_pass_uv:
            names |= {UV_OF_PASS}
        key = (blender_object.data.as_pointer(), names, slots.without_surface)

        def add() -> list[tuple[int, bool]]:
            fix = "correct these vertices in Edit Mode, or the modifier, shape key or driver that makes them"
            with naming(f"object '{blender_object.name}'", fix):
                arrays = mesh_arrays(mesh)
                attributes = vars(mesh_attributes(mesh, arrays, names))
                return [
                    (self._context.scene.add_mesh(blender_object.name, **vars(part), **attributes), is_passed)
                    for part, is_passed in arrays.parted(slots.without_surface, last_slot)
                ]

        if key not in self._meshes:
            how = (names, slots.without_surface, last_slot if slots.without_surface else None)
            cache, scene = self._cache, self._context.scene
            state = len(mesh.vertices), len(mesh.loops), len(mesh.polygons)
            self._meshes[key] = add() if cache is None else cache.take(scene, blender_object, how, state, add)
        return self._meshes[key]

    def _warn(self, blender_object: bpy.types.Object, text: str) -> None:
        self._context.reporter.warn(f"object '{blender_object.name}': {text}")
