"""Emission of what nodes tell of places, objects and rays: tiles with a ball each, by Cycles and by Pivot, as files."""

from __future__ import annotations

import math
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import bpy
import numpy as np
import parts
from instance_nodes import paired_on_points

COLUMNS = 10
TILE_PX = 32
Make = Callable[[Any, Any], Any]  # from a tree and the tile's object to an output


def main(folder: Path) -> Any:
    """Returns the names of the tiles from the lower left, row by row, and what was reported of them."""
    parts.clear()
    names = []
    for index, (name, make) in enumerate(_cases()):
        _tile(name, make, (2 * (index % COLUMNS) + 1, 2 * (index // COLUMNS) + 1, 0))
        names.append(name)
    rows = math.ceil(len(names) / COLUMNS)
    camera = parts.camera((COLUMNS, rows, 50))
    camera.data.sensor_width = 36
    camera.data.lens = 50 * 36 / (2 * max(COLUMNS, rows))
    parts.size(TILE_PX * COLUMNS, TILE_PX * rows)
    for engine in ("PIVOT", "CYCLES"):
        parts.render_steady(folder / f"{engine}.exr", engine)
    said = sorted(sys.modules["pivot.engine"].PivotRenderEngine.said_in_job)
    _instances()
    for engine in ("PIVOT", "CYCLES"):
        parts.render_steady(folder / f"instances_{engine}.exr", engine)
    _lit()
    for engine in ("PIVOT", "CYCLES"):
        bpy.context.scene.pivot.max_bounces = bpy.context.scene.cycles.max_bounces = 0
        parts.render_steady(folder / f"lit_{engine}.exr", engine, LIT_SAMPLES)
    return {"lit": list(LIT), "names": names, "columns": COLUMNS, "tile_px": TILE_PX, "reports": said}


def _instances() -> None:
    """Rows of quads from instancers of each kind, which show what is their own."""
    parts.clear()
    parts.camera((0, 0, 20)).data.sensor_width = 32
    parts.size(96, 96)
    for index, (name, make) in enumerate(_of_instances()):
        shown = parts.quad(f"shown {name}", material=_emitting(name, make, None))
        shown.scale, shown.location = (0.1, 0.1, 1), (0, 30, 0)
        bpy.ops.mesh.primitive_grid_add(x_subdivisions=6, y_subdivisions=2, location=(0, 1.4 * index - 5.6, 0))
        instancer = bpy.context.object
        instancer.scale, instancer["odd"] = (4, 0.6, 1), 0.2 + 0.1 * index
        instancer.show_instancer_for_render = False
        instancer.color = (0.2 * index, 0.5, 1 - 0.1 * index, 1)
        if name.startswith("particle"):
            instancer.modifiers.new("particles", "PARTICLE_SYSTEM")
            settings = instancer.particle_systems[0].settings
            settings.count, settings.frame_start, settings.frame_end, settings.normal_factor = 12, 0, 0, 0
            settings.render_type, settings.instance_object, settings.particle_size = "OBJECT", shown, 1
            settings.effector_weights.gravity, settings.object_align_factor = 0, (0, 0, 0.3)
        elif name.startswith("stored"):
            instancer.modifiers.new("pairs", "NODES").node_group = paired_on_points(shown)
        else:
            instancer.instance_type = "VERTS" if name == "random" else "FACES"
            shown.parent, shown.location = instancer, (0, 0, 0)


def _lit() -> None:
    """A row of balls that maps and bumps turn the normals of, under a sphere and a sun."""
    parts.clear()
    for column, (kind, make) in enumerate(LIT.values()):
        bpy.ops.mesh.primitive_uv_sphere_add(segments=48, ring_count=24, location=(2.2 * column, 0, 0))
        ball = bpy.context.object
        ball.data.polygons.foreach_set("use_smooth", [True] * len(ball.data.polygons))
        material, shader = parts.shaded(f"lit {column}", f"ShaderNodeBsdf{kind}")
        if kind == "Glossy":
            shader.distribution, shader.inputs["Roughness"].default_value = "GGX", 0.3
        ball.data.materials.append(material)
        output = make(shader.id_data, ball)
        end = shader.inputs["Normal"]
        if output.name == "Displacement":
            end = shader.id_data.nodes["Material Output"].inputs["Displacement"]
        shader.id_data.links.new(output, end)
    middle = 1.1 * (len(LIT) - 1)
    camera = parts.camera((middle, -60, 0), (math.pi / 2, 0, 0))
    camera.data.angle = 2 * math.atan(1.1 * len(LIT) / 60)
    parts.size(LIT_PX * len(LIT), LIT_PX)
    point = parts.light("point", "POINT", (middle - 6, -4, 5), energy=3000, shadow_soft_size=1.0)
    if hasattr(point.data, "use_soft_falloff"):
        point.data.use_soft_falloff = False
    parts.light("sun", "SUN", energy=1.5, angle=0.1).rotation_euler = (0.9, 0.9, 0)


def _of_instances() -> Iterator[tuple[str, Make]]:
    yield "random", node("ObjectInfo", "Random")
    yield "generated", node("TexCoord", "Generated", from_instancer=True)
    yield "color", node("ObjectInfo", "Color")
    yield "uv", node("UVMap", "UV", from_instancer=True)
    yield "particle index", node("ParticleInfo", "Index")
    yield "particle random", node("ParticleInfo", "Random")
    life = ((axis, node("ParticleInfo", name)) for axis, name in zip("XYZ", ("Age", "Lifetime", "Size"), strict=True))
    yield "particle life", node("VectorMath", "Vector", (0, node("CombineXYZ", "Vector", *life)), operation="SINE")
    level = (0, node("ParticleInfo", "Location")), (1, node("CombineXYZ", "Vector", X=1.0, Y=1.0))  # z is a render's
    moved = (0, node("VectorMath", "Vector", *level, operation="MULTIPLY")), (1, node("ParticleInfo", "Velocity"))
    place = node("VectorMath", "Vector", *moved, operation="ADD")
    yield "particle place", node("VectorMath", "Vector", (0, place), operation="FRACTION")
    if hasattr(bpy.types.Object, "evaluated_geometry"):  # Blender 3.4 tells nobody
        kept = node("Attribute", "Color", attribute_name="kept", attribute_type="INSTANCER")
        part = node("Attribute", "Fac", attribute_name="part", attribute_type="INSTANCER")
        yield "stored", node("VectorMath", "Vector", (0, kept), (1, part), operation="ADD")


def _tile(name: str, make: Make, location: Any) -> None:
    """A squashed, turned ball with attributes."""
    ball = _ball(name, location)
    ball.data.materials.append(_emitting(name, make, ball))


def _emitting(name: str, make: Make, ball: Any) -> Any:
    """A material that emits half of what the node tells, and 0.5."""
    material, emission = parts.shaded(name, "ShaderNodeEmission")
    material.pass_index = 5
    tree = emission.id_data
    scaled = tree.nodes.new("ShaderNodeVectorMath")
    scaled.operation = "MULTIPLY_ADD"
    scaled.inputs[1].default_value = scaled.inputs[2].default_value = (0.5, 0.5, 0.5)
    tree.links.new(make(tree, ball), scaled.inputs[0])
    tree.links.new(scaled.outputs[0], emission.inputs["Color"])
    return material


def _ball(name: str, location: Any) -> Any:
    bpy.ops.mesh.primitive_uv_sphere_add(segments=24, ring_count=12, radius=0.9, location=location)
    ball = bpy.context.object
    ball.name = name
    ball.rotation_euler, ball.scale = (0.4, 0.7, -0.3), (1, 0.7, 0.9)
    ball.color, ball.pass_index = (0.2, 0.5, 0.8, 0.6), 3
    ball["odd"], ball["tint"] = 0.3, [0.1, 0.4, 0.7]
    mesh = ball.data
    mesh.polygons.foreach_set("use_smooth", [True] * len(mesh.polygons))
    rng = np.random.default_rng(1)
    for kind, domain in _attributes():
        attribute = mesh.attributes.new(f"{kind} {domain}", kind, domain)
        key, width = _KEYS[kind]
        values = rng.random(len(attribute.data) * width, np.float32)
        values = values > 0.5 if kind == "BOOLEAN" else np.int32(values * 3) if kind == "INT" else values
        attribute.data.foreach_set(key, values)
    mesh.attributes.active_color_index = mesh.attributes.render_color_index = 1
    return ball


_KEYS = {
    "FLOAT": ("value", 1),
    "INT": ("value", 1),
    "BOOLEAN": ("value", 1),
    "FLOAT2": ("vector", 2),
    "FLOAT_VECTOR": ("vector", 3),
    "FLOAT_COLOR": ("color", 4),
    "BYTE_COLOR": ("color", 4),
    "QUATERNION": ("value", 4),
}


def _attributes() -> Iterator[tuple[str, str]]:
    yield "FLOAT_COLOR", "POINT"
    yield "BYTE_COLOR", "CORNER"
    yield "FLOAT", "POINT"
    yield "FLOAT", "FACE"
    yield "FLOAT", "EDGE"
    yield "INT", "CORNER"
    yield "BOOLEAN", "FACE"
    yield "FLOAT2", "CORNER"
    yield "FLOAT_VECTOR", "POINT"
    if bpy.app.version >= (4, 0):
        yield "QUATERNION", "POINT"


def node(kind: str, output: str, *links: Any, **settings: Any) -> Make:
    """settings: of the node, and its inputs' values by name with underscores; links: (input, what makes its value)."""

    def make(tree: Any, ball: Any) -> Any:
        made = tree.nodes.new(f"ShaderNode{kind}")
        for key, value in settings.items():
            if hasattr(made, key):
                setattr(made, key, value)
            else:
                made.inputs[key.replace("_", " ")].default_value = value
        for name, inner in links:
            tree.links.new(inner(tree, ball), made.inputs[name])
        return made.outputs[output]

    return make


GENERATED = node("TexCoord", "Generated")
TURNED = node("VectorMath", "Vector", (0, node("TexCoord", "Normal")), (1, GENERATED), operation="ADD")
WIDE = node("VectorMath", "Vector", (0, node("TexCoord", "Object")), operation="SCALE", Scale=9.0)
WAVES = node("SeparateXYZ", "X", (0, node("VectorMath", "Vector", (0, WIDE), operation="SINE")))
BUMP = node("Bump", "Normal", ("Height", WAVES), Distance=0.2)


SINES = node("VectorMath", "Vector", (0, WIDE), operation="SINE")
GENTLE = node("Bump", "Normal", ("Height", WAVES), Distance=0.1)


def _tilted(tree: Any, ball: Any) -> Any:
    output = node("VectorMath", "Vector", (0, SINES), operation="MULTIPLY_ADD")(tree, ball)
    output.node.inputs[1].default_value, output.node.inputs[2].default_value = (0.2, 0.2, 0), (0.5, 0.5, 0.9)
    return output


LIT_PX, LIT_SAMPLES = 64, 64
LIT = {
    "diffuse bump": ("Diffuse", GENTLE),
    "glossy bump": ("Glossy", GENTLE),
    "diffuse map": ("Diffuse", node("NormalMap", "Normal", ("Color", _tilted), uv_map="UVMap")),
    "glossy map": ("Glossy", node("NormalMap", "Normal", ("Color", _tilted), uv_map="UVMap")),
    "constant": ("Diffuse", node("CombineXYZ", "Vector", X=0.1, Y=-0.9, Z=0.3)),
    "displacement": ("Diffuse", node("Displacement", "Displacement", ("Height", WAVES), Scale=0.2, Midlevel=0.0)),
}


def _cases() -> Iterator[tuple[str, Make]]:
    for output in ("Generated", "Normal", "UV", "Object", "Camera", "Window", "Reflection"):
        yield f"coordinate {output}", node("TexCoord", output)
    yield "coordinate of object", _of_object
    yield "from no instancer", node("TexCoord", "Generated", from_instancer=True)
    yield "UV of a name", node("UVMap", "UV", uv_map="UVMap")
    yield "UV of no name", node("UVMap", "UV", uv_map="none")
    for output in ("Position", "Normal", "Tangent", "True Normal", "Incoming", "Parametric", "Backfacing"):
        yield f"geometry {output}", node("NewGeometry", output)
    yield "geometry island", node("NewGeometry", "Random Per Island")
    yield "pointiness", _pointiness
    yield "pointiness of faces apart", _pointiness_apart
    for output in ("Location", "Color", "Alpha", "Object Index", "Material Index", "Random"):
        if output != "Alpha" or bpy.app.version >= (3, 5):
            yield f"object {output}", node("ObjectInfo", output)
    for output in ("Index", "Random"):
        yield f"particle {output}", node("ParticleInfo", output)
    for output in ("View Vector", "View Z Depth", "View Distance"):
        yield f"camera {output}", node("CameraData", output)
    for output in ("Is Camera Ray", "Is Diffuse Ray", "Is Reflection Ray", "Ray Length", "Ray Depth"):
        yield f"path {output}", node("LightPath", output)
    for output in ("Fresnel", "Facing"):
        yield f"layer {output}", node("LayerWeight", output, Blend=0.3)
        yield f"turned layer {output}", node("LayerWeight", output, ("Normal", TURNED), Blend=0.6)
    yield "fresnel", node("Fresnel", "Fac", IOR=1.7)
    yield "turned fresnel", node("Fresnel", "Fac", ("Normal", TURNED), IOR=1.2)
    yield "wireframe", node("Wireframe", "Fac", Size=0.1)
    yield "wireframe pixels", node("Wireframe", "Fac", Size=2.0, use_pixel_size=True)
    for axis in "XYZ":
        yield f"tangent {axis}", node("Tangent", "Tangent", axis=axis, direction_type="RADIAL")
    yield "tangent UV", node("Tangent", "Tangent", direction_type="UV_MAP", uv_map="UVMap")
    for kind, domain in _attributes():
        for output in ("Color", "Fac", "Alpha"):
            yield f"{kind} {domain} {output}", node("Attribute", output, attribute_name=f"{kind} {domain}")
    for output in ("Color", "Alpha"):
        yield f"active color {output}", node("VertexColor", output)
        yield f"color {output}", node("VertexColor", output, layer_name="FLOAT_COLOR POINT")
        yield f"no color {output}", node("VertexColor", output, layer_name="none")
        for kind, name in (("OBJECT", "odd"), ("OBJECT", "tint"), ("OBJECT", "color"), ("INSTANCER", "odd")):
            yield f"{kind} {name} {output}", node("Attribute", output, attribute_name=name, attribute_type=kind)
    for kind in ("POINT", "VECTOR", "NORMAL"):
        for start in ("WORLD", "OBJECT", "CAMERA"):
            for end in ("WORLD", "OBJECT", "CAMERA"):
                spaces = {"vector_type": kind, "convert_from": start, "convert_to": end}
                yield f"{kind} {start} {end}", node("VectorTransform", "Vector", ("Vector", TURNED), **spaces)
    for space in ("TANGENT", "OBJECT", "WORLD", "BLENDER_OBJECT", "BLENDER_WORLD"):
        for strength in (1.0, 0.4):
            settings = {"space": space, "Strength": strength}
            yield f"normal map {space} {strength}", node("NormalMap", "Normal", ("Color", GENERATED), **settings)
            if bpy.app.version >= (5, 2):
                settings["convention"] = "DIRECTX"
                yield f"DirectX map {space} {strength}", node("NormalMap", "Normal", ("Color", GENERATED), **settings)
    yield "bump", BUMP
    yield "weak bump", node("Bump", "Normal", ("Height", WAVES), Distance=0.3, Strength=0.4, invert=True)
    yield "bump of an image", _bump_of_image
    yield "bumped twice", node("Bump", "Normal", ("Height", GENERATED), ("Normal", BUMP), Distance=0.5)


def _pointiness(tree: Any, ball: Any) -> Any:
    """Of a ball with spikes and hollows, ten times what it is from 0.5."""
    for index, vertex in enumerate(ball.data.vertices):
        vertex.co *= 1 + 0.2 * math.sin(7 * index)
    output = node("Math", "Value", (0, node("NewGeometry", "Pointiness")), operation="MULTIPLY_ADD")(tree, ball)
    output.node.inputs[1].default_value, output.node.inputs[2].default_value = 10, -5
    return output


def _pointiness_apart(tree: Any, ball: Any) -> Any:
    """Where the faces' vertices are not the same, only at one place."""
    ball.modifiers.new("apart", "EDGE_SPLIT").split_angle = 0
    return _pointiness(tree, ball)


def _bump_of_image(tree: Any, ball: Any) -> Any:
    """By an image of waves, of pixels larger than the picture's: these are not averaged."""
    image = bpy.data.images.get("waves") or bpy.data.images.new("waves", 8, 8, float_buffer=True)
    x, y = np.meshgrid(np.arange(8) / 8, np.arange(8) / 8)
    wave = 0.5 + 0.5 * np.sin(2 * np.pi * (x + y))
    image.pixels.foreach_set(np.stack([wave, wave, wave, np.ones_like(wave)], axis=-1).astype(np.float32).ravel())
    texture = tree.nodes.new("ShaderNodeTexImage")
    texture.image, texture.interpolation = image, "Cubic"
    tree.links.new(GENERATED(tree, ball), texture.inputs["Vector"])
    bump = tree.nodes.new("ShaderNodeBump")
    bump.inputs["Distance"].default_value = 0.1
    tree.links.new(texture.outputs["Color"], bump.inputs["Height"])
    return bump.outputs["Normal"]


def _of_object(tree: Any, ball: Any) -> Any:
    target = parts.link("target", None, (1, 2, 3))
    target.rotation_euler, target.scale = (0.3, 0.2, 0.1), (2, 3, 4)
    return node("TexCoord", "Object", object=target)(tree, ball)
