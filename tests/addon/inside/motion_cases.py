"""What moves while the shutter is open, rendered by Cycles and by Pivot, and what the core is told of it."""

from __future__ import annotations

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import bpy
import numpy as np
import parts
from cycles_cases import SPHERE, _ball, _cycles, _pivot
from recording import record

FRAME = 2
SAMPLES = 128  # of Cycles


def main(folder: Path) -> Any:
    for name, make in PICTURES.items():
        _scene()
        make()
        bpy.context.scene.frame_set(FRAME)
        _cycles(folder / f"{name}_CYCLES.exr", 1, SAMPLES)
        _pivot(folder / f"{name}_MONTE_CARLO.exr", 1, "JOINT", 32)
        if name in ANALYTIC:
            _cycles(folder / f"{name}_direct_CYCLES.exr", 0, SAMPLES)
            bpy.context.scene.pivot.integrator = "ANALYTIC"
            _pivot(folder / f"{name}_direct_ANALYTIC.exr", 0, "JOINT", 32)
    _vectors(folder)
    return {"pictures": list(PICTURES), "handed over": _handed_over(), "left out": _left_out(), "sharp": _sharp()}


def _scene(shutter: float = 0.5, position: str = "CENTER") -> None:
    parts.clear()
    parts.size(48, 36)
    parts.camera((0, -7, 3.5), (math.radians(66), 0, 0)).data.lens = 38
    parts.world((0.2, 0.25, 0.3))
    parts.light("lamp", "POINT", (2.5, -2, 4), energy=300, **SPHERE)
    clay, _ = parts.shaded("clay", "ShaderNodeBsdfDiffuse", Color=(0.7, 0.6, 0.5, 1))
    parts.quad("ground", material=clay).scale = (6, 6, 1)
    render = bpy.context.scene.render
    render.use_motion_blur, render.motion_blur_shutter = True, shutter
    owner = render if hasattr(render, "motion_blur_position") else bpy.context.scene.cycles
    owner.motion_blur_position = position


def _moved(what: Any, path: str, index: int, expression: str) -> None:
    """expression: of the frame."""
    driven = what.driver_add(path, index) if index >= 0 else what.driver_add(path)
    driven.driver.expression = expression


def _painted(name: str, red: float, green: float, blue: float) -> Any:
    return parts.shaded(name, "ShaderNodeBsdfDiffuse", Color=(red, green, blue, 1))[0]


def _bar(name: str, material: Any) -> Any:
    bpy.ops.mesh.primitive_cube_add(size=2, location=(1.3, 0, 1.3))
    bar = bpy.context.object
    bar.name, bar.scale = name, (1.1, 0.2, 0.3)
    bar.data.materials.append(material)
    return bar


def _objects() -> None:
    """One moves, one turns by a right angle while the shutter is open, one that moves is told to stay sharp."""
    _moved(_ball("ball", (-1.5, 0, 1.01), _painted("red", 0.8, 0.2, 0.1)), "location", 0, "frame * 1.2 - 4")
    _moved(_bar("bar", _painted("blue", 0.1, 0.3, 0.8)), "rotation_euler", 1, f"(frame - {FRAME}) * 3.14159")
    sharp = _ball("sharp", (0, -2, 0.4), _painted("green", 0.2, 0.7, 0.1))
    sharp.scale = (0.4, 0.4, 0.4)
    sharp.cycles.use_motion_blur = False
    _moved(sharp, "location", 0, "frame - 2")


def _opens_at_the_frame() -> None:
    """By a curve: the shutter is open wide only in the middle of its time, and not for long."""
    _scene(1.0, "START")
    curve = bpy.context.scene.render.motion_blur_shutter_curve
    points = curve.curves[0].points
    points[0].location, points[-1].location = (0, 0), (1, 0)
    curve.update()
    _objects()


def _camera() -> None:
    _ball("ball", (-1, 0, 1.01), _painted("red", 0.8, 0.2, 0.1))
    _bar("bar", _painted("blue", 0.1, 0.3, 0.8))
    camera = bpy.context.scene.camera
    _moved(camera, "location", 0, f"(frame - {FRAME}) * 0.8")
    _moved(camera, "rotation_euler", 1, f"(frame - {FRAME}) * 0.3")


def _deformed(name: str = "ball") -> Any:
    """A ball that grows into an egg and rises, by a shape key."""
    ball = _ball(name, (0, 0, 1.01), _painted("red", 0.8, 0.2, 0.1))
    ball.shape_key_add(name="Basis")
    egg = ball.shape_key_add(name="egg")
    for vertex, place in zip(ball.data.vertices, egg.data, strict=True):
        place.co = vertex.co * (1 + 0.5 * vertex.co.z)
        place.co.z += 0.8
    _moved(egg, "value", -1, f"0.5 + (frame - {FRAME}) * 0.9")
    return ball


def _instances() -> None:
    """Of a collection whose ball moves on a curve, with more steps, by empties that move otherwise."""
    inner = bpy.data.collections.new("inner")
    ball = _ball("ball", (0, 0, 0.5), _painted("red", 0.8, 0.2, 0.1))
    bpy.context.scene.collection.objects.unlink(ball)
    inner.objects.link(ball)
    ball.scale, ball.cycles.motion_steps = (0.5, 0.5, 0.5), 3
    _moved(ball, "location", 2, f"0.6 + (frame - {FRAME}) ** 2 * 6")
    for k in range(3):
        empty = parts.link(f"empty {k}", None, (2.0 * k - 2, 0, 0))
        empty.instance_type, empty.instance_collection = "COLLECTION", inner
        _moved(empty, "location", 0, f"{2.0 * k - 2} + (frame - {FRAME}) * {k}")


