"""The files that an image of Blender's is made of, and each as an image whose pixels Blender gives.

These are the image's own pixels, or those of another datablock for as long as they are read: a tile, a frame, a layer.
"""

from __future__ import annotations

import mmap
import os
import re
import struct
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from typing import Any

import bpy

from .layered_exr import first_layer

Tile = tuple[int, int]  # along u and v, from 0


@dataclass(frozen=True)
class Part:
    tile: Tile
    path: str  # absolute; empty where there is no file
    is_own: bool = True  # whether the image's own pixels are the part's
    packed: Any = None  # bpy.types.PackedFile of a part that is not
    frame: int = 0  # of a movie


def frame_shown(user: Any, scene_frame: int) -> int:
    """The frame that a node shows of what has several. user: its bpy.types.ImageUser."""
    length = user.frame_duration
    if length == 0:
        return 0
    frame = scene_frame - user.frame_start + 1
    if user.use_cyclic:
        frame = (frame - 1) % length + 1
    return min(max(frame, 1), length) + user.frame_offset


def image_parts(image: Any, frame: int) -> Iterator[Part]:
    path = bpy.path.abspath(image.filepath, library=image.library)
    if image.source == "TILED":
        packed = {part.tile_number: part.packed_file for part in image.packed_files}
        for number in (tile.number for tile in image.tiles):
            u, v = (number - 1001) % 10, (number - 1001) // 10
            file = path.replace("<UDIM>", str(number)).replace("<UVTILE>", f"u{u + 1}_v{v + 1}")
            yield Part((u, v), "" if packed else file, is_own=False, packed=packed.get(number))
    elif image.packed_file or image.source == "GENERATED":
        yield Part((0, 0), "")
    elif image.source == "MOVIE":
        yield Part((0, 0), path, is_own=False, frame=frame)
    elif image.source == "SEQUENCE":
        folder, name = os.path.split(path)
        digits = list(re.finditer(r"\d+", name))
        if digits:
            begin, end = digits[-1].span()
            name = f"{name[:begin]}{frame:0{end - begin}d}{name[end:]}"
            yield Part((0, 0), os.path.join(folder, name), is_own=False)
    else:
        yield Part((0, 0), path)


def image_state(image: Any, frame: int) -> Any:
    """What is equal while the image's pixels are as they were; None where that cannot be told.

    Asks for nothing that makes Blender read the image.
    """
    if image.is_dirty:  # painted upon, or set by a script
        return None
    settings = (image.source, image.alpha_mode, image.colorspace_settings.name, image.use_deinterlace)
    generated = (
        image.generated_type,
        image.generated_width,
        image.generated_height,
        image.use_generated_float,
        tuple(image.generated_color),
    )
    packed = [(part.packed_file.as_pointer(), part.packed_file.size) for part in image.packed_files]
    files = [(part.tile, part.path, _file_state(part.path)) for part in image_parts(image, frame)]
    return settings, generated, packed, files


def _file_state(path: str) -> tuple[int, int] | None:
    with suppress(OSError):
        status = os.stat(path)
        return status.st_mtime_ns, status.st_size
    return None


@contextmanager
def opened(image: Any, part: Part) -> Iterator[Any]:
    """A part as an image with the image's settings; None where there is no such file. Raises ValueError, of a layer."""
    with bpy.data.temp_data() as aside:  # from Blender 5.2 on, a render that changes its own data crashes
        yield _opened(image, part, aside)


def _opened(image: Any, part: Part, aside: bpy.types.BlendData) -> Any:
    if part.packed is not None:
        return _image_of(part.packed.data, image, aside)
    layer = _first_layer(image, part)
    if layer is not None:
        return _image_of(layer, image, aside)
    if part.is_own:
        return image
    try:
        other = aside.images.load(part.path, check_existing=False)
    except RuntimeError:
        return None
    if other.source == "MOVIE":
        _show_frame(other, part.frame, aside)  # and Blender says now what its color space is
    _take_settings(other, image)
    return other


def _image_of(data: bytes, image: Any, aside: bpy.types.BlendData) -> Any:
    """data: a file's."""
    other = aside.images.new("part", 1, 1)
    other.pack(data=data, data_len=len(data))
    other.source = "FILE"
    _take_settings(other, image)
    return other


def _first_layer(image: Any, part: Part) -> bytes | None:
    """A file of what Cycles reads of a file of layers; None where it is none, or broken: Blender finds that as well."""
    if not image.filepath.lower().endswith(".exr") or image.source == "GENERATED":
        return None
    with suppress(OSError, IndexError, KeyError, struct.error):
        if image.packed_file:
            return first_layer(image.packed_file.data)
        if os.path.getsize(part.path):
            with open(part.path, "rb") as file, mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ) as data:
                return first_layer(data)
    return None


def _show_frame(movie: Any, frame: int, aside: bpy.types.BlendData) -> None:
    """Blender gives the pixels of the frame that was looked up last."""
    texture = aside.textures.new("frame", "IMAGE")
    texture.image = movie
    texture.image_user.frame_current = frame
    texture.evaluate((0, 0, 0))


def _take_settings(image: Any, other: Any) -> None:
    if image.alpha_mode != other.alpha_mode:
        image.alpha_mode = other.alpha_mode
    if other.colorspace_settings.name not in {"", image.colorspace_settings.name}:
        image.colorspace_settings.name = other.colorspace_settings.name
    if image.use_deinterlace != other.use_deinterlace:
        image.use_deinterlace = other.use_deinterlace
