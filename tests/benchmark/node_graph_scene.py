"""Inside Blender: the plane that wears a random graph, its camera, and the images and attributes nodes can read."""

from __future__ import annotations

import math
import random
from typing import Any

import bpy

# isort: split
import mathutils
import numpy as np
from numpy.typing import NDArray

SIZE_PX = 64
SIDE = 6  # quads along an edge
HALF_M = 2.0
HEIGHT_M = 0.37  # above the object's origin: at 0 a rounding error decides which cell of a texture a point is in
UV_MAPS = ("UVMap", "Second")
COLOR_LAYERS = ("Color", "Bytes")
ATTRIBUTES = ("Height", "Flow", "tint", "missing", *UV_MAPS, *COLOR_LAYERS)
COLOR_SPACES = ("sRGB", "Linear", "Linear Rec.709", "Non-Color", "Raw")


def build(rng: random.Random) -> tuple[Any, Any]:
    """A new scene of a plane whose material has an Emission shader: the node tree and the shader."""
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    render = bpy.context.scene.render
    render.resolution_x = render.resolution_y = SIZE_PX
    render.resolution_percentage = 100
    _images(rng)
    material = bpy.data.materials.new("graph")
    if bpy.app.version < (5, 0):
        material.use_nodes = True
    tree: Any = material.node_tree
    tree.nodes.clear()
    emission = tree.nodes.new("ShaderNodeEmission")
    output = tree.nodes.new("ShaderNodeOutputMaterial")
    tree.links.new(emission.outputs[0], output.inputs["Surface"])
    _camera(rng, _plane(rng, material))
    return tree, emission


def _plane(rng: random.Random, material: Any) -> Any:
    """A grid of quads, flat or, smooth, of a quarter of the planes rolling; moved, some also turned and scaled."""
    xy = np.linspace(-HALF_M, HALF_M, SIDE + 1)
    x, y = (grid.ravel() for grid in np.meshgrid(xy, xy))
    rolling = rng.random() < 0.25
    z = HEIGHT_M + (0.15 * np.sin(2 * x) * np.cos(1.5 * y) if rolling else 0 * x)
    vertex = np.arange(len(x)).reshape(SIDE + 1, SIDE + 1)
    quads = np.stack([vertex[:-1, :-1], vertex[:-1, 1:], vertex[1:, 1:], vertex[1:, :-1]], axis=-1).reshape(-1, 4)
    mesh: Any = bpy.data.meshes.new("plane")
    mesh.from_pydata(np.stack([x, y, z], axis=-1).tolist(), [], quads.tolist())
    mesh.polygons.foreach_set("use_smooth", [rolling] * len(mesh.polygons))
    mesh.materials.append(material)
    _layers(rng, mesh, quads.ravel(), np.stack([x, y], axis=-1))
    plane: Any = bpy.data.objects.new("plane", mesh)
    plane.location = [rng.uniform(-1, 1) for _ in range(3)]
    if rng.random() < 0.5:
        plane.rotation_euler = [rng.uniform(-math.pi, math.pi) for _ in range(3)]
        plane.scale = [rng.uniform(0.7, 1.4) for _ in range(3)]
    plane.color = [rng.random() for _ in range(4)]
    plane.pass_index = rng.randrange(5)
    material.pass_index = rng.randrange(5)
    plane["tint"] = [rng.random() for _ in range(3)]
    bpy.context.scene.collection.objects.link(plane)
    bpy.context.view_layer.update()
    return plane


def _layers(rng: random.Random, mesh: Any, corner_vertex: NDArray[np.int64], xy: NDArray[np.float64]) -> None:
    """One or two UV maps, and colours and other attributes of random values."""
    draw = np.random.default_rng(rng.randrange(2**32))
    for name in UV_MAPS[: rng.choice((1, 2))]:
        linear = np.eye(2) if name == UV_MAPS[0] else draw.uniform(-1, 1, (2, 2))
        uv = (xy / (2 * HALF_M) @ linear + 0.5)[corner_vertex]
        mesh.uv_layers.new(name=name).data.foreach_set("uv", uv.ravel().astype(np.float32))
    if rng.random() < 0.7:
        for name, kind in zip(COLOR_LAYERS, ("FLOAT_COLOR", "BYTE_COLOR"), strict=True):
            layer = mesh.color_attributes.new(name=name, type=kind, domain=rng.choice(("POINT", "CORNER")))
            layer.data.foreach_set("color", draw.random(4 * len(layer.data)).astype(np.float32))
        height = mesh.attributes.new(name="Height", type="FLOAT", domain=rng.choice(("POINT", "FACE")))
        height.data.foreach_set("value", draw.uniform(-1, 1, len(height.data)).astype(np.float32))
        flow = mesh.attributes.new(name="Flow", type="FLOAT_VECTOR", domain="POINT")
        flow.data.foreach_set("vector", draw.uniform(-1, 1, 3 * len(flow.data)).astype(np.float32))


def _camera(rng: random.Random, plane: Any) -> None:
    """It sees nothing but the plane: a third of them obliquely, a fifth from behind."""
    world_from_plane = plane.matrix_world
    target = world_from_plane @ mathutils.Vector((0, 0, HEIGHT_M))
    normal = (world_from_plane.to_3x3().inverted().transposed() @ mathutils.Vector((0, 0, 1))).normalized()
    if rng.random() < 0.2:
        normal = -normal
    tilt_rad = rng.uniform(0.2, 0.75) if rng.random() < 1 / 3 else 0.0
    across = normal.orthogonal()
    across.rotate(mathutils.Quaternion(normal, rng.uniform(0, 2 * math.pi)))
    toward = mathutils.Quaternion(across, tilt_rad) @ normal
    distance_m = rng.uniform(4, 8)
    turn = toward.to_track_quat("Z", "Y") @ mathutils.Quaternion((0, 0, 1), rng.uniform(-0.3, 0.3))
    data = bpy.data.cameras.new("camera")
    data.angle = 2 * math.atan(0.45 * HALF_M * min(plane.scale) / distance_m)
    camera = bpy.data.objects.new("camera", data)
    camera.matrix_world = mathutils.Matrix.LocRotScale(target + distance_m * toward, turn, None)
    bpy.context.scene.collection.objects.link(camera)
    bpy.context.scene.camera = camera


def _images(rng: random.Random) -> None:
    """Four random pictures a few pixels wide: of bytes and floats, packed and generated, with alpha and without."""
    draw = np.random.default_rng(rng.randrange(2**32))
    for index in range(4):
        width, height = (int(side) for side in draw.integers(4, 24, 2))
        is_float, has_alpha = index >= 2, index % 2 == 1
        image: Any = bpy.data.images.new(f"image {index}", width, height, alpha=has_alpha, float_buffer=is_float)
        pixels = draw.random((height, width, 4)) * (1.5 if is_float else 1.0)
        pixels[..., 3] = draw.random((height, width)) if has_alpha else 1
        image.pixels.foreach_set(pixels.ravel().astype(np.float32))
        image.update()
        image.pack()
        spaces = type(image.colorspace_settings).bl_rna.properties["name"].enum_items.keys()
        image.colorspace_settings.name = rng.choice([space for space in COLOR_SPACES if space in spaces])
        if has_alpha:
            image.alpha_mode = rng.choice(("STRAIGHT", "PREMUL", "CHANNEL_PACKED", "NONE"))
    generated: Any = bpy.data.images.new("generated", 96, 64)
    generated.source = "GENERATED"
    generated.generated_type = rng.choice(("UV_GRID", "COLOR_GRID"))
