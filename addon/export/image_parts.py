"""The files that an image of Blender's is made of: one, those of its tiles, or that of a frame."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from typing import Any

import bpy

Tile = tuple[int, int]  # along u and v, from 0


@dataclass(frozen=True)
class Part:
    tile: Tile
    path: str  # absolute; empty where there is no file
    is_own: bool = True  # whether the image's own pixels are the part's


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
    if image.packed_file or image.source == "GENERATED":
        yield Part((0, 0), "")
    elif image.source == "TILED":
        for number in (tile.number for tile in image.tiles):
            u, v = (number - 1001) % 10, (number - 1001) // 10
            yield Part(
                (u, v),
                path.replace("<UDIM>", str(number)).replace("<UVTILE>", f"u{u + 1}_v{v + 1}"),
                is_own=False,
            )
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
    settings = (image.source, image.alpha_mode, image.colorspace_settings.name)
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
    """A part as an image of its own, with the image's settings; None where there is no such file."""
    if part.is_own:
        yield image
        return
    try:
        other = bpy.data.images.load(part.path, check_existing=False)
    except RuntimeError:
        yield None
        return
    try:
        _take_settings(other, image)
        yield other
    finally:
        bpy.data.images.remove(other)


def _take_settings(image: Any, other: Any) -> None:
    if image.alpha_mode != other.alpha_mode:
        image.alpha_mode = other.alpha_mode
    if image.colorspace_settings.name != other.colorspace_settings.name:
        image.colorspace_settings.name = other.colorspace_settings.name
