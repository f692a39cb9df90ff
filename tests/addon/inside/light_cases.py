"""Lights and worlds as exported."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import bpy
import parts
from recording import record

HAS_EXPOSURE = bpy.app.version >= (4, 4)  # and normalize, temperature


def main(folder: Path) -> Any:
    lights, rules = _lights()
    return {
        "lights": lights,
        "rules": rules,
        "reports": _reports(),
        "worlds": _worlds(),
        "negative": _negative(),
        "varying": _varying(),
    }


def _lights() -> Any:
    parts.clear()
    parts.camera()
    light = parts.light
    light("point", "POINT", (1, 2, 3), energy=100, color=(1, 0.5, 0.25), shadow_soft_size=0.3)
    light("tiny", "POINT", energy=10, shadow_soft_size=0.0)
    light("scaled", "POINT", energy=10, shadow_soft_size=0.3).scale = (5, 5, 5)
    cone: dict[str, Any] = {"spot_size": math.radians(50), "spot_blend": 0.2}
    light("spot", "SPOT", (0, 0, 2), energy=40, shadow_soft_size=0.1, **cone)
    if "use_soft_falloff" in bpy.types.PointLight.bl_rna.properties:
        light("sphere", "POINT", energy=10, use_soft_falloff=False)
        light("sphere_spot", "SPOT", energy=40, use_soft_falloff=False)
    light("turned", "SPOT", energy=40, **cone).rotation_euler = (math.pi / 2, 0, 0)
    light("sun", "SUN", energy=3, color=(1, 1, 0.5), angle=0.2).rotation_euler = (0, math.pi / 2, 0)
    light("square", "AREA", (0, 0, 4), energy=12, shape="SQUARE", size=2)
    light("rectangle", "AREA", energy=12, shape="RECTANGLE", size=2, size_y=0.5)
    light("disk", "AREA", energy=12, shape="DISK", size=2)
    light("ellipse", "AREA", energy=12, shape="ELLIPSE", size=2, size_y=0.5)
    light("stretched", "AREA", energy=12, shape="SQUARE", size=1).scale = (2, 3, 1)
    light("mirrored", "AREA", energy=12, shape="SQUARE", size=1).scale = (-1, 1, 1)
    light("inverted", "AREA", energy=12, shape="SQUARE", size=1).scale = (1, 1, -1)
    light("flat", "AREA", energy=12, shape="SQUARE", size=1).scale = (0, 1, 1)
    light("portal", "AREA", energy=12).data.cycles.is_portal = True
    light("hidden", "POINT", energy=10).hide_render = True
    shaded = light("shaded", "POINT", energy=4 * math.pi)
    shaded.data.use_nodes = True
    emission = shaded.data.node_tree.nodes["Emission"]
    emission.inputs["Color"].default_value = (0.5, 0.25, 1, 1)
    emission.inputs["Strength"].default_value = 3
    if HAS_EXPOSURE:
        light("exposed", "POINT", energy=4 * math.pi, exposure=3)
        light("warm", "POINT", energy=4 * math.pi, use_temperature=True, temperature=3000)
        light("raw_point", "POINT", energy=8, shadow_soft_size=0.5, normalize=False)
        light("raw_tiny", "POINT", energy=math.pi, shadow_soft_size=0.0, normalize=False)
        light("raw_area", "AREA", energy=math.pi, shape="DISK", size=3, normalize=False)
        light("raw_sun", "SUN", energy=2, angle=0.6, normalize=False)
    beam = light("beam", "AREA", spread=1.0)
    beam.visible_diffuse = beam.visible_volume_scatter = beam.visible_shadow = False  # the last is for surfaces
    unshadowed = light("unshadowed", "POINT").data
    if hasattr(unshadowed.cycles, "cast_shadow"):
        unshadowed.cycles.cast_shadow = False
    else:
        unshadowed.use_shadow = False
    unshadowed.cycles.max_bounces = 2
    recording = record()
    return {name: recording.light(name) for name in recording.lights}, recording.rules


def _reports() -> Any:
    """What is said of lights, objects and a camera that lose something, in two layers and frames of one job."""
    parts.clear()
    parts.camera()
    parts.light("oval", "SPOT").scale = (1, 2, 1)
    parts.light("even", "SPOT").scale = (2, 2, 2)
    parent = parts.link("stretched parent")
    parent.scale = (1, 2, 1)
    for name, turn in (("slanted", 0.6), ("straight", 0.0)):
        panel = parts.light(name, "AREA")
        panel.rotation_euler = (0, 0, turn)
        panel.parent = parent
    parts.light("unseen", "POINT").data.cycles.use_multiple_importance_sampling = False
    bpy.context.scene.cycles.sample_clamp_direct = 1.0
    glow, emission = parts.shaded("glow", "ShaderNodeEmission")
    place = glow.node_tree.nodes.new("ShaderNodeNewGeometry").outputs["Position"]
    glow.node_tree.links.new(place, emission.inputs["Strength"])
    parts.quad("panel", material=glow)
    parts.quad("second panel", material=bpy.data.materials["glow"])
    for name, roughness in (("window", 0.5), ("clear window", 0.0)):
        window, node = parts.shaded(name, "ShaderNodeBsdfGlass", Roughness=roughness)
        node.distribution = "GGX"
        parts.quad(f"pane of {name}", material=window)
    bpy.context.scene.pivot.integrator = "ANALYTIC"
    bpy.context.scene.view_layers.new("second")
    bpy.context.scene.frame_end = 2
    bpy.context.scene.render.filepath = str(Path(bpy.app.tempdir) / "reports")
    return record(animation=True).reports


def _negative() -> Any:
    parts.clear()
    parts.camera()
    parts.light("power", "POINT", energy=-4 * math.pi)
    nodes = parts.light("nodes", "POINT", energy=4 * math.pi).data
    nodes.use_nodes = True
    nodes.node_tree.nodes["Emission"].inputs["Strength"].default_value = -3
    parts.world((0.5, 0, 0.25)).node_tree.nodes["Background"].inputs["Strength"].default_value = -2
    recording = record()
    lights = {name: recording.light(name)["intensity"] for name in ("power", "nodes")}
    return lights | {"world": recording.world}


def _varying() -> Any:
    """Lights whose nodes vary with distance and by ray: the intensity of each, and what is said."""
    parts.clear()
    parts.camera()
    for name, kind, output in (("far", "LightFalloff", "Linear"), ("seen", "LightPath", "Is Camera Ray")):
        data = parts.light(name, "POINT", energy=4 * math.pi).data
        data.use_nodes = True
        tree = data.node_tree
        node = tree.nodes.new(f"ShaderNode{kind}")
        if kind == "LightFalloff":
            node.inputs["Strength"].default_value = 2
        tree.links.new(node.outputs[output], tree.nodes["Emission"].inputs["Strength"])
    recording = record()
    of_lights = {name: recording.light(name)["intensity"] for name in recording.lights}
    return {"reports": recording.reports, "shaded": sorted(recording.lamp_shaders)} | of_lights


def _worlds() -> Any:
    parts.clear()
    parts.camera()
    none = record().world
    parts.world((0.1, 0.2, 0.3)).node_tree.nodes["Background"].inputs["Strength"].default_value = 2
    constant = record()
    return {"none": none, "constant": constant.world, "constant_reports": constant.reports} | _environment()


def _environment() -> Any:
    """A world lit by an image whose upper half is bright."""
    image = bpy.data.images.new("sky", 8, 4, float_buffer=True)
    image.pixels.foreach_set([0.0, 0.0, 0.0, 1.0] * 16 + [1.0, 2.0, 4.0, 1.0] * 16)
    tree = bpy.context.scene.world.node_tree
    texture = tree.nodes.new("ShaderNodeTexEnvironment")
    texture.image = image
    tree.links.new(texture.outputs["Color"], tree.nodes["Background"].inputs["Color"])
    recording = record()
    bpy.context.view_layer.use_sky = False
    return {"image": sorted(recording.world.varying), "image_reports": recording.reports, "no_sky": record().world}
