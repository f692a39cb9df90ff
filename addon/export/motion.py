"""What changes while the camera's shutter is open: where objects and the camera are, and how meshes deform.

The Vector pass is made of the same, from the frame before to the frame after, where pictures are sharp.

As in Cycles, lamps and what fills objects stay as they are in the middle of that.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

import bpy
import numpy as np
from numpy.typing import NDArray

from .camera import CameraMotion, active_camera, camera_place
from .context import Context
from .curve_motion import CurveMotion
from .instances import Instances
from .mesh import MeshArrays, edits_applied, mesh_arrays, positions

_CURVE_SIZE = 257
_MIDDLE = 0.5

Key = tuple[int, int, tuple[int, ...]]


@dataclass(frozen=True)
class Shutter:
    """Times run from 0, where it opens, to 1."""

    middle: float  # frames
    length: float  # frames
    openness: list[float] | None = None  # at even times; None: all the time
    blurs: bool = True  # False: the picture is of the middle, and the rest for the Vector pass

    def frame_at(self, time: float) -> tuple[int, float]:
        """The frame, and the part of one after it."""
        frame = self.middle + (time - _MIDDLE) * self.length
        whole = math.floor(frame)
        return whole, frame - whole


def shutter_of(scene: bpy.types.Scene, view_layer: bpy.types.ViewLayer) -> Shutter | None:
    """None where nobody asks what moves."""
    render, middle = scene.render, scene.frame_current + scene.frame_subframe
    if not (render.use_motion_blur and view_layer.use_motion_blur):
        return Shutter(middle, 2.0, blurs=False) if view_layer.use_pass_vector else None
    length = render.motion_blur_shutter
    if length <= 0:
        return None
    if hasattr(render, "motion_blur_position"):  # from Blender 4.1
        position = render.motion_blur_position
    else:
        position = scene.cycles.motion_blur_position if hasattr(scene, "cycles") else "CENTER"
    middle += {"START": length / 2, "CENTER": 0.0, "END": -length / 2}[position]
    mapping = render.motion_blur_shutter_curve
    mapping.initialize()
    curve = mapping.curves[0]
    openness = [max(float(mapping.evaluate(curve, x)), 0.0) for x in np.linspace(0, 1, _CURVE_SIZE)]
    return Shutter(middle, length, None if min(openness) == max(openness) else openness)


@dataclass(frozen=True)
class _Wish:
    """How closely an object is looked at."""

    steps: int  # at even times; 0: at none
    deforms: bool


def _wish_of(shutter: Shutter, blender_object: bpy.types.Object, instancer: bpy.types.Object | None) -> _Wish:
    """[Cycles 4.5 blender/util.h, object_motion_steps]"""
    if not shutter.blurs:
        return _Wish(3, True)
    settings = [each.cycles for each in (blender_object, instancer) if each is not None and hasattr(each, "cycles")]
    if not all(each.use_motion_blur for each in settings):
        return _Wish(0, False)
    steps = 2 ** max((each.motion_steps for each in settings), default=1) + 1
    return _Wish(steps, all(each.use_deform_motion for each in settings))


def times_of(steps: int) -> list[float]:
    return [step / (steps - 1) for step in range(steps)]


@contextmanager
def in_the_middle(engine: bpy.types.RenderEngine, scene: bpy.types.Scene, shutter: Shutter | None) -> Iterator[None]:
    """The engine's depsgraph in the middle of the shutter's time, and then as before."""
    before = scene.frame_current, scene.frame_subframe
    if shutter is None or shutter.frame_at(_MIDDLE) == before:
        yield
        return
    engine.frame_set(*shutter.frame_at(_MIDDLE))
    try:
        yield
    finally:
        engine.frame_set(*before)


def export_motion(
    context: Context,
    engine: bpy.types.RenderEngine,
    shutter: Shutter,
    check_cancel: Callable[[], None],
    *,
    only_camera: bool,
) -> CameraMotion:
    """Look at all times of a shutter, in whose middle the depsgraph is; the core's scene is told of what moves there.

    only_camera: the rest is known from another view.
    """
    camera = active_camera(context, engine)
    steps = _wish_of(shutter, camera, None).steps
    camera_times = times_of(steps) if steps else [_MIDDLE]
    places, middle_width = {_MIDDLE: camera_place(context, engine, camera)}, _width_of(camera, context)
    objects = None if only_camera else _ObjectMotion(context, shutter, check_cancel)
    times = set(camera_times) | (objects.times if objects else set())
    try:
        for time in sorted(times - {_MIDDLE}):
            engine.frame_set(*shutter.frame_at(time))
            if time in camera_times:
                places[time] = camera_place(context, engine, camera)
                # A wider view is one of what is as much narrower, across the camera's axis.
                places[time][:3, :2] *= _width_of(camera, context) / middle_width
            if objects:
                objects.look(time)
    finally:
        engine.frame_set(*shutter.frame_at(_MIDDLE))
    if objects:
        objects.finish()
    way = np.stack([places[time] for time in camera_times])
    moves = (way != way[0]).any() and np.isfinite(way).all()
    return CameraMotion(way if moves else None, shutter.openness, shutter.blurs)


def _width_of(camera: bpy.types.Object, context: Context) -> float:
    """How wide a view a perspective camera has, over its distance. In Cycles no other blurs how that changes."""
    data = camera.evaluated_get(context.depsgraph).data
    return math.tan(data.angle / 2) if isinstance(data, bpy.types.Camera) and data.type == "PERSP" else 1.0


def _key(instance: bpy.types.DepsgraphObjectInstance) -> Key:
    """Tells an instance from others at all times."""
    instancer = instance.parent if instance.is_instance else None
    return (
        instance.object.original.as_pointer(),
        instancer.original.as_pointer() if instancer else 0,
        tuple(instance.persistent_id) if instance.is_instance else (),
    )


@dataclass
class _Moving:
    """An instance of the depsgraph."""

    steps: int
    is_particle: bool


class _ObjectMotion:
    """Of a scene that has been exported, in the middle of a shutter's time; `finish` tells the core."""

    def __init__(self, context: Context, shutter: Shutter, check_cancel: Callable[[], None]) -> None:
        self._context = context
        self._blurs = shutter.blurs
        self._check_cancel = check_cancel
        instances = context.depsgraph.object_instances
        exported = {index for indices, _ in context.placed.instances for index in indices}
        with_mesh = set(context.placed.meshes.values())
        self._places = {_MIDDLE: Instances.read(instances).object_to_world}
        self._indices: dict[Key, int] = {}
        self._moving: dict[int, _Moving] = {}
        self._gone: set[int] = set()  # particles that are not there at all times
        self._meshes: dict[int, dict[float, MeshArrays | None]] = {}  # by the instance; None: as in the middle
        self._rest: dict[int, NDArray[np.float32]] = {}  # positions in the middle, likewise
        deforming: list[int] = []
        for index, instance in enumerate(instances):
            blender_object = instance.object
            instancer = instance.parent if instance.is_instance else None
            wish = _wish_of(shutter, blender_object, instancer)
            if index not in exported or wish.steps == 0:
                continue
            self._indices[_key(instance)] = index
            is_particle = instance.is_instance and instance.particle_system is not None
            self._moving[index] = _Moving(wish.steps, is_particle)
            if wish.deforms:
                deforming.append(index)
            if index in with_mesh and wish.deforms:
                with edits_applied(blender_object) as mesh:
                    self._rest[index] = positions(mesh)
        self._curves = CurveMotion(context, deforming)

    @property
    def times(self) -> set[float]:
        return {time for moving in self._moving.values() for time in times_of(moving.steps)}

    def look(self, time: float) -> None:
        """Note where all is at a time, at which the depsgraph is."""
        self._check_cancel()
        instances = self._context.depsgraph.object_instances
        there = Instances.read(instances).object_to_world
        places = self._places[time] = self._places[_MIDDLE].copy()
        missing = {index for index, moving in self._moving.items() if moving.is_particle}
        for number, instance in enumerate(instances):
            index = self._indices.get(_key(instance))
            if index is None or time not in times_of(self._moving[index].steps):
                continue
            places[index] = there[number]
            missing.discard(index)
            if index in self._rest:
                self._look_at_mesh(index, instance.object, time)
            self._curves.look(index, instance.object, time)
        self._gone |= {index for index in missing if time in times_of(self._moving[index].steps)}

    def _look_at_mesh(self, index: int, blender_object: bpy.types.Object, time: float) -> None:
        rest = self._rest[index]
        with edits_applied(blender_object) as mesh:
            now = positions(mesh)
            if now.shape == rest.shape and np.array_equal(now, rest):
                return
            same = now.shape == rest.shape and len(mesh.polygons) > 0
            self._meshes.setdefault(index, {})[time] = mesh_arrays(mesh) if same else None

    def finish(self) -> None:
        """Tell the core's scene; the depsgraph is in the middle of the time again."""
        scene, placed = self._context.scene, self._context.placed
        self._finish_meshes()
        self._curves.finish({index: times_of(moving.steps) for index, moving in self._moving.items()})
        moved: set[int] = set()
        for indices, first in placed.instances:
            for offset, index in enumerate(indices):
                moving = self._moving.get(index)
                if index in self._gone and self._blurs:
                    scene.remove_instance(first + offset)
                elif moving is not None:
                    steps = np.stack([self._places[time][index] for time in times_of(moving.steps)])
                    if not (steps != steps[0]).any() or not np.isfinite(steps).all():
                        continue
                    moved.add(index)
                    if index not in placed.filled or not self._blurs:
                        scene.set_instance_motion(first + offset, np.ascontiguousarray(steps))
        if self._blurs and moved & (placed.filled | placed.shining):
            self._report(moved)

    def _report(self, moved: set[int]) -> None:
        placed, reporter = self._context.placed, self._context.reporter
        is_analytic = self._context.depsgraph.scene_eval.pivot.integrator == "ANALYTIC"
        for index, instance in enumerate(self._context.depsgraph.object_instances):
            name = f"object '{instance.object.name}'"
            if index in moved & placed.filled:
                reporter.warn(f"{name}: motion blur of what has a volume is not supported, it is sharp")
            elif index in moved & placed.shining and is_analytic:
                reporter.warn(
                    f"{name}: in the analytic integrator it shines on others from where it is in the middle of the "
                    "shutter's time. Fix: use Monte Carlo"
                )

    def _finish_meshes(self) -> None:
        if not self._meshes:
            return
        for index, instance in enumerate(self._context.depsgraph.object_instances):
            if index not in self._meshes:
                continue
            with edits_applied(instance.object) as mesh:
                rest = mesh_arrays(mesh)
            looks = self._meshes[index]
            steps = [looks.get(time, rest) for time in times_of(self._moving[index].steps)]
            if any(step is None or _shape(step) != _shape(rest) for step in steps):
                self._context.reporter.warn(
                    f"object '{instance.object.name}': its mesh has other vertices at other times of the shutter, "
                    "it moves as it is in the middle"
                )
                continue
            for id_, first in self._context.placed.meshes.items():
                if first == index:
                    self._context.scene.set_mesh_motion(
                        id_,
                        positions=[step.positions for step in steps],
                        corner_normals=_of_all([step.corner_normals for step in steps]),
                        vertex_normals=_of_all([step.vertex_normals for step in steps]),
                    )


def _shape(arrays: MeshArrays) -> tuple[Any, ...]:
    """What all steps of a mesh have in common."""
    return (
        arrays.positions.shape,
        arrays.corner_vertices.shape,
        arrays.corner_normals is None,
        arrays.vertex_normals is None,
    )


def _of_all(steps: list[NDArray[np.float32] | None]) -> list[NDArray[np.float32]] | None:
    return None if any(step is None for step in steps) else steps
