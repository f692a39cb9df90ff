"""Blender's images as the core's, read once for as long as they stay as they are."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from types import ModuleType
from typing import Any

from ..ndf.image import ndf_pixels
from .image_parts import Tile, frame_shown, image_parts, image_state, opened
from .image_pixels import associates_alpha, stored_pixels

_Key = tuple[int, int | str]  # an image's address in Blender, and a frame, or what else it was read as


@dataclass(frozen=True)
class Picture:
    """An image as the core has it."""

    tiles: dict[Tile, Any]  # pivot_core.Image
    is_tiled: bool  # else its only tile is everywhere
    is_associated: bool  # whether colours are kept multiplied by alpha


@dataclass(frozen=True)
class _Entry:
    """An image as it was read."""

    state: Any  # of the image then; None: read it anew
    picture: Any  # Picture, or pivot_core.TabulatedNdf; None: there is none
    said: tuple[str, ...] = ()


class ImageCache:
    """What was read of Blender's images, for exports to come: an image is read again when it has changed."""

    def __init__(self) -> None:
        self._entries: dict[_Key, _Entry] = {}
        self._used: set[_Key] = set()

    def take(self, key: _Key, state: Any, read: Callable[[], _Entry]) -> _Entry:
        self._used.add(key)
        entry = self._entries.pop(key, None)
        if entry is None or state is None or entry.state != state:
            entry = None  # and its memory is free while the image is read
            entry = read()
        self._entries[key] = entry
        return entry

    def sweep(self) -> None:
        """Forget what nobody took since the last sweep."""
        self._entries = {key: entry for key, entry in self._entries.items() if key in self._used}
        self._used = set()


@dataclass
class ImageTable:
    """The core's images of a scene, each made when first asked for."""

    core: ModuleType  # pivot_core
    frame: int  # the scene's
    cache: ImageCache
    shows_frames: bool = False  # whether any picture is one of a sequence or movie
    _pictures: dict[tuple[int, int], Picture | None] = field(default_factory=dict)
    _ndfs: dict[int, Any] = field(default_factory=dict)
    _skies: dict[Any, Any] = field(default_factory=dict)

    def picture(self, image: Any, user: Any, warn: Callable[[str], None]) -> Picture | None:
        """What a node shows; None, and a warning, where there is nothing. user: its bpy.types.ImageUser."""
        frame = 0
        if image.source in {"SEQUENCE", "MOVIE"}:
            frame, self.shows_frames = frame_shown(user, self.frame), True
        key = (image.as_pointer(), frame)
        if key not in self._pictures:
            state = image_state(image, frame)
            entry = self.cache.take(key, state, lambda: self._read(image, frame, state))
            for text in entry.said:
                warn(f"image '{image.name}': {text}")
            self._pictures[key] = entry.picture
        return self._pictures[key]

    def sky(self, key: Any, pixels: Callable[[], Any]) -> Any:
        """pivot_core.Image of a sky. key: all that it depends on. pixels: makes it."""
        if key not in self._skies:
            entry = self.cache.take((0, repr(key)), key, lambda: _Entry(key, self.core.Image(pixels())))
            self._skies[key] = entry.picture
        return self._skies[key]

    def ndf(self, image: Any) -> Any:
        """pivot_core.TabulatedNdf of an image's red channel.

        Raises RenderError where it cannot be read, ValueError that says what is wrong with it.
        """
        key = image.as_pointer()
        if key not in self._ndfs:
            state = image_state(image, 0)
            entry = self.cache.take(
                (key, "ndf"), state, lambda: _Entry(state, self.core.TabulatedNdf(ndf_pixels(image)))
            )
            self._ndfs[key] = entry.picture
        return self._ndfs[key]

    def _read(self, image: Any, frame: int, state: Any) -> _Entry:
        said: list[str] = []
        tiles = self._tiles(image, frame, said.append)
        picture = Picture(tiles, image.source == "TILED", associates_alpha(image))
        return _Entry(state, picture if tiles else None, tuple(said))

    def _tiles(self, image: Any, frame: int, warn: Callable[[str], None]) -> dict[Tile, Any]:
        if image.source == "VIEWER":
            warn("viewer images are not supported, it is shown in pink. Fix: save it and choose the file")
            return {}
        tiles = {}
        for part in image_parts(image, frame):
            pixels, what = None, f" '{part.path}' is not there or not an image." if part.path else ""
            try:
                with opened(image, part) as own:
                    pixels = None if own is None else stored_pixels(own)
            except ValueError as error:
                what = f" {error}."
            if pixels is None:
                warn(f"it cannot be read and is shown in pink.{what} Fix: choose its file anew")
            else:
                tiles[part.tile] = self.core.Image(pixels.texels, srgb=pixels.srgb)
        return tiles
