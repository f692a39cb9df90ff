"""Which rays meet an object, as Cycles takes it from the object, its instancer and its collections.

[C] is Cycles' object sync: what instances an object hides it, too; collections that are for indirect light alone hide
it from the camera, and those that are holdouts make it one.
"""

from __future__ import annotations

from dataclasses import dataclass

import bpy

_SWITCHES = {
    "CAMERA": "visible_camera",
    "DIFFUSE": "visible_diffuse",
    "GLOSSY": "visible_glossy",
    "TRANSMISSION": "visible_transmission",
    "VOLUME_SCATTER": "visible_volume_scatter",
    "SHADOW": "visible_shadow",
}


@dataclass(frozen=True)
class Visible:
    hidden_from: tuple[str, ...] = ()  # rays, by the core's names
    is_holdout: bool = False


def visible(
    blender_object: bpy.types.Object, instancer: bpy.types.Object | None, view_layer: bpy.types.ViewLayer
) -> Visible:
    """instancer: None for an object that stands for itself. [C]"""
    owner = instancer or blender_object  # collections hold it
    hidden = {
        name for name, switch in _SWITCHES.items() if not (getattr(blender_object, switch) and getattr(owner, switch))
    }
    original = owner.original
    is_holdout = original.holdout_get(view_layer=view_layer)  # or its own switch says so
    if not is_holdout and original.indirect_only_get(view_layer=view_layer):
        hidden.add("CAMERA")
    return Visible(tuple(name for name in _SWITCHES if name in hidden), is_holdout)
