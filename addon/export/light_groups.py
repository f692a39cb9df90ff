"""Light groups: which pass shows the light of a lamp, of what shines, or of the world. [C] is Cycles' sync."""

from __future__ import annotations

import bpy

NO_GROUP = -1


def light_group(view_layer: bpy.types.ViewLayer, *shining: bpy.types.Object | bpy.types.World | None) -> int:
    """The place among the view layer's groups of the first name that any of these has. [C]"""
    name = next((each.lightgroup for each in shining if each is not None and each.lightgroup), "")
    return next((place for place, group in enumerate(view_layer.lightgroups) if group.name == name), NO_GROUP)
