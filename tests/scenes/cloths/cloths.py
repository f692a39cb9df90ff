"""Three hanging cloths whose microfacets are pictures: a silk of two yarns, a satin of one, and a knit gathered from
its height map. Writes cloths.png here.

./run python tests/scenes/cloths/cloths.py [SAMPLES]
"""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import bpy

# isort: split
import addon_utils
import numpy as np
from mathutils import Vector

SIZE_PX = (960, 400)
GRID = 240
CLOTHS = {  # the colour, how metallic, and what draws its microfacets
    "silk": ((0.5, 0.02, 0.05), 0.7, lambda: bpy.ops.pivot.ndf_weave(share=0.5)),
    "satin": ((0.03, 0.16, 0.3), 0.8, lambda: bpy.ops.pivot.ndf_draw(roughness_x=0.75, roughness_y=0.25)),
    "knit": (
        (0.45, 0.26, 0.05),
        0.5,
        lambda: bpy.ops.pivot.ndf_from_map(image=_knit().name, kind="HEIGHT", height=0.012, roughness=0.35),
    ),
}


def _knit() -> Any:
    """A height map of loops."""
    u, v = np.meshgrid(*(2 * (np.arange(128) / 128 * 2 * np.pi),) * 2)
    height = 0.5 + 0.25 * np.cos(u) * np.cos(v + np.cos(u)) + 0.25 * np.cos(v / 2) ** 2
    image = bpy.data.images.new("knit", 128, 128, float_buffer=True, is_data=True)
    image.pixels.foreach_set(np.dstack([height] * 3 + [np.ones_like(height)]).astype(np.float32).ravel())
    image.pack()
    return image


def _cloth(name: str, x: float) -> Any:
    """1.8 m wide and 2 m long, in folds that deepen towards its end."""
    across, down = np.meshgrid(np.linspace(0, 1, GRID), np.linspace(0, 1, GRID))
    depth = 0.05 + 0.13 * down
    folds = np.sin(across * 15 + 0.6 * np.sin(5 * down + x)) + 0.35 * np.sin(across * 31 + 3 * down)
    points = np.stack([x + 1.7 * (across - 0.5), depth * folds, 2.1 - 2 * down], -1)
    corner = (np.arange(GRID - 1)[:, None] * GRID + np.arange(GRID - 1)).ravel()
    faces = np.stack([corner, corner + GRID, corner + GRID + 1, corner + 1], 1)
    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata(points.reshape(-1, 3).tolist(), [], faces.tolist())
    mesh.polygons.foreach_set("use_smooth", np.ones(len(faces), bool))
    layer = mesh.uv_layers.new(name="UVMap")
    uv = np.stack([across, 1 - down], -1).reshape(-1, 2)[faces.ravel()]
    layer.data.foreach_set("uv", uv.astype(np.float32).ravel())
    made = bpy.data.objects.new(name, mesh)
    bpy.context.scene.collection.objects.link(made)
    bpy.context.view_layer.objects.active = made
    return made


def _lamp(name: str, location: tuple[float, float, float], energy: float, size: float) -> None:
    data = bpy.data.lights.new(name, "AREA")
    data.energy, data.size = energy, size
    made = bpy.data.objects.new(name, data)
    made.location = location
    bpy.context.scene.collection.objects.link(made)
    made.rotation_euler = _towards(location, (0, 0, 1))


def _towards(eye: tuple[float, float, float], target: tuple[float, float, float]) -> Any:
    return (Vector(target) - Vector(eye)).to_track_quat("-Z", "Y").to_euler()


def main(samples: int) -> None:
    addon_utils.enable("pivot")
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    scene = bpy.context.scene
    scene.render.engine = "PIVOT"
    for place, (name, (colour, metallic, draw)) in enumerate(CLOTHS.items()):
        cloth = _cloth(name, 1.9 * (place - 1))
        material = bpy.data.materials.new(name)
        material.use_nodes = True
        principled = next(node for node in material.node_tree.nodes if node.type == "BSDF_PRINCIPLED")
        principled.inputs["Base Color"].default_value = (*colour, 1)
        principled.inputs["Metallic"].default_value = metallic
        cloth.data.materials.append(material)
        draw()
    _lamp("key", (-3, -4, 4), 260, 0.5)
    _lamp("rim", (4, -2.5, 2.5), 130, 0.4)
    world = bpy.data.worlds.new("world")
    world.color = (0.03, 0.03, 0.035)
    scene.world = world
    scene.camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    scene.camera.location, scene.camera.data.lens = (0, -7.2, 1.4), 44
    scene.camera.rotation_euler = _towards(scene.camera.location, (0, 0, 1.08))
    scene.collection.objects.link(scene.camera)
    scene.pivot.samples, scene.pivot.max_bounces, scene.pivot.filter_glossy = samples, 2, 1.0
    scene.render.resolution_x, scene.render.resolution_y = SIZE_PX
    scene.view_settings.view_transform = "Standard"
    scene.render.filepath = str(Path(__file__).parent / "cloths.png")
    bpy.ops.render.render(write_still=True)


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 64)
