"""The world: light from everywhere."""

from __future__ import annotations

import bpy

from ..report import naming
from .census import report_left_out
from .context import Context
from .nodes import Owner, active_tree
from .program import Program
from .shader import light_emission
from .surface import Surface


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
    program = Program(context.core, context.scene, context.images)
    if tree is None:
        radiance = program.colour(world.color)
    else:
        radiance = light_emission(tree, Owner(owner, context.reporter, program, world))
    with naming(owner, "give its colour and strength finite values"):
        if radiance.is_constant:
            context.scene.set_world(radiance=radiance.numbers)
        else:
            if context.depsgraph.scene_eval.pivot.integrator == "ANALYTIC":
                context.reporter.warn(
                    f"{owner}: in the analytic integrator it lights by its mean. Fix: use Monte Carlo"
                )
            context.scene.set_world_shader(Surface.of(program, emission=radiance).core_shader(context.core))
