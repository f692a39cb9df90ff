"""Image textures by Cycles and by Pivot: a sample at the middle of each pixel of an emissive square or a world."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any
from unittest.mock import patch

import bpy
import numpy as np
import parts
from image_kinds import CASES, SIZE, generated, layers_without_colors, pixels, saved, texture, world

JITTER = 0.01  # of the step to a pixel's neighbours


def main(folder: Path) -> Any:
    """By case: the share of pixels that differ by more than Cycles' filter of 0.01 pixels can make, and how much they
    vary.
    """
    pictures = {name: _compared(make, folder) for name, make in CASES.items()}
    colorless = _compared(layers_without_colors, folder)["said"]
    return {"pictures": pictures, "colorless": colorless, "analytic": _analytic(folder), "kept": _kept(folder)}


def _analytic(folder: Path) -> Any:
    """A white square under a world of random texels."""
    parts.clear()
    parts.size(SIZE, SIZE)
    parts.quad("white", material=parts.shaded("white", "ShaderNodeBsdfDiffuse", Color=(1, 1, 1, 1))[0])
    parts.camera((0, 0, 1))
    world("EQUIRECTANGULAR")(None, folder)
    bpy.context.scene.pivot.integrator = "ANALYTIC"
    texels = pixels(16, 8, high=3.0)[..., :3].astype(float)
    latitude = (np.arange(8) + 0.5) / 8 - 0.5
    mean = np.average(texels.mean(axis=1), axis=0, weights=np.cos(np.pi * latitude))
    with _listening() as said:
        lit = _rendered("PIVOT", folder)[SIZE // 2, SIZE // 2]
    return {"lit": lit.tolist(), "mean": mean.tolist(), "said": said}


def _kept(folder: Path) -> Any:
    """What Blender keeps of an image in a file after a render that looked it up."""
    parts.clear()
    parts.size(SIZE, SIZE)
    material, _ = parts.shaded("picture", "ShaderNodeEmission")
    image = saved(folder, generated(9, 5), "PNG")
    texture(material.node_tree, image)
    parts.quad("square", material=material)
    parts.camera()
    for other in [other for other in bpy.data.images if other != image]:
        bpy.data.images.remove(other)
    image.buffers_free()
    _rendered("PIVOT", folder)
    return {"has_data": image.has_data, "images": len([i for i in bpy.data.images if i.type == "IMAGE"])}


def _compared(make: Callable[[Any, Path], Any], folder: Path) -> Any:
    parts.clear()
    parts.size(SIZE, SIZE)
    material, _ = parts.shaded("picture", "ShaderNodeEmission")
    if not make(material.node_tree, folder):
        square = parts.quad("square", material=material)
        square.scale, square.rotation_euler.x = (2, 1.5, 1), 0.1
        _uv(square.data)
        parts.camera((0.1, 0.2, 4.5))
    else:  # a world
        parts.camera((0, 0, 0), (1.2, 0.3, 0.4)).data.lens = 12
    expected = _rendered("CYCLES", folder)
    with _listening() as said:
        actual = _rendered("PIVOT", folder)
    error = np.abs(actual - expected) - JITTER * _steps(expected)
    wrong = (error > 1e-3 * (1 + np.abs(expected))).any(axis=2)
    return {"wrong": float(wrong.mean()), "varies": float(expected.std()), "said": said}


@contextmanager
def _listening() -> Iterator[list[str]]:
    """What is said meanwhile, but for the filter."""
    said: list[str] = []
    with patch("pivot.report.Reporter.warn", lambda _, text: "Filter" in text or said.append(text)):
        yield said


def _steps(picture: Any) -> Any:
    """By how much each pixel differs from those around it."""
    padded = np.pad(picture, ((1, 1), (1, 1), (0, 0)), mode="edge")
    around = [padded[y : y + SIZE, x : x + SIZE] for y in range(3) for x in range(3)]
    return np.max(around, axis=0) - np.min(around, axis=0)


def _uv(mesh: Any) -> None:
    layer = mesh.uv_layers.new(name="UV")
    for loop, uv in enumerate(((-0.7, -0.4), (1.6, -0.4), (1.6, 1.7), (-0.7, 1.7))):
        layer.data[loop].uv = uv


def _rendered(engine: str, folder: Path) -> Any:
    scene = bpy.context.scene
    scene.render.engine = engine
    scene.render.film_transparent = False
    if engine == "CYCLES":
        scene.cycles.samples, scene.cycles.filter_width, scene.cycles.use_denoising = 1, 0.01, False
        scene.cycles.use_adaptive_sampling = False
    else:
        scene.pivot.samples, scene.render.filter_size = 1, 0.01
    settings = scene.render.image_settings
    settings.file_format, settings.color_mode, settings.color_depth = "OPEN_EXR", "RGB", "32"
    scene.render.filepath = str(folder / f"{engine}.exr")
    bpy.ops.render.render(write_still=True)
    picture = bpy.data.images.load(scene.render.filepath)
    values = np.empty(SIZE * SIZE * 4, np.float32)
    picture.pixels.foreach_get(values)
    bpy.data.images.remove(picture)
    return values.reshape(SIZE, SIZE, 4)[..., :3]
