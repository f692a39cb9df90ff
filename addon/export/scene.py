"""The depsgraph as one of the core's scenes: each evaluated mesh once, and its instances in bulk."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable
from dataclasses import dataclass, replace
from types import ModuleType
from typing import Any

import bpy
import numpy as np

from ..report import RenderError, Reporter, naming
from .attributes import UV_OF_PASS, is_of_mesh, mesh_attributes, object_attributes
from .baked import Interior
from .census import report_left_out
from .context import Context
from .curves import CurveSource, curve_settings, curve_source
from .grids import NO_GRIDS, Grids
from .images import ImageCache, ImageTable
from .instances import Instances, particle_index
from .light import export_light
from .light_groups import NO_GROUP, light_group
from .light_links import NO_LINKS, LightLinks
from .material import MaterialTable, Slots
from .mattes import Mattes, asset_name
from .mesh import edits_applied, mesh_arrays
from .mesh_cache import MeshCache
from .smoke import has_smoke, smoke_domain, smoke_grids
from .strands import strand_sources
from .visibility import Visible, visible
from .volume_object import box_arrays, density_scale, volume_grids
from .world import export_world

# Old curves, texts, surfaces and metaballs need no word: what they look like comes as an instance of type MESH.
_UNSUPPORTED = {"GPENCIL", "GREASEPENCIL"}


@dataclass(frozen=True)
class _Group:
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
    attributes: tuple[tuple[str, tuple[float, ...]], ...] = ()  # of the object and its instancer


_MakeGroups = Callable[[bpy.types.Object, Instances, int], list[_Group]]


def _group_of(
    blender_object: bpy.types.Object,
    mesh: int,
    materials: tuple[int, ...],
    is_placed: bool,
    mattes: Mattes,
    reads: frozenset[str] = frozenset(),
    is_filled: bool = True,
    shines: bool = False,
) -> _Group:
    matte = mattes.id_of("OBJECT", blender_object.name), mattes.id_of("ASSET", asset_name(blender_object))
    return _Group(
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
    )


def _is_shown_as_curves(blender_object: bpy.types.Object, layer: bpy.types.ViewLayer) -> bool:
    return (
        layer.use_strand if blender_object.type == "CURVES" else layer.use_solid and blender_object.type == "POINTCLOUD"
    )


def _interior(
    blender_object: bpy.types.Object, mesh: bpy.types.Mesh | None, told: Instances, index: int, grids: Grids
) -> Interior:
    """As the instance of this index has it."""
    [random] = told.random_of(blender_object.name, [index])
    return Interior(blender_object, mesh, told.object_to_world[index], float(random), grids)


def export_scene(
    core: ModuleType,
    depsgraph: bpy.types.Depsgraph,
    reporter: Reporter,
    check_cancel: Callable[[], None],
    cache: ImageCache | None = None,
    meshes: MeshCache | None = None,
    is_shown: Callable[[bpy.types.Object], bool] | None = None,
    frame: int | None = None,
) -> Context:
    """Fill a new scene with the view layer's meshes, materials, lights and world; the camera is not set.

    check_cancel: called between objects, may raise. cache, meshes: of exports before and to come. is_shown: of an
    evaluated object; None: all are. frame: that image sequences show; None: the depsgraph's. Keeps nothing of the
    depsgraph but in the Context returned. Raises RenderError naming the object at fault.
    """
    shown = depsgraph.scene_eval.frame_current if frame is None else frame
    images = ImageTable(core, shown, cache or ImageCache())
    scene = core.Scene() if meshes is None else core.Scene(meshes.shared)
    context = Context(core, scene, depsgraph, reporter, images)
    _report_settings(context)
    world_shines = export_world(context)
    _Exporter(context, check_cancel, world_shines, meshes).export_objects(is_shown)
    return context


def _report_settings(context: Context) -> None:
    """Say what is left out of the scene's and the view layer's settings."""
    scene, view_layer = context.depsgraph.scene_eval, context.depsgraph.view_layer
    report_left_out(scene, f"scene '{scene.name}'", context.reporter)
    report_left_out(view_layer, f"view layer '{view_layer.name}'", context.reporter)
    _report_collections(view_layer.layer_collection, context.reporter)


def _report_collections(parent: bpy.types.LayerCollection, reporter: Reporter) -> None:
    for collection in parent.children:
        if not collection.exclude and collection.collection.all_objects:
            report_left_out(collection, f"collection '{collection.name}'", reporter)
            _report_collections(collection, reporter)


class _Exporter:
    def __init__(
        self, context: Context, check_cancel: Callable[[], None], world_shines: bool, meshes: MeshCache | None
    ) -> None:
        self._context = context
        self._cache = meshes
        self._check_cancel = check_cancel
        self._links = LightLinks.read(context.depsgraph, context.reporter)
        self._materials = MaterialTable(context, world_shines)
        # By the evaluated data's address, what is read, and the slots whose faces rays pass.
        self._meshes: dict[tuple[int, frozenset[str], frozenset[int]], list[tuple[int, bool]]] = {}
        self._visibles: dict[tuple[int, int], Visible] = {}  # by the original object and its instancer
        self._groups: dict[tuple[Any, ...], list[_Group]] = {}  # by the original object and the evaluated data
        self._instances: defaultdict[_Group, list[int]] = defaultdict(list)
        self._particles: defaultdict[_Group, list[int]] = defaultdict(list)

    def export_objects(self, is_shown: Callable[[bpy.types.Object], bool] | None) -> None:
        instances = self._context.depsgraph.object_instances
        told = Instances.read(instances)
        layer = self._context.depsgraph.view_layer_eval
        for index, instance in enumerate(instances):
            blender_object = instance.object
            instancer = instance.parent if instance.is_instance else None
            if not (is_shown is None or is_shown(blender_object)):
                continue
            if instance.show_particles and layer.use_strand:
                self._place(self._strand_groups, blender_object, instance, told, index)
            if not instance.show_self:
                continue
            if blender_object.type == "LIGHT":
                place = told.object_to_world[index].astype(np.float64)
                seen, links = self._visible(blender_object, instancer), self._links.masks(blender_object)
                export_light(self._context, blender_object, place, seen, links)
                self._warn_of_links(blender_object, links)
            elif layer.use_solid and blender_object.type == "MESH":
                self._place(self._make_mesh_groups, blender_object, instance, told, index)
            elif _is_shown_as_curves(blender_object, layer):
                self._place(self._curve_object_groups, blender_object, instance, told, index)
            elif layer.use_volumes and blender_object.type == "VOLUME":
                of_object = self._of_object(blender_object, instancer)
                for of_any in self._volume_groups(blender_object, told, index):
                    self._instances[replace(of_any, **of_object)].append(index)
            elif layer.use_solid and blender_object.type in _UNSUPPORTED:
                kind = blender_object.bl_rna.properties["type"].enum_items[blender_object.type].name
                self._warn(blender_object, f"{kind} objects are not supported and left out")
        for group, indices in self._instances.items():
            if group.is_placed and len(indices) > 1:
                self._context.reporter.warn(
                    f"object '{group.name}': its volume depends on where it is, its instances are filled as the first"
                )
            self._add_instances(group, indices, told)

    def _of_object(self, blender_object: bpy.types.Object, instancer: bpy.types.Object | None) -> dict[str, Any]:
        """What a _Group has of the object and its instancer, whatever its mesh."""
        links = self._links.masks(blender_object)
        self._warn_of_links(blender_object, links)
        return {
            "visible": self._visible(blender_object, instancer),
            "light_group": light_group(self._context.depsgraph.view_layer, blender_object, instancer),
            "links": links,
            "link_sets": self._links.sets(instancer or blender_object),
        }

    def _warn_of_links(self, blender_object: bpy.types.Object, links: tuple[int, int]) -> None:
        if links != NO_LINKS and self._context.depsgraph.scene_eval.pivot.integrator == "ANALYTIC":
            kind = "light" if blender_object.type == "LIGHT" else "object"
            self._context.reporter.warn(
                f"{kind} '{blender_object.name}': in the analytic integrator it lights everything, and everything "
                "casts its shadows. Fix: use Monte Carlo"
            )

    def _visible(self, blender_object: bpy.types.Object, instancer: bpy.types.Object | None) -> Visible:
        key = (blender_object.original.as_pointer(), instancer.original.as_pointer() if instancer else 0)
        if key not in self._visibles:
            self._visibles[key] = found = visible(blender_object, instancer, self._context.depsgraph.view_layer)
            is_analytic = self._context.depsgraph.scene_eval.pivot.integrator == "ANALYTIC"
            if is_analytic and blender_object.type == "MESH" and {"DIFFUSE", "GLOSSY"} & set(found.hidden_from):
                self._warn(
                    blender_object, "in the analytic integrator what comes from it lights all. Fix: use Monte Carlo"
                )
        return self._visibles[key]

    def _place(
        self, make: _MakeGroups, blender_object: bpy.types.Object, instance: Any, told: Instances, index: int
    ) -> None:
        """Add an instance of what an object looks like. make: what that is, called once."""
        groups = self._groups_of(make, blender_object, instance, told, index)
        if not groups:
            return
        of_object = self._of_object(blender_object, instance.parent if instance.is_instance else None)
        for of_any in groups:
            group = replace(of_any, **of_object)
            self._instances[group].append(index)
            if "particle:" in group.reads:
                self._particles[group].append(particle_index(instance))

    def _groups_of(
        self, make: _MakeGroups, blender_object: bpy.types.Object, instance: Any, told: Instances, index: int
    ) -> list[_Group]:
        """What an object shares with its like: none where there is nothing to see, one for each part of it."""
        key = (make.__name__, blender_object.original.as_pointer(), blender_object.data.as_pointer())
        if key not in self._groups:
            self._check_cancel()
            self._groups[key] = make(blender_object, told, index)
        groups = self._groups[key]
        reads = frozenset().union(*(group.reads for group in groups))
        if all(is_of_mesh(name) for name in reads):
            return groups
        instancer = instance.parent if instance.is_instance else None
        attributes = object_attributes(reads, blender_object, instancer, self._context.depsgraph)
        return [replace(group, attributes=tuple(attributes.items())) for group in groups]

    def _make_mesh_groups(self, blender_object: bpy.types.Object, told: Instances, index: int) -> list[_Group]:
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
                )
                for part, is_passed in parts
            ]

    def _strand_groups(self, blender_object: bpy.types.Object, told: Instances, index: int) -> list[_Group]:
        is_render = self._context.depsgraph.mode == "RENDER"
        return self._curve_groups(blender_object, strand_sources(blender_object, is_render), told, index)

    def _curve_object_groups(self, blender_object: bpy.types.Object, told: Instances, index: int) -> list[_Group]:
        for described in (blender_object, blender_object.data):
            report_left_out(described, f"object '{blender_object.name}'", self._context.reporter)
        return self._curve_groups(blender_object, [curve_source(blender_object.data)], told, index)

    def _curve_groups(
        self, blender_object: bpy.types.Object, sources: list[CurveSource], told: Instances, index: int
    ) -> list[_Group]:
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
                groups.append(_group_of(blender_object, curves, material, False, mattes, attributes, is_filled=False))
        self._context.placed.with_curves.add(blender_object.original.as_pointer())
        return groups

    def _core_curves(self, blender_object: bpy.types.Object, source: CurveSource, names: frozenset[str]) -> int:
        name, cache, scene = blender_object.name, self._cache, self._context.scene
        settings = curve_settings(self._context.depsgraph.scene_eval) | source.settings

        def add() -> list[tuple[int, bool]]:
            with naming(f"object '{name}'", "correct these points, or what makes them"):
                return [(scene.add_curves(name, **vars(source.read(names)), **settings), False)]

        how = (source.name, names, *settings.values())
        [(curves, _)] = add() if cache is None else cache.take(scene, blender_object, how, source.state, add)
        return curves

    def _smoke_groups(self, interior: Interior, domain: Any, slot_materials: list[Any]) -> list[_Group]:
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

    def _volume_groups(self, blender_object: bpy.types.Object, told: Instances, index: int) -> list[_Group]:
        """The box around a Volume object's grids; none where there is nothing to see."""
        scale = round(density_scale(blender_object.data, told.object_to_world[index]), 6)
        key = (blender_object.original.as_pointer(), blender_object.data.as_pointer(), scale)
        if key not in self._groups:
            self._check_cancel()
            self._groups[key] = self._make_volume_groups(blender_object, scale, told, index)
        return self._groups[key]

    def _make_volume_groups(
        self, blender_object: bpy.types.Object, scale: float, told: Instances, index: int
    ) -> list[_Group]:
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

    def _add_instances(self, group: _Group, indices: list[int], told: Instances) -> None:
        object_to_world = told.object_to_world[indices]
        if not np.isfinite(object_to_world).all():
            raise RenderError(
                f"object '{group.name}': its transform is not finite. Fix: check its location, rotation, scale, "
                "drivers and constraints"
            )
        first = self._context.scene.add_instances(
            group.name,
            group.mesh,
            np.ascontiguousarray(object_to_world),
            group.materials,
            hidden_from=list(group.visible.hidden_from),
            holdout=group.visible.is_holdout,
            light_group=group.light_group,
            links=group.links,
            link_sets=group.link_sets,
            shadow_catcher=group.is_shadow_catcher,
            matte=group.matte,
            color=group.color,
            pass_index=group.pass_index,
            random=told.random_of(group.name, indices),
            particle_index=np.array(self._particles[group], np.float32) if "particle:" in group.reads else None,
            generated=told.generated[indices],
            uv=told.uv[indices],
            attributes=dict(group.attributes),
        )
        self._context.placed.instances.append((indices, first))
        if group.is_filled:
            self._context.placed.filled.update(indices)
        if group.shines:
            self._context.placed.shining.update(indices)

    def _warn(self, blender_object: bpy.types.Object, text: str) -> None:
        self._context.reporter.warn(f"object '{blender_object.name}': {text}")
