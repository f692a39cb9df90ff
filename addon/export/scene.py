"""The depsgraph as one of the core's scenes: each evaluated mesh once, and its instances in bulk."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable
from dataclasses import replace
from types import ModuleType
from typing import Any

import bpy
import numpy as np
from numpy.typing import NDArray

from ..report import RenderError, Reporter
from .attributes import is_of_mesh, object_attributes
from .census import report_left_out
from .context import Context
from .groups import Group, GroupMaker
from .images import ImageCache, ImageTable
from .instance_attributes import CAN_READ, InstanceAttributes
from .instances import Instances, particle_numbers
from .light import export_light
from .light_groups import light_group
from .light_links import LightLinks
from .material import MaterialTable
from .mesh_cache import MeshCache
from .visibility import Visible, visible
from .world import export_world

# Old curves, texts, surfaces and metaballs need no word: what they look like comes as an instance of type MESH.
_UNSUPPORTED = {"GPENCIL", "GREASEPENCIL"}


def _is_shown_as_curves(blender_object: bpy.types.Object, layer: bpy.types.ViewLayer) -> bool:
    return (
        layer.use_strand if blender_object.type == "CURVES" else layer.use_solid and blender_object.type == "POINTCLOUD"
    )


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


_MakeGroups = Callable[[bpy.types.Object, Instances, int], list[Group]]
_Way = tuple[InstanceAttributes, tuple[int, ...]] | None  # to what an instance has of its own; None: an object itself
_Particle = dict[str, tuple[float, ...]]  # what Particle Info tells
# Of a group: the indices of its instances, and of each what its materials ask for; None: they do not.
_List = tuple[list[int], list[_Particle] | None, list[_Way] | None, frozenset[str]]


def _names(group: Group, kind: str) -> frozenset[str]:
    """The attributes of a kind that its materials ask for: within it, as `attributes` has them."""
    return frozenset(name.removeprefix(f"{kind}:") for name in group.reads if name.startswith(f"{kind}:")) - {""}


class _Exporter:
    def __init__(
        self, context: Context, check_cancel: Callable[[], None], world_shines: bool, meshes: MeshCache | None
    ) -> None:
        self._context = context
        self._check_cancel = check_cancel
        self._frame = context.depsgraph.scene_eval.frame_current_final
        self._links = LightLinks.read(context.depsgraph, context.reporter)
        self._makes = GroupMaker(context, check_cancel, MaterialTable(context, world_shines), meshes)
        self._of_objects: dict[tuple[int, int], dict[str, Any]] = {}  # by the original object and its instancer
        self._groups: dict[tuple[Any, ...], list[Group]] = {}  # by the original object and the evaluated data
        self._instances: defaultdict[Group, list[int]] = defaultdict(list)
        self._particles: defaultdict[Group, list[_Particle]] = defaultdict(list)
        self._ways: defaultdict[Group, list[_Way]] = defaultdict(list)
        self._of_instancers: dict[int, InstanceAttributes] = {}  # by the instancer's address
        # By the same and the instancer: where its instances are listed, so that each is only looked up.
        self._lists: dict[tuple[Any, ...], list[_List]] = {}

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
                self._place(self._makes.strand_groups, blender_object, instance, told, index)
            if not instance.show_self:
                continue
            if blender_object.type == "LIGHT":
                place = told.object_to_world[index].astype(np.float64)
                seen, links = self._visible(blender_object, instancer), self._links.masks(blender_object)
                export_light(self._context, blender_object, place, seen, links)
            elif layer.use_solid and blender_object.type == "MESH":
                self._place(self._makes.mesh_groups, blender_object, instance, told, index)
            elif _is_shown_as_curves(blender_object, layer):
                self._place(self._makes.curve_object_groups, blender_object, instance, told, index)
            elif layer.use_volumes and blender_object.type == "VOLUME":
                of_object = self._of_object(blender_object, instancer)
                for of_any in self._makes.volume_groups(blender_object, told, index):
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
        """What a Group has of the object and its instancer, whatever its mesh."""
        key = (blender_object.original.as_pointer(), instancer.original.as_pointer() if instancer else 0)
        if key not in self._of_objects:
            self._of_objects[key] = {
                "visible": self._visible(blender_object, instancer),
                "light_group": light_group(self._context.depsgraph.view_layer, blender_object, instancer),
                "links": self._links.masks(blender_object),
                "link_sets": self._links.sets(instancer or blender_object),
            }
        return self._of_objects[key]

    def _visible(self, blender_object: bpy.types.Object, instancer: bpy.types.Object | None) -> Visible:
        found = visible(blender_object, instancer, self._context.depsgraph.view_layer)
        pivot = self._context.depsgraph.scene_eval.pivot
        by_virtual_lights = pivot.integrator == "ANALYTIC" and pivot.indirect == "VSGL"
        if by_virtual_lights and blender_object.type == "MESH":
            for ray, what in (("DIFFUSE", "none"), ("GLOSSY", "all")):
                if ray in found.hidden_from:
                    text = f"in the analytic integrator light that comes by way of it lights {what}"
                    self._warn(blender_object, f"{text}. Fix: use Monte Carlo")
                    break
        return found

    def _place(
        self, make: _MakeGroups, blender_object: bpy.types.Object, instance: Any, told: Instances, index: int
    ) -> None:
        """Add an instance of what an object looks like. make: what that is, called once."""
        instancer = instance.parent if instance.is_instance else None
        of_any = make.__name__, blender_object.original.as_pointer(), blender_object.data.as_pointer()
        key = *of_any, instancer.original.as_pointer() if instancer else 0
        lists = self._lists.get(key)
        if lists is None:
            lists = self._lists[key] = [
                (
                    self._instances[group],
                    self._particles[group] if "particle:" in group.reads else None,
                    self._ways[group] if CAN_READ and _names(group, "instancer") else None,
                    _names(group, "particle"),
                )
                for group in self._groups_of(make, of_any, blender_object, instancer, told, index)
            ]
        for indices, particles, ways, of_particles in lists:
            indices.append(index)
            if particles is not None:
                particles.append(particle_numbers(instance, of_particles, self._frame))
            if ways is not None:
                ways.append(self._way(instance, instancer))

    def _way(self, instance: Any, instancer: bpy.types.Object | None) -> _Way:
        if instancer is None:
            return None
        key = instancer.as_pointer()
        if key not in self._of_instancers:
            self._of_instancers[key] = InstanceAttributes(instancer, self._context.depsgraph)
        return self._of_instancers[key], tuple(instance.persistent_id)

    def _groups_of(
        self,
        make: _MakeGroups,
        key: tuple[Any, ...],
        blender_object: bpy.types.Object,
        instancer: bpy.types.Object | None,
        told: Instances,
        index: int,
    ) -> list[Group]:
        """What an object is there: none where there is nothing to see, one for each part. key: of it anywhere."""
        if key not in self._groups:
            self._check_cancel()
            self._groups[key] = make(blender_object, told, index)
        groups = self._groups[key]
        if not groups:
            return []
        # Blender gives an instance the colour of its instancer.
        there = self._of_object(blender_object, instancer) | {"color": tuple(blender_object.color)}
        reads = frozenset().union(*(group.reads for group in groups))
        if not all(is_of_mesh(name) for name in reads):
            attributes = object_attributes(reads, blender_object, instancer, self._context.depsgraph)
            there = there | {"attributes": tuple(attributes.items())}
            for group in groups if instancer and not CAN_READ else ():
                self._report_unreadable(_names(group, "instancer"), attributes, instancer)
        return [replace(group, **there) for group in groups]

    def _add_instances(self, group: Group, indices: list[int], told: Instances) -> None:
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
            holdout=group.visible.is_holdout or group.is_holdout,
            light_group=group.light_group,
            links=group.links,
            link_sets=group.link_sets,
            shadow_catcher=group.is_shadow_catcher,
            matte=group.matte,
            color=group.color,
            pass_index=group.pass_index,
            random=told.random_of(group.name, indices),
            particle_index=self._of_particles(group, "Index")[:, 0] if "particle:" in group.reads else None,
            generated=told.generated[indices],
            uv=told.uv[indices],
            attributes=dict(group.attributes),
            own_attributes=self._own_attributes(group),
        )
        self._context.placed.instances.append((indices, first))
        if group.is_filled:
            self._context.placed.filled.update(indices)
        if group.shines:
            self._context.placed.shining.update(indices)

    def _report_unreadable(self, names: frozenset[str], known: dict[str, Any], instancer: bpy.types.Object) -> None:
        if any(modifier.type == "NODES" for modifier in instancer.modifiers):
            for name in sorted(names):
                if f"instancer:{name}" not in known:
                    text = f"attribute '{name}' of its instances cannot be read in this Blender, it is 0"
                    self._warn(instancer, f"{text}. Fix: realize the instances and read it as Geometry")

    def _own_attributes(self, group: Group) -> dict[str, NDArray[np.float32]]:
        """(N, 4) of the attributes that some of a group's instances have for themselves."""
        result = {f"particle:{name}": self._of_particles(group, name) for name in _names(group, "particle")}
        for name in _names(group, "instancer") if group in self._ways else ():
            values = [None if way is None else way[0].value(name, way[1]) for way in self._ways[group]]
            if any(value is not None for value in values):
                of_all = dict(group.attributes).get(f"instancer:{name}", (0.0,) * 4)
                each = [of_all if value is None else value for value in values]
                result[f"instancer:{name}"] = np.array(each, np.float32)
        return result

    def _of_particles(self, group: Group, name: str) -> NDArray[np.float32]:
        """(N, 4)"""
        return np.array([numbers.get(name, (0.0,) * 4) for numbers in self._particles[group]], np.float32)

    def _warn(self, blender_object: bpy.types.Object, text: str) -> None:
        self._context.reporter.warn(f"object '{blender_object.name}': {text}")
