"""Pictures by the real core: every pass, two view layers, two frames, borders; as files in the folder."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import bpy
import parts

RED, EMISSION = (0.8, 0.1, 0.05, 1), (0.5, 0.25, 1, 1)
SIZE = 32
PASSES = ("z", "normal", "position", "diffuse_color", "emit")


def main(folder: Path) -> Any:
    _scene()
    _save(folder / "animation_", animation=True)
    scene = bpy.context.scene
    scene.frame_set(1)

    render = scene.render
    render.use_border = True
    render.border_min_x, render.border_max_x, render.border_min_y, render.border_max_y = 0.5, 1.0, 0.25, 0.75
    _save(folder / "border.exr")
    render.use_crop_to_border = True
    _save(folder / "crop.exr")
    render.use_border = False

    _save(folder / "seed0.exr")
    _save(folder / "seed0_again.exr")
    render.threads_mode, render.threads = "FIXED", 1
    _save(folder / "one_thread.exr")
    render.threads_mode = "AUTO"
    scene.pivot.seed = 1
    _save(folder / "seed1.exr")
    scene.pivot.integrator = "ANALYTIC"
    _save(folder / "analytic.exr")
    render.film_transparent = False
    _save(folder / "opaque.exr")
    render.use_multiview, render.views_format = True, "STEREO_3D"
    render.image_settings.views_format = "MULTIVIEW"
    _save(folder / "stereo.exr")
    return None


def _scene() -> None:
    """From above: a 2 m red square on the ground, above its right half a small lamp that moves left in frame 2."""
    parts.clear()
    parts.camera((0, 0, 5)).data.lens = 72  # sees 2.5 m of the ground
    parts.size(SIZE, SIZE)
    parts.world((0.25, 0.25, 0.25))
    parts.quad("ground", material=parts.shaded("red", "ShaderNodeBsdfDiffuse", Color=RED, Roughness=0)[0])
    lamp = parts.quad("lamp", (0.5, 0, 1), parts.shaded("lamp", "ShaderNodeEmission", Color=EMISSION, Strength=4)[0])
    lamp.scale = (0.25, 0.25, 1)
    lamp.keyframe_insert("location", frame=1)
    lamp.location.x = -0.5
    lamp.keyframe_insert("location", frame=2)
    parts.quad("shrunk to a point", (0, 0, 2)).scale = (0, 0, 0)
    parts.light("sun", "SUN", energy=1.0)

    scene = bpy.context.scene
    scene.frame_start, scene.frame_end = 1, 2
    scene.pivot.samples = 4
    scene.render.engine = "PIVOT"
    scene.render.film_transparent = True
    scene.render.filter_size = 0.01
    scene.render.dither_intensity = 0
    first = scene.view_layers[0]
    first.name = "first"
    for name in PASSES:
        setattr(first, f"use_pass_{name}", True)
    first.pivot.use_pass_method = first.pivot.use_pass_error = first.pivot.use_pass_indirect = True
    first.cycles.use_pass_volume_direct = first.cycles.use_pass_volume_indirect = True
    clay = scene.view_layers.new("clay")
    clay.material_override = parts.shaded("clay", "ShaderNodeBsdfDiffuse", Color=(0.5, 0.5, 0.5, 1))[0]
    clay.use_pass_diffuse_color = True
    clay.use_pass_z = False

    collection = bpy.data.collections.new("lamps")
    scene.collection.children.link(collection)
    scene.collection.objects.unlink(lamp)
    collection.objects.link(lamp)
    clay.layer_collection.children["lamps"].exclude = True


def _save(path: Path, animation: bool = False) -> None:
    scene = bpy.context.scene
    image = scene.render.image_settings
    if bpy.app.version >= (5, 0):
        image.media_type = "MULTI_LAYER_IMAGE"
    image.file_format, image.color_depth = "OPEN_EXR_MULTILAYER", "32"
    scene.render.filepath = str(path)
    bpy.ops.render.render(animation=animation, write_still=not animation)
