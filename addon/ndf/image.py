"""Pictures of microfacets between Blender's images and NumPy."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import bpy
import numpy as np
from numpy.typing import NDArray

from ..export.colour_spaces import scene_linear
from ..export.image_parts import image_parts, opened
from ..report import RenderError

_LINEAR_BYTES = {"Linear", "Linear Rec.709", "Raw"}  # color spaces that leave bytes as they are, beside those of data


def ndf_pixels(image: Any) -> NDArray[np.float32]:
    """(height, width): an image's red channel, linear, its bottom row (y = -1) first.

    Raises RenderError where the image has no pixels, or several pictures.
    """
    with _left_as_it_was(image):
        texels = image_texels(image)
        space = image.colorspace_settings
        if not image.is_float and not space.is_data and space.name not in _LINEAR_BYTES:
            texels = scene_linear(np.repeat(texels[..., :1], 3, axis=2), space.name)
    return np.ascontiguousarray(texels[..., 0])


def image_texels(image: Any) -> NDArray[np.float32]:
    """(height, width, channels), the bottom row first: bytes / 255 as they are stored, floats as Blender gives them.

    Raises RenderError.
    """
    if image.source not in {"FILE", "GENERATED"}:
        kind = image.bl_rna.properties["source"].enum_items[image.source].name
        raise RenderError(
            f"image '{image.name}': its source is {kind}, which is not supported here. Fix: choose a single image"
        )
    try:
        with _left_as_it_was(image), opened(image, next(image_parts(image, 0))) as own:
            texels = _texels(own)
    except ValueError as error:  # of layers that it cannot show
        raise RenderError(f"image '{image.name}': {error}. Fix: save it as a single layer") from error
    if not texels.size:
        raise RenderError(f"image '{image.name}': it has no pixels. Fix: choose its file anew, or another image")
    return texels


@contextmanager
def _left_as_it_was(image: Any) -> Iterator[None]:
    """Frees what Blender reads of a file, if it had not read it before."""
    was_loaded = image.has_data or image.is_dirty
    yield
    if not was_loaded and image.source == "FILE":
        image.buffers_free()


def _texels(image: Any) -> NDArray[np.float32]:
    width, height = image.size
    texels = np.empty((height, width, image.channels), np.float32)
    if texels.size:
        image.pixels.foreach_get(texels.ravel())
    return texels


def new_image(name: str, picture: NDArray[np.float32]) -> bpy.types.Image:
    """An image of floats, saved with the .blend. It is scaled to show: only the proportions of its pixels count."""
    size = len(picture)
    image = bpy.data.images.new(name, size, size, float_buffer=True, is_data=True)
    rgba = np.ones((size, size, 4), np.float32)
    rgba[..., :3] = (picture / picture.max())[..., None]
    image.pixels.foreach_set(rgba.ravel())
    image.pack()
    return image
