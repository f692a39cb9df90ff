"""What a texture node's lookups interpolate: the numbers of an image of Blender's, as they are stored.

Cycles reads a picture in a file itself, and takes from Blender what is packed, generated or a movie's; what it
interpolates differs for these. Pixels are kept here as they are in Cycles, and bytes as bytes. [C] is Cycles 4.5,
scene/image.cpp and scene/image_oiio.cpp, [C5] is Cycles 5.1, util/image_metadata.cpp.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import bpy
import numpy as np
from numpy.typing import NDArray

from ..srgb import srgb_from_linear
from .colour_spaces import scene_linear

_CHUNK = 1 << 20  # numbers that are converted at once
_LARGEST_HALF = np.float32(65504)
_NEWER = bpy.app.version >= (5, 1)  # Cycles, in how it reads images
_UNCONVERTED = {"Linear", "Linear Rec.709", "Raw"}  # beside those that are data


@dataclass(frozen=True)
class Pixels:
    texels: NDArray[Any]  # (height, width, channels), the first row is the bottom one
    srgb: bool = False  # whether colours are encoded so


def associates_alpha(image: Any) -> bool:
    """Whether colours count as multiplied by alpha. [C]"""
    return not image.colorspace_settings.is_data and image.alpha_mode not in {"CHANNEL_PACKED", "NONE"}


def _is_multiplied(image: Any) -> bool:
    """Whether Cycles multiplies the colours of bytes and words by alpha; a newer one only those that are said to be
    straight. [C, C5 finalize]
    """
    return associates_alpha(image) and (not _NEWER or image.alpha_mode == "STRAIGHT")


def _is_premultiplied(image: Any) -> bool:
    """Whether Blender divides by alpha what Cycles reads."""
    return _is_read_by_cycles(image) and associates_alpha(image) and image.alpha_mode == "PREMUL"


def _is_read_by_cycles(image: Any) -> bool:
    return image.source not in {"GENERATED", "MOVIE"} and not image.packed_file


def stored_pixels(image: Any) -> Pixels | None:
    """None where it cannot be read. Leaves Blender's own copy of a file's pixels as it was, read or not."""
    was_loaded = image.has_data
    if was_loaded and not image.is_dirty and image.source == "FILE" and not image.packed_file:
        image.buffers_free()  # the file may have changed since
    width, height = image.size
    channels = image.channels
    if width * height * channels == 0:
        return None
    values = np.empty((height, width, channels), np.float32)
    image.pixels.foreach_get(values.ravel())
    is_float = image.is_float
    is_words = is_float and image.file_format == "PNG" and _is_read_by_cycles(image)
    if not was_loaded and not image.is_dirty and image.source == "FILE":
        image.buffers_free()  # and now nothing may be asked of the image that reads it again
    if not is_float:
        return _stored_bytes(image, values)
    _clear_nonsense(values)
    return _stored_words(image, values) if is_words else _stored_floats(image, values)


def _chunks(texels: NDArray[Any]) -> Iterator[slice]:
    """Slices of the first axis, of about so many numbers each."""
    rows = max(1, _CHUNK // texels[0].size)
    return (slice(first, first + rows) for first in range(0, len(texels), rows))


def _stored_bytes(image: Any, values: NDArray[np.float32]) -> Pixels:
    """values: bytes / 255, as the file has them; overwritten, since they are four times the size of what is made."""
    channels = values.shape[2]
    if channels == 4 and _is_premultiplied(image):
        values[..., :3] *= values[..., 3:]
    space = image.colorspace_settings.name
    if channels >= 3 and not image.colorspace_settings.is_data and space not in {"sRGB", *_UNCONVERTED}:
        return _converted(image, values, space)
    numbers = values.ravel()
    texels = numbers.view(np.uint8)[: numbers.size]
    for part in _chunks(numbers):
        texels[part] = numbers[part] * np.float32(255) + np.float32(0.5)
    texels = texels.reshape(values.shape)
    if channels == 4:
        if image.alpha_mode == "NONE" or (texels[..., 3] == 255).all():
            texels = _without_alpha(texels)
        elif _is_multiplied(image):
            for rows in _chunks(texels):
                texels[rows, :, :3] = texels[rows, :, :3].astype(np.uint16) * texels[rows, :, 3:] // 255
    return Pixels(texels, space == "sRGB")


def _without_alpha(texels: NDArray[np.uint8]) -> NDArray[np.uint8]:
    """Overwrites them."""
    rgb = texels.ravel()[: texels.size // 4 * 3].reshape(*texels.shape[:2], 3)
    for rows in _chunks(texels):
        rgb[rows] = texels[rows, :, :3].copy()
    return rgb


def _converted(image: Any, values: NDArray[np.float32], space: str) -> Pixels:
    """Bytes / 255 of another colour space, scene linear as halves. Their steps count where a curve is steep. [C]"""
    texels = np.empty(values.shape, np.float16)
    if image.alpha_mode == "NONE":
        values[..., 3:] = 1
    associates = values.shape[2] == 4 and associates_alpha(image)
    is_in_halves = _is_read_by_cycles(image) or _NEWER  # before it is multiplied
    for rows in _chunks(values):
        part = values[rows].astype(np.float16).astype(np.float32) if is_in_halves else values[rows].copy()
        if associates and _is_multiplied(image):
            part[..., :3] *= part[..., 3:]
        part = _in_halves(part)
        alpha = np.where(part[..., 3:] > 0, part[..., 3:], 1) if associates else np.float32(1)
        part[..., :3] = scene_linear(part[..., :3] / alpha, space) * alpha
        texels[rows] = _in_halves(part)
    return Pixels(texels)


def _in_halves(values: NDArray[np.float32]) -> NDArray[np.float32]:
    """What is left in a half: a newer Cycles rounds, an older one cuts off. [C, C5 util/half.h]"""
    halves = values.clip(-_LARGEST_HALF, _LARGEST_HALF)
    if _NEWER:
        return halves.astype(np.float16).astype(np.float32)
    return (halves.view(np.uint32) & np.uint32(0xFFFFE000)).view(np.float32)


def _clear_nonsense(values: NDArray[np.float32]) -> None:
    """Where a number is not finite all are 0."""
    for rows in _chunks(values):
        finite = np.isfinite(values[rows]).all(axis=2)
        if not finite.all():
            values[rows][~finite] = 0


def _stored_floats(image: Any, values: NDArray[np.float32]) -> Pixels:
    """Blender has multiplied straight colours by alpha. An older Cycles leaves those of a file straight; a newer one
    multiplies what Blender gives it once more. [C, C5]
    """
    colours, alpha = values[..., :3], values[..., 3:]
    if image.alpha_mode == "NONE":
        alpha[:] = 1
    elif values.shape[2] == 4 and associates_alpha(image) and image.alpha_mode == "STRAIGHT":
        if _NEWER and not _is_read_by_cycles(image):
            colours *= alpha
        elif not _NEWER and _is_read_by_cycles(image):
            np.divide(colours, alpha, out=colours, where=alpha > 0)
    return Pixels(_as_halves(values))


def _as_halves(values: NDArray[np.float32]) -> NDArray[Any]:
    """In half the memory where nothing is lost by it."""
    halves = np.empty(values.shape, np.float16)
    with np.errstate(over="ignore"):
        for rows in _chunks(values):
            halves[rows] = values[rows]
            if not np.array_equal(halves[rows], values[rows]):
                return values
    return halves


def _stored_words(image: Any, values: NDArray[np.float32]) -> Pixels:
    """The 16 bits of a PNG file, which Blender has made linear and multiplied by alpha; Cycles keeps most."""
    space = image.colorspace_settings
    if not space.is_data and space.name not in {"sRGB", *_UNCONVERTED}:  # Cycles makes linear halves of them
        return Pixels(_as_halves(values))
    srgb = space.name == "sRGB"
    if image.alpha_mode == "NONE":
        values[..., 3:] = 1
    texels = np.empty(values.shape, np.uint16)
    associates = values.shape[2] == 4 and associates_alpha(image)
    for rows in _chunks(values):
        part = values[rows].astype(np.float64)
        if associates:
            part[..., :3] /= np.where(part[..., 3:] > 0, part[..., 3:], 1)
        if srgb:
            part[..., :3] = srgb_from_linear(part[..., :3])
        if associates and _is_premultiplied(image):
            part[..., :3] *= part[..., 3:]
        texels[rows] = np.clip(part, 0, 1) * 65535 + 0.5
        if associates and _is_multiplied(image):
            texels[rows, :, :3] = texels[rows, :, :3].astype(np.uint32) * texels[rows, :, 3:] // 65535
    return Pixels(texels, srgb)
