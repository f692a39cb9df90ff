"""A red wall's light on a floor, noisy, denoised, and where there is no denoiser; pictures in the folder."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import bpy
import numpy as np
import parts
from pivot import denoise, engine, passes

SAMPLES = 4
SETTINGS = {"noisy": "NONE", "indirect": "INDIRECT", "all": "ALL"}


def main(folder: Path) -> dict[str, Any]:
    """Writes NAME.exr of each of SETTINGS, converged.exr, analytic.exr and absent.exr; returns what was said."""
    _scene()
    scene = bpy.context.scene
    image, pivot = scene.render.image_settings, scene.pivot
    scene.render.engine = "PIVOT"
    scene.render.film_transparent = True
    image.file_format, image.color_depth, image.color_mode = "OPEN_EXR", "32", "RGBA"

    def render(name: str) -> list[str]:
        engine.PivotRenderEngine.said_in_job.clear()
        scene.render.filepath = str(folder / f"{name}.exr")
        bpy.ops.render.render(write_still=True)
        return sorted(engine.PivotRenderEngine.frame_count.warnings)

    pivot.samples = SAMPLES
    said = {}
    for name, pivot.denoise in SETTINGS.items():
        said[name] = render(name)
    found = denoise.is_there()
    denoise._library.cache_clear()
    candidates, denoise._candidates = denoise._candidates, lambda: iter(["/nowhere/libOpenImageDenoise.so"])
    said["absent"] = render("absent")
    denoise._candidates = candidates
    denoise._library.cache_clear()
    pivot.integrator = "ANALYTIC"
    said["analytic"] = render("analytic")
    pivot.integrator, pivot.denoise, pivot.samples = "MONTE_CARLO", "NONE", 2048
    render("converged")
    _light_passes(folder)
    return {"found": found, "said": said, "passes": _denoising_data(folder), "grey": found and _of_grey_noise()}


def _of_grey_noise() -> dict[str, list[float]]:
    """The mean and deviation of noise of mean 1, and after pictures of it were denoised by one Denoiser."""
    noise = np.random.default_rng(1).uniform(0, 2, (47, 65, 1)).astype(np.float32)
    direct, grey = np.full((47, 65, 3), 2, np.float32), np.full((47, 65, 3), 0.5, np.float32)
    indirect = np.repeat(noise, 3, axis=-1)
    combined = np.concatenate([direct + indirect, np.ones_like(noise)], axis=-1)
    read = {"Combined": combined, "Indirect": indirect, "Noisy Indirect": indirect}
    read |= {"Noisy Image": combined, "Denoising Albedo": grey, "Denoising Normal": grey}
    read |= {"Direct Variance": np.zeros_like(noise), "Indirect Variance": np.full_like(noise, 1 / 3)}
    denoiser, result = denoise.Denoiser(is_quick=True), {"noisy": combined}
    for name, mode, edge_px in (("coarse", "ALL", 3), ("indirect", "INDIRECT", 2), ("fine", "ALL", 1)):
        guides = denoiser.guides(read.__getitem__, edge_px)
        result[name] = denoiser.denoised(mode, read.__getitem__, guides).combined
    # The noise is direct light's, or for all that is known what is seen.
    read |= {"Indirect": np.zeros_like(direct), "Noisy Indirect": np.zeros_like(direct)}
    for name, variance in (("direct", 1 / 3), ("seen", 0)):
        read["Direct Variance"] = np.full_like(noise, variance)
        result[name] = denoiser.denoised("INDIRECT", read.__getitem__).combined
    return {
        name: [*picture.shape, float(picture[..., :3].mean()), float(picture[..., :3].std())]
        for name, picture in result.items()
    }


def _light_passes(folder: Path) -> None:
    """Writes passes-NAME.exr of each of SETTINGS and of converged: light by what reflects it and by group, and more."""
    scene, layer = bpy.context.scene, bpy.context.view_layer
    parts.light("other lamp", "POINT", (-0.5, 0, 0.8), energy=10, shadow_soft_size=0.1)
    scene.objects["lamp"].lightgroup = layer.lightgroups.add(name="key").name
    for lobe in ("diffuse", "glossy", "transmission"):
        for kind in ("direct", "indirect", "color"):
            setattr(layer, f"use_pass_{lobe}_{kind}", True)
    layer.use_pass_emit = layer.use_pass_environment = layer.pivot.use_pass_indirect = True
    layer.use_pass_cryptomatte_object = layer.use_pass_z = True
    image = scene.render.image_settings
    if hasattr(image, "media_type"):  # from Blender 5.0
        image.media_type = "MULTI_LAYER_IMAGE"
    image.file_format = "OPEN_EXR_MULTILAYER"
    for name, mode in (SETTINGS | {"converged": "NONE"}).items():
        scene.pivot.denoise, scene.pivot.samples = mode, 512 if name == "converged" else SAMPLES
        scene.render.filepath = str(folder / f"passes-{name}.exr")
        bpy.ops.render.render(write_still=True)
    scene.pivot.denoise = "NONE"


def _denoising_data(folder: Path) -> list[str]:
    """The channels of a file with Denoising Data on."""
    scene = bpy.context.scene
    scene.pivot.samples = 1
    scene.view_layers[0].cycles.denoising_store_passes = True
    image = scene.render.image_settings
    if hasattr(image, "media_type"):  # from Blender 5.0
        image.media_type = "MULTI_LAYER_IMAGE"
    image.file_format = "OPEN_EXR_MULTILAYER"
    scene.render.filepath = str(folder / "data.exr")
    bpy.ops.render.render(write_still=True)
    return [entry.blender_name() for entry in passes.PASSES if entry.switch == "denoising_store_passes"]


def _scene() -> None:
    parts.clear()
    parts.size(64, 48)
    parts.camera((0, -3, 2.5), (math.radians(50), 0, 0))
    grey = parts.shaded("grey", "ShaderNodeBsdfDiffuse", Color=(0.8, 0.8, 0.8, 1))[0]
    red = parts.shaded("red", "ShaderNodeBsdfDiffuse", Color=(0.8, 0.1, 0.1, 1))[0]
    floor = parts.quad("floor", material=grey)
    floor.scale = (1.5, 1.5, 1)
    for side in (-1, 1):
        wall = parts.quad(f"wall {side}", (side, 0, 1), red)
        wall.rotation_euler = (0, math.pi / 2, 0)
    parts.light("lamp", "POINT", (0.3, 0, 1.2), energy=30, shadow_soft_size=0.2)
