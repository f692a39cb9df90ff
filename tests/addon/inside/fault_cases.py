"""Faults in one Blender: what each is reported as, and whether a picture was written."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any
from unittest.mock import patch

import bpy
import parts

NAN = float("nan")


def main(folder: Path) -> Any:
    faults = {name: _fault(fault, folder / f"{name}.png") for name, fault in FAULTS.items()}
    return {
        "faults": faults,
        "missing_core": _missing_core(folder),
        "memory": _memory(folder),
        "strict": _strict(folder, has_warning=True),
        "strict_without_warnings": _strict(folder, has_warning=False),
    }


def scene() -> None:
    parts.clear()
    parts.camera()
    parts.quad("ground", material=parts.shaded("red", "ShaderNodeBsdfDiffuse")[0])
    parts.light("lamp", "POINT", (0, 0, 2), energy=100)
    bpy.context.scene.render.engine = "PIVOT"
    bpy.context.scene.pivot.samples = 1


def _object_transform() -> None:
    bpy.data.objects["ground"].location.x = NAN


def _light_transform() -> None:
    bpy.data.objects["lamp"].location.x = NAN


def _camera_transform() -> None:
    bpy.context.scene.camera.location.x = NAN


def _mesh_vertex() -> None:
    bpy.data.objects["ground"].data.vertices[2].co.x = NAN


def _material_value() -> None:
    bpy.data.materials["red"].node_tree.nodes["Diffuse BSDF"].inputs["Color"].default_value[0] = NAN


def _light_energy() -> None:
    bpy.data.lights["lamp"].energy = NAN


def _camera_shift() -> None:
    bpy.context.scene.camera.data.shift_y = NAN


def _camera_scale() -> None:
    bpy.context.scene.camera.data.type = "ORTHO"
    bpy.context.scene.camera.data.ortho_scale = NAN


def _camera_stop() -> None:
    dof = bpy.context.scene.camera.data.dof
    dof.use_dof, dof.aperture_fstop = True, NAN


def _samples() -> None:
    """A value below the property's limit, as a script or an old file may leave it."""
    if bpy.app.version >= (5, 0):
        bpy.context.scene.pivot.bl_system_properties_get(do_create=True)["samples"] = -3
    else:
        bpy.context.scene.pivot["samples"] = -3


def _too_large() -> None:
    parts.size(60000, 60000)


FAULTS = {
    fault.__name__.lstrip("_"): fault
    for fault in (
        _object_transform,
        _light_transform,
        _camera_transform,
        _mesh_vertex,
        _material_value,
        _light_energy,
        _camera_shift,
        _camera_scale,
        _camera_stop,
        _samples,
        _too_large,
    )
}


def _fault(fault: Any, picture: Path) -> Any:
    scene()
    fault()
    return render(picture)


def render(picture: Path) -> Any:
    """The error a render ends with, and whether it left a picture."""
    bpy.context.scene.render.filepath = str(picture)
    error = None
    try:
        bpy.ops.render.render(write_still=True)
    except RuntimeError as raised:
        error = str(raised)
    return {"error": error, "picture": picture.exists()}


def _missing_core(folder: Path) -> Any:
    scene()
    with patch.dict(sys.modules, pivot_core=None):
        return render(folder / "missing_core.png")


def _strict(folder: Path, has_warning: bool) -> Any:
    scene()
    bpy.context.scene.cycles.sample_clamp_direct = 1.0 if has_warning else 0.0
    with patch.object(sys.modules["pivot.engine"].PivotRenderEngine, "strict", True):
        return render(folder / f"strict_{has_warning}.png")


def _memory(folder: Path) -> Any:
    scene()
    with patch("pivot.export.groups.mesh_arrays", side_effect=MemoryError):
        return render(folder / "memory.png")
