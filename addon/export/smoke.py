"""Smoke and fire of fluid domains. [Blender intern/cycles/blender/volume.cpp]"""

from __future__ import annotations

from typing import Any

import bpy
import numpy as np

from .grids import Grid, Grids

_CHANNELS = {"density": 1, "color": 4, "flame": 1, "heat": 1, "temperature": 1}


def smoke_domain(blender_object: bpy.types.Object) -> Any | None:
    """The settings of the domain that an object is, None for others."""
    modifiers = (each for each in blender_object.modifiers if each.type == "FLUID" and each.fluid_type == "DOMAIN")
    return next((each.domain_settings for each in modifiers if each.domain_settings.domain_type == "GAS"), None)


def has_smoke(domain: Any, frame: int) -> bool:
    """Whether it has been simulated at the frame."""
    return domain.cache_frame_start <= frame <= domain.cache_frame_end and len(domain.density_grid) > 0


def smoke_grids(blender_object: bpy.types.Object, domain: Any) -> Grids:
    """By the names that Cycles gives them."""
    return Grids(lambda name: _read(name, domain, blender_object.data), key=blender_object.original.as_pointer())


def _read(name: str, domain: Any, mesh: bpy.types.Mesh) -> Grid | None:
    if name not in _CHANNELS:
        return None
    stored, channels = getattr(domain, f"{name}_grid"), _CHANNELS[name]
    values = np.empty(len(stored), np.float32)
    stored.foreach_get(values)
    finer = domain.noise_scale if domain.use_noise else 1
    for amplified in (finer, 1):  # heat is as coarse as the simulation without noise
        x, y, z = (n * amplified for n in domain.domain_resolution)
        if len(values) == x * y * z * channels:
            return Grid(values.reshape(z, y, x, channels), _grid_from_object(mesh, (x, y, z)))
    return None


def _grid_from_object(mesh: bpy.types.Mesh, size: tuple[int, int, int]) -> np.ndarray:
    """The mesh's texture space is as wide as all voxels; values are at their centres."""
    half = np.array(mesh.texspace_size, float)
    half[half == 0] = 1
    scale = np.array(size) / (2 * half)
    matrix = np.diag([*scale, 1.0])
    matrix[:3, 3] = -scale * (np.array(mesh.texspace_location) - half) - 0.5
    return matrix
