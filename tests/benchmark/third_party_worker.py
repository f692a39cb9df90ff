"""Inside Blender: a third-party file by Cycles and by Pivot.

third_party_worker.py < JOB: JSON of {"file", "result"}. Writes result.npz with cycles and pivot, (height, width, 3)
radiance, and result.json with what was added to the scene and Pivot's warnings or its fault.
"""

from __future__ import annotations

import importlib
import itertools
import json
import math
import sys
from pathlib import Path
from typing import Any

import bpy

# isort: split
import addon_utils
import mathutils
import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent))
from blender_render import render_picture

WIDTH_PX, HEIGHT_PX = 320, 180
BOUNCES = 4
CYCLES_SAMPLES, PIVOT_SAMPLES = 256, 64
VIEW_RAD = 0.6  # the camera's angle
BALLS_ACROSS = 9


def load(file: Path) -> None:
    """Open a .blend file, or import a model into an empty one."""
    if file.suffix == ".blend":
        bpy.ops.wm.open_mainfile(filepath=str(file))
        if not bpy.context.scene.objects:
            show_materials()
        return
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    if file.suffix == ".obj":
        bpy.ops.wm.obj_import(filepath=str(file))
    else:
        addon_utils.enable("io_scene_gltf2")
        bpy.ops.import_scene.gltf(filepath=str(file))


def show_materials() -> None:
    """A wall of balls, one of each material of a library."""
    for number, material in enumerate(bpy.data.materials):
        row, column = divmod(number, BALLS_ACROSS)
        bpy.ops.mesh.primitive_uv_sphere_add(location=(2.2 * column, 0, -2.2 * row))
        mesh: Any = bpy.context.object.data
        mesh.polygons.foreach_set("use_smooth", [True] * len(mesh.polygons))
        mesh.materials.append(material)


def bounds() -> tuple[mathutils.Vector, mathutils.Vector]:
    """Centre and half the size of the box around what renders."""
    corners = [
        instance.matrix_world @ mathutils.Vector(corner)
        for instance in bpy.context.evaluated_depsgraph_get().object_instances
        if instance.object.type in {"MESH", "CURVE", "SURFACE", "FONT", "META"} and not instance.object.hide_render
        for corner in instance.object.bound_box
    ]
    low, high = (mathutils.Vector(f(axis) for axis in zip(*corners, strict=True)) for f in (min, max))
    return (low + high) / 2, (high - low) / 2


def camera_distance_m(half_size: mathutils.Vector, turn: mathutils.Quaternion) -> float:
    """How far a camera turned so, aimed at a box's centre, stands to see all of it."""
    tangents = math.tan(VIEW_RAD / 2), math.tan(VIEW_RAD / 2) * HEIGHT_PX / WIDTH_PX
    corners = [
        turn.inverted() @ (half_size * mathutils.Vector(signs)) for signs in itertools.product((-1, 1), repeat=3)
    ]
    return 1.1 * max(c.z + max(abs(c.x) / tangents[0], abs(c.y) / tangents[1]) for c in corners)


def add_what_is_missing() -> list[str]:
    """A camera, and lights and a world, around a scene without: what was added."""
    scene = bpy.context.scene
    added = []
    if scene.camera is None:
        centre, half_size = bounds()
        toward = mathutils.Vector((0.5, -1, 0.45)).normalized()
        distance_m = camera_distance_m(half_size, toward.to_track_quat("Z", "Y"))
        camera = bpy.data.cameras.new("camera")
        camera.angle = VIEW_RAD
        camera.clip_start, camera.clip_end = distance_m / 1000, distance_m * 10
        scene.camera = _link("camera", camera, centre + distance_m * toward, toward)
        added.append("camera")
    if not any(thing.type == "LIGHT" and not thing.hide_render for thing in scene.objects):
        centre, half_size = bounds()
        radius_m = half_size.length
        sun = bpy.data.lights.new("sun", "SUN")
        sun.energy, sun.angle = 2.0, 0.05
        _link("sun", sun, centre, mathutils.Vector((0.6, -0.3, 0.8)))
        sphere = bpy.data.lights.new("sphere", "POINT")
        toward = mathutils.Vector((-0.8, -0.8, 0.7))
        sphere.energy, sphere.shadow_soft_size = 60 * radius_m**2, 0.3 * radius_m
        if hasattr(sphere, "use_soft_falloff"):
            sphere.use_soft_falloff = False
        _link("sphere", sphere, centre + 2 * radius_m * toward, toward)
        scene.world = bpy.data.worlds.new("grey")
        if bpy.app.version < (5, 0):
            scene.world.use_nodes = True
        background: Any = next(node for node in scene.world.node_tree.nodes if node.type == "BACKGROUND")
        background.inputs["Color"].default_value = (0.3, 0.3, 0.3, 1)
        added.append("lights")
    return added


def _link(name: str, data: Any, location: mathutils.Vector, toward: mathutils.Vector) -> Any:
    """A new object whose +z points there."""
    thing = bpy.data.objects.new(name, data)
    turn = toward.to_track_quat("Z", "Y")
    thing.matrix_world = mathutils.Matrix.LocRotScale(location, turn, None)
    bpy.context.scene.collection.objects.link(thing)
    return thing


def prepare() -> None:
    """One size, the samples and bounces of the benchmark, and nothing after the render."""
    scene = bpy.context.scene
    render = scene.render
    render.resolution_x, render.resolution_y, render.resolution_percentage = WIDTH_PX, HEIGHT_PX, 100
    render.use_border = render.use_multiview = render.use_compositing = render.use_sequencer = False
    render.filter_size = 1.5
    cycles: Any = scene.cycles
    cycles.device, cycles.samples = "CPU", CYCLES_SAMPLES
    cycles.use_adaptive_sampling = cycles.use_denoising = False
    cycles.pixel_filter_type, cycles.filter_width = "BLACKMAN_HARRIS", 1.5
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = cycles.blur_glossy = 0
    for kind in ("max", "diffuse", "glossy", "transmission"):
        setattr(cycles, f"{kind}_bounces", BOUNCES)
    scene.pivot.samples, scene.pivot.max_bounces = PIVOT_SAMPLES, BOUNCES


def main() -> None:
    job = json.load(sys.stdin)
    for addon in ("cycles", "pivot"):
        if addon_utils.enable(addon) is None:
            raise RuntimeError(f"the addon {addon} does not enable")
    said: dict[str, Any] = {"added": [], "warnings": []}
    pictures = {}
    try:
        load(Path(job["file"]))
        said["added"] = add_what_is_missing()
        prepare()
        for engine in ("CYCLES", "PIVOT"):
            bpy.context.scene.render.engine = engine
            pictures[engine.lower()] = render_picture()
    except RuntimeError as error:  # an operator's: the last line that names an error, of a traceback at times
        lines = str(error).strip().splitlines()
        said["fault"] = next((line for line in reversed(lines) if "Error" in line), lines[-1])
    said["warnings"] = sorted(importlib.import_module("pivot.engine").PivotRenderEngine.frame_count.warnings)
    np.savez(f"{job['result']}.npz", **pictures)
    Path(f"{job['result']}.json").write_text(json.dumps(said))


if __name__ == "__main__":
    main()
