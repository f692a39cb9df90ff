"""The world: light of one colour from everywhere."""

from __future__ import annotations

import bpy

from ..report import naming
from .census import report_left_out
from .context import Context
from .nodes import Owner, active_tree
from .shader import light_emission


def export_world(context: Context) -> None:
    """Set the core's world to that of the view layer."""
    view_layer = context.depsgraph.view_layer_eval
    world: bpy.types.World | None = getattr(view_layer, "world_override", None) or context.depsgraph.scene_eval.world
    if world is None or not view_layer.use_sky:
        context.scene.set_world(radiance=(0.0, 0.0, 0.0))
        return
    owner = f"world '{world.name}'"
    report_left_out(world, owner, context.reporter)
    tree = active_tree(world)
    radiance = world.color if tree is None else light_emission(tree, Owner(owner, context.reporter))
    with naming(owner, "give its colour and strength finite values"):
        context.scene.set_world(radiance=list(radiance))
