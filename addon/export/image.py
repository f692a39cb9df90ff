"""Images as one colour."""

from __future__ import annotations

import bpy
import numpy as np
from numpy.typing import NDArray

from ..srgb import linear_from_srgb

_MAX_PIXELS = 1 << 20  # a mean needs no more


def mean_pixel(image: bpy.types.Image, equirectangular: bool = False) -> NDArray[np.float64] | None:
    """(4,) linear RGBA averaged over the image, or over the sphere it covers; None when it cannot be read."""
    width, height = image.size
    channels = image.channels
    if width * height * channels == 0:
        return None
    values = np.empty(width * height * channels, np.float32)
    image.pixels.foreach_get(values)
    pixels = values.reshape(height, width, channels)
    step = int(np.ceil(np.sqrt(max(1.0, width * height / _MAX_PIXELS))))
    pixels = pixels[::step, ::step].astype(np.float64)

    latitude = (np.arange(pixels.shape[0]) + 0.5) / pixels.shape[0] - 0.5
    weights = np.cos(np.pi * latitude) if equirectangular else np.ones_like(latitude)
    rgba = np.ones((*pixels.shape[:2], 4))
    rgba[..., :channels] = pixels
    if channels < 3:
        rgba[..., :3] = pixels[..., :1]
        rgba[..., 3] = pixels[..., 1] if channels == 2 else 1.0
    if not image.is_float and image.colorspace_settings.name == "sRGB":
        rgba[..., :3] = linear_from_srgb(rgba[..., :3])
    return np.average(rgba.mean(axis=1), axis=0, weights=weights)
