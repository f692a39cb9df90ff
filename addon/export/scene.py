"""The depsgraph as one of the core's scenes: each evaluated mesh once, and its instances in bulk."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable
from dataclasses import dataclass
from types import ModuleType

import bpy
import numpy as np
from numpy.typing import NDArray

from ..report import RenderError, Reporter, naming
from .census import report_left_out
from .context import Context
from .light import export_light
from .material import MaterialTable
from .mesh import MeshArrays, edits_applied, mesh_arrays
from .world import export_world

# Curves, texts, surfaces and metaballs need no word: what they look like comes as an instance of type MESH beside them.
_UNSUPPORTED = {"CURVES", "POINTCLOUD", "VOLUME", "GPENCIL", "GREASEPENCIL"}


@dataclass(frozen=True)
class _Group:
    """Instances that differ in nothing but their transform."""

    name: str  # of the Blender object
    mesh: int
    materials: tuple[int, ...]
    camera_visible: bool


def export_scene(
    core: ModuleType,
    depsgraph: bpy.types.Depsgraph,
    reporter: Reporter,
    check_cancel: Callable[[], None],
) -> Context:
    """Fill a new scene with the view layer's meshes, materials, lights and world; the camera is not set.

    check_cancel: called between objects, may raise. Keeps nothing of the depsgraph but in the Context returned.
    Raises RenderError naming the object at fault.
    """
    context = Context(core, core.Scene(), depsgraph, reporter)
    _report_settings(context)
    export_world(context)
    _Exporter(context, check_cancel).export_objects()
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
    def __init__(self, context: Context, check_cancel: Callable[[], None]) -> None:
        self._context = context
        self._check_cancel = check_cancel
        self._materials = MaterialTable(context)
        self._meshes: dict[int, int | None] = {}  # by the address of the evaluated data; None: no triangles
        self._groups: dict[tuple[int, int], _Group | None] = {}  # by the original object and the evaluated data
        self._instances: defaultdict[_Group, list[int]] = defaultdict(list)

    def export_objects(self) -> None:
        instances = self._context.depsgraph.object_instances
        matrices = np.empty(len(instances) * 16, np.float32)
        instances.foreach_get("matrix_world", matrices)
        object_to_world = matrices.reshape(-1, 4, 4).transpose(0, 2, 1)  # Blender's columns come first
        surfaces = self._context.depsgraph.view_layer_eval.use_solid
        for index, instance in enumerate(instances):
            if not instance.show_self:
                continue
            blender_object = instance.object
            if blender_object.type == "LIGHT":
                export_light(self._context, blender_object, object_to_world[index].astype(np.float64))
            elif surfaces and blender_object.type == "MESH":
                group = self._group(blender_object)
                if group is not None:
                    self._instances[group].append(index)
            elif surfaces and blender_object.type in _UNSUPPORTED:
                kind = blender_object.bl_rna.properties["type"].enum_items[blender_object.type].name
                self._warn(blender_object, f"{kind} objects are not supported and left out")
        for group, indices in self._instances.items():
            self._add_instances(group, object_to_world[indices])

    def _group(self, blender_object: bpy.types.Object) -> _Group | None:
        """What a mesh object shares with its like; None where there is nothing to see."""
        key = (blender_object.original.as_pointer(), blender_object.data.as_pointer())
        if key not in self._groups:
            self._check_cancel()
            self._groups[key] = self._make_group(blender_object)
        return self._groups[key]

    def _make_group(self, blender_object: bpy.types.Object) -> _Group | None:
        mesh = self._mesh(blender_object)
        if mesh is None:
            return None
        report_left_out(blender_object, f"object '{blender_object.name}'", self._context.reporter)
        slot_materials = [slot.material for slot in blender_object.material_slots]
        return _Group(
            name=blender_object.name,
            mesh=mesh,
            materials=self._materials.slots(slot_materials, blender_object),
            camera_visible=blender_object.visible_camera,
        )

    def _mesh(self, blender_object: bpy.types.Object) -> int | None:
        """The core's mesh of an object's evaluated mesh."""
        key = blender_object.data.as_pointer()
        if key not in self._meshes:
            with edits_applied(blender_object) as mesh:
                arrays = mesh_arrays(mesh)
            self._meshes[key] = self._add_mesh(blender_object.name, arrays)
        return self._meshes[key]

    def _add_mesh(self, name: str, arrays: MeshArrays | None) -> int | None:
        if arrays is None:
            return None
        fix = "correct these vertices in Edit Mode, or the modifier, shape key or driver that makes them"
        with naming(f"object '{name}'", fix):
            return self._context.scene.add_mesh(name, **vars(arrays))

    def _add_instances(self, group: _Group, object_to_world: NDArray[np.float32]) -> None:
        if not np.isfinite(object_to_world).all():
            raise RenderError(
                f"object '{group.name}': its transform is not finite. Fix: check its location, rotation, scale, "
                "drivers and constraints"
            )
        self._context.scene.add_instances(
            group.name,
            group.mesh,
            np.ascontiguousarray(object_to_world),
            group.materials,
            camera_visible=group.camera_visible,
        )

    def _warn(self, blender_object: bpy.types.Object, text: str) -> None:
        self._context.reporter.warn(f"object '{blender_object.name}': {text}")
