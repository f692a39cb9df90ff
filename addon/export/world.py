"""The world: light from everywhere, and fog."""

from __future__ import annotations

from typing import Any

import bpy

from ..report import naming
from .aovs import aov_shaders
from .census import report_left_out
from .context import Context
from .light_groups import NO_GROUP, light_group
from .media import core_medium, report_analytic
from .nodes import Owner, active_tree
from .nodes.ray import CAMERA_RAY
from .nodes.skies import sun_light
from .program import Program
from .shader import light_emission
from .surface import Surface
from .volume import node_volume, output_volume


def export_world(context: Context) -> bool:
    """Set the core's world, and what fills it, to that of the view layer. Returns whether it shines."""
    view_layer = context.depsgraph.view_layer_eval
    world: bpy.types.World | None = getattr(view_layer, "world_override", None) or context.depsgraph.scene_eval.world
    if world is None or not view_layer.use_sky:
        context.scene.set_world(radiance=(0.0, 0.0, 0.0))
        return False
    owner = f"world '{world.name}'"
    report_left_out(world, owner, context.reporter)
    tree = active_tree(world)
    program = Program(context.core, context.scene, context.images)
    if tree is None:
        radiance = program.colour(world.color)
    else:
        radiance = light_emission(tree, Owner(owner, context.reporter, program, world))
    shines = not radiance.is_always(0)
    group = light_group(view_layer, world)
    if group != NO_GROUP:
        context.scene.set_world_light_group(group)
    if tree is not None:
        _add_suns(context, tree, owner, group)
        _set_aovs(context, tree, owner, world)
        _set_medium(context, tree, owner, world, shines)
    varies = not radiance.is_constant
    context.scene.set_world_rules(**_rules(world))
    visibility = getattr(world, "cycles_visibility", None)
    if visibility is not None and not visibility.camera:
        radiance = radiance * (1.0 - program.op("ray_is", settings=[CAMERA_RAY]))
    with naming(owner, "give its colour and strength finite values"):
        if radiance.is_constant:
            context.scene.set_world(radiance=radiance.numbers)
        else:
            if varies and context.depsgraph.scene_eval.pivot.integrator == "ANALYTIC":
                context.reporter.warn(
                    f"{owner}: in the analytic integrator it lights by its mean. Fix: use Monte Carlo"
                )
            context.scene.set_world_shader(Surface.of(program, emission=radiance).core_shader(context.core))
    return shines


_RAYS = {"diffuse": "DIFFUSE", "glossy": "GLOSSY", "transmission": "TRANSMISSION", "scatter": "VOLUME_SCATTER"}


def _rules(world: bpy.types.World) -> dict[str, Any]:
    """What the world lights, as lamps have it; which a camera sees is its shader's."""
    visibility, cycles = getattr(world, "cycles_visibility", None), getattr(world, "cycles", None)
    if visibility is None or cycles is None:
        return {}
    hidden = [ray for switch, ray in _RAYS.items() if not getattr(visibility, switch)]
    return {"hidden_from": hidden, "max_bounces": cycles.max_bounces}


def _set_aovs(context: Context, tree: bpy.types.NodeTree, name: str, world: bpy.types.World) -> None:
    owner = Owner(name, context.reporter, Program(context.core, context.scene, context.images), world)
    with naming(name, "give its AOVs finite values"):
        for aov, shader in aov_shaders(tree, owner, context.depsgraph.view_layer):
            context.scene.set_world_aov(aov, shader)


def _add_suns(context: Context, tree: bpy.types.NodeTree, owner: str, group: int) -> None:
    """Lamps for the suns of skies: a map of the world would lose them between its places."""
    for node in tree.nodes:
        sun = sun_light(context.core, node) if node.type == "TEX_SKY" and not node.mute else None
        if sun is None:
            continue
        direction, half_angle_rad, irradiance = sun
        background = node.outputs["Color"].links[0].to_node
        irradiance = irradiance * background.inputs["Strength"].default_value
        with naming(owner, "give its sky finite values"):
            light = context.core.SunLight(
                direction=direction, half_angle_rad=half_angle_rad, irradiance=irradiance.tolist()
            )
            context.scene.add_light(owner, light, light_group=group)


def _set_medium(context: Context, tree: bpy.types.NodeTree, name: str, world: bpy.types.World, shines: bool) -> None:
    target = output_volume(tree)
    if target is None:
        return
    owner = Owner(name, context.reporter, Program(context.core, context.scene, context.images), world)
    volume = node_volume(target, owner)
    if shines:
        report_analytic(context, volume, name)
    context.scene.set_world_medium(core_medium(context, volume, name))
