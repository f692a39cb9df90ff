"""Blender's images as the core's: which files and frames a texture node shows."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from types import ModuleType
from typing import Any

import bpy
import numpy as np
from numpy.typing import NDArray

from .image_pixels import associates_alpha, stored_pixels

Tile = tuple[int, int]  # along u and v, from 0


@dataclass(frozen=True)
class Picture:
    """An image as the core has it."""

    tiles: dict[Tile, Any]  # pivot_core.Image
    is_tiled: bool  # else its only tile is everywhere
    is_associated: bool  # whether colours are kept multiplied by alpha

    def mean(self, equirectangular: bool = False) -> NDArray[np.float64]:
        """(4,) linear RGBA averaged over the picture, or over the sphere that it covers."""
        image = next(iter(self.tiles.values()))
        levels = (image.level(index) for index in range(image.level_count))
        rgba = next(level for level in levels if level.shape[0] <= 64).astype(np.float64)
        latitude = (np.arange(rgba.shape[0]) + 0.5) / rgba.shape[0] - 0.5
        weights = np.cos(np.pi * latitude) if equirectangular else np.ones_like(latitude)
        return np.average(rgba.mean(axis=1), axis=0, weights=weights)


@dataclass
class ImageTable:
    """The core's images of a scene, each made when first asked for."""

    core: ModuleType  # pivot_core
    frame: int  # the scene's
    _pictures: dict[tuple[int, int], Picture | None] = field(default_factory=dict)  # by Blender's address, and frame

    def picture(self, image: Any, user: Any, warn: Callable[[str], None]) -> Picture | None:
        """What a node shows; None, and a warning, where there is nothing. user: its bpy.types.ImageUser."""
        frame = _frame(user, self.frame) if image.source == "SEQUENCE" else 0
        key = (image.as_pointer(), frame)
        if key not in self._pictures:
            tiles = self._tiles(image, frame, lambda text: warn(f"image '{image.name}': {text}"))
            picture = Picture(tiles, image.source == "TILED", associates_alpha(image))
            self._pictures[key] = picture if tiles else None
        return self._pictures[key]

    def _tiles(self, image: Any, frame: int, warn: Callable[[str], None]) -> dict[Tile, Any]:
        kind = "multilayer" if image.type == "MULTILAYER" else image.source.lower()
        if kind in {"multilayer", "movie", "viewer"}:
            warn(f"{kind} images are not supported, it is shown in pink")
            return {}
        if image.source == "TILED" and image.packed_file and len(image.tiles) > 1:
            warn("tiles that are packed are not supported, all but the first are pink. Fix: unpack it")
        tiles = {}
        for tile, path in _parts(image, frame):
            with _opened(image, path, warn) as part:
                pixels = None if part is None else stored_pixels(part, warn)
            if pixels is None:
                where = bpy.path.abspath(path or image.filepath, library=image.library)
                what = f" '{where}' is not there or not an image." if where else ""
                warn(f"it cannot be read and is shown in pink.{what} Fix: choose its file anew")
            else:
                tiles[tile] = self.core.Image(pixels.texels, srgb=pixels.srgb)
        return tiles


def _frame(user: Any, scene_frame: int) -> int:
    """The frame of a sequence that a node shows."""
    length = user.frame_duration
    if length == 0:
        return 0
    frame = scene_frame - user.frame_start + 1
    if user.use_cyclic:
        frame = (frame - 1) % length + 1
    return min(max(frame, 1), length) + user.frame_offset


def _parts(image: Any, frame: int) -> Iterator[tuple[Tile, str]]:
    """The files that an image is made of; an empty path is the image itself."""
    if image.source == "TILED" and not image.packed_file:
        for number in (tile.number for tile in image.tiles):
            u, v = (number - 1001) % 10, (number - 1001) // 10
            path = image.filepath.replace("<UDIM>", str(number)).replace("<UVTILE>", f"u{u + 1}_v{v + 1}")
            yield (u, v), path
    elif image.source == "SEQUENCE":
        digits = list(re.finditer(r"\d+", bpy.path.basename(image.filepath)))
        start = len(image.filepath) - len(bpy.path.basename(image.filepath))
        if digits:
            begin, end = (start + place for place in digits[-1].span())
            yield (0, 0), f"{image.filepath[:begin]}{frame:0{end - begin}d}{image.filepath[end:]}"
    else:
        yield (0, 0), ""


@contextmanager
def _opened(image: Any, path: str, warn: Callable[[str], None]) -> Iterator[Any]:
    """The image, or with a path another of the same settings; None where there is no such file."""
    if not path:
        yield image
        return
    try:
        other = bpy.data.images.load(bpy.path.abspath(path, library=image.library), check_existing=False)
    except RuntimeError:
        yield None
        return
    try:
        try:
            _take_settings(other, image)
        except AttributeError:  # Blender lets nobody set a property while it draws
            warn("in the 3D view frames and tiles have their files' own color space and alpha mode")
        yield other
    finally:
        bpy.data.images.remove(other)


def _take_settings(image: Any, other: Any) -> None:
    if image.alpha_mode != other.alpha_mode:
        image.alpha_mode = other.alpha_mode
    if image.colorspace_settings.name != other.colorspace_settings.name:
        image.colorspace_settings.name = other.colorspace_settings.name