def _zoom() -> None:
    _ball("ball", (-1, 0, 1.01), _painted("red", 0.8, 0.2, 0.1))
    _bar("bar", _painted("blue", 0.1, 0.3, 0.8))
    _moved(bpy.context.scene.camera.data, "lens", -1, f"38 + (frame - {FRAME}) * 30")


def _strands() -> None:
    """Of a ball that grows into an egg."""
    ball = _deformed()
    ball.modifiers.new("fur", "PARTICLE_SYSTEM")
    settings = ball.particle_systems[0].settings
    settings.type, settings.count, settings.hair_length, settings.render_step = "HAIR", 300, 0.6, 3
    settings.child_type, settings.rendered_child_count = "INTERPOLATED", 4
    settings.root_radius, settings.tip_radius, settings.radius_scale = 2.0, 0.5, 0.02


PICTURES: dict[str, Callable[[], Any]] = {
    "objects": _objects,
    "curve": _opens_at_the_frame,
    "camera": _camera,
    "deformed": _deformed,
    "instances": _instances,
    "zoom": _zoom,
    "strands": _strands,
}
ANALYTIC = ("objects", "deformed")


def _vectors(folder: Path) -> None:
    """What the pass tells of the objects, of what deforms and of a camera that moves, where nothing is blurred."""
    _scene()
    _objects()
    _deformed("egg")
    _moved(bpy.context.scene.camera, "location", 0, f"(frame - {FRAME}) * 0.3")
    bpy.context.scene.render.use_motion_blur = False
    bpy.context.view_layer.use_pass_vector = True
    bpy.context.scene.frame_set(FRAME)
    _cycles(folder / "vectors_CYCLES.exr", 0, 16, file_format="OPEN_EXR_MULTILAYER")
    _pivot(folder / "vectors_PIVOT.exr", 0, "JOINT", 16, file_format="OPEN_EXR_MULTILAYER")


def _recorded() -> dict[str, Any]:
    """Where the core is told that things are, x of each, and what it is told to say."""
    bpy.context.scene.frame_set(FRAME)
    told = record()
    names = [instance.name for instance in told.instances]
    camera = told.camera
    return {
        "x": {names[id_]: places[:, 0, 3].tolist() for id_, places in told.motions.items()},
        "middle x": {instance.name: float(instance.object_to_world[0, 0, 3]) for instance in told.instances},
        "meshes": {
            told.meshes[id_].name: {
                "height": motion.positions[:, :, 2].max(1).tolist(),
                "has normals": motion.corner_normals is not None or motion.vertex_normals is not None,
            }
            for id_, motion in told.mesh_motions.items()
        },
        "camera x": None if camera.motion is None else np.array(camera.motion)[:, 0, 3].tolist(),
        "shutter": None if camera.shutter is None else np.array(camera.shutter)[[0, 128, 256]].tolist(),
        "reports": told.reports,
        "frame": [bpy.context.scene.frame_current, bpy.context.scene.frame_subframe],
    }


def _handed_over() -> Any:
    """Positions, steps and switches."""
    recorded = {}
    for position in ("START", "CENTER", "END"):
        _scene(0.5, position)
        _moved(_bar("two steps", None), "location", 0, "frame")
        many = _bar("four steps", None)
        many.cycles.motion_steps = 2
        _moved(many, "location", 0, "frame")
        off = _bar("off", None)
        off.cycles.use_motion_blur = False
        _moved(off, "location", 0, "frame")
        _deformed()
        stiff = _deformed("stiff")
        stiff.cycles.use_deform_motion = False
        _moved(bpy.context.scene.camera, "location", 0, "frame")
        if position == "END":
            curve = bpy.context.scene.render.motion_blur_shutter_curve
            curve.curves[0].points[0].location = (0, 0)
            curve.update()
        recorded[position] = _recorded()
    return recorded


def _left_out() -> Any:
    """A mesh that gets more vertices, what has a volume, and a lamp of a mesh in analytic pictures."""
    _scene()
    bpy.context.scene.pivot.integrator = "ANALYTIC"
    glow, _ = parts.shaded("glow", "ShaderNodeEmission", Strength=2)
    _moved(parts.quad("panel", material=glow), "location", 0, "frame")
    row = _bar("row", None)
    array = row.modifiers.new("array", "ARRAY")
    _moved(array, "count", -1, "frame")
    smoke, tree = parts.material("smoke")
    volume = tree.nodes.new("ShaderNodeVolumePrincipled")
    tree.links.new(volume.outputs[0], tree.nodes["Material Output"].inputs["Volume"])
    _moved(_bar("cloud", smoke), "location", 0, "frame")
    return _recorded()


def _sharp() -> Any:
    """Of a view layer without blur."""
    _scene()
    _moved(_bar("bar", None), "location", 0, "frame")
    bpy.context.view_layer.use_motion_blur = False
    return _recorded()
