"""Denoising by Open Image Denoise: the library that this Python, this Blender or the system has, by its C interface.

[OIDN] https://www.openimagedenoise.org/documentation.html
"""

from __future__ import annotations

import ctypes
import functools
import importlib.util
import weakref
from collections.abc import Callable, Iterator
from ctypes.util import find_library
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import bpy
import numpy as np
from numpy.typing import NDArray

from . import denoise_blend
from .denoise_filter import softened
from .report import Reporter

HOW_TO_GET_IT = (
    "install Open Image Denoise: the Python package pyoidn, a Blender from blender.org, or the system's library"
)
_DEVICE_CPU = 1  # OIDNDeviceType
_FORMAT_FLOAT3 = 3  # OIDNFormat
_LEFT = {"INDIRECT": 0.1**2, "ALL": 0.05**2}  # squared noise over squared light that may stay in direct light
_FEW = 0.01  # the part of a picture's pixels that may have more before it is denoised
_QUALITY_FAST = 4  # OIDNQuality, from version 2.3 on

Pixels = NDArray[np.float32]


class DenoiserError(Exception):
    """Open Image Denoise could not do it; says why, and the fix."""


def is_there() -> bool:
    return _library() is not None


def viewport_mode_of(scene: bpy.types.Scene) -> str:
    """scene.pivot.denoise_viewport, 'NONE' for analytic pictures and without the library."""
    can = scene.pivot.integrator != "ANALYTIC" and is_there()
    return str(scene.pivot.denoise_viewport) if can else "NONE"


def mode_of(scene: bpy.types.Scene, reporter: Reporter) -> str:
    """scene.pivot.denoise; 'NONE' for analytic pictures, which have no noise, and, saying so, without the library."""
    pivot = scene.pivot
    if pivot.denoise == "NONE" or pivot.integrator == "ANALYTIC":
        return "NONE"
    if not is_there():
        reporter.warn(f"scene '{scene.name}', Denoise: there is no denoiser, noise stays. Fix: {HOW_TO_GET_IT}")
        return "NONE"
    return str(pivot.denoise)


@dataclass(frozen=True)
class Guides:
    """What is seen where there is no noise, each (height, width, 3)."""

    albedo: Pixels
    normal: Pixels
    edge_px: int = 1  # of their pixels, in the picture's


@dataclass(frozen=True)
class Denoised:
    """A picture, (height, width, 4), and what is known of its light."""

    combined: Pixels
    indirect: Pixels  # (height, width, 3)
    direct_kept: Pixels | float  # how much of direct light is as it was, of each pixel or of all


class Denoiser:
    """It keeps what it last filtered with, for pictures like that one. One thread at a time may use it."""

    def __init__(self, filter_width_px: float = 1.0, is_quick: bool = False) -> None:
        """filter_width_px: of the picture's pixel filter, as pivot_core.RenderSettings has it; 1: the box. is_quick: in
        a tenth of the time, and a little worse."""
        self.filter_width_px = filter_width_px
        self._is_quick = is_quick
        self._filter: _Filter | None = None

    def denoised(self, mode: str, read: Callable[[str], Pixels], guides: Guides | None = None) -> Denoised:
        """The picture without noise.

        Light that bounced is denoised, and direct light where its noise is above what the mode leaves, which is more
        for 'INDIRECT' than for 'ALL': shadows and highlights stay sharp. read: takes a pass name of
        pivot_core.Session, whose settings have denoising_passes. guides: those of the picture where they are known.
        Raises DenoiserError.
        """
        guides = guides or self.guides(read)
        edge_px = guides.edge_px
        combined, indirect = read("Combined"), read("Indirect")
        noisy_indirect, shown = _binned(read("Noisy Indirect"), edge_px), _binned(combined[..., :3], edge_px)
        direct, kept = combined[..., :3] - indirect, 1.0
        of_direct, of_indirect = (
            denoise_blend.relative_noise(_binned(read(f"{light} Variance"), edge_px), shown)
            for light in ("Direct", "Indirect")
        )
        is_told = of_indirect.any()  # which takes samples that come together
        if _is_noisy(of_direct, _LEFT[mode]) if is_told else mode == "ALL":
            noisy_image = _binned(read("Noisy Image")[..., :3], edge_px)
            clean = self._own_light(np.maximum(noisy_image - noisy_indirect, 0), guides)
            kept = 0.0
            if is_told:
                seen = _binned(direct, edge_px)
                kept = denoise_blend.share_kept(seen, clean, of_direct, _LEFT[mode], shown, edge_px**2)
                kept = _spread(kept, edge_px, *direct.shape[:2])
            direct = kept * direct + (1 - kept) * _spread(clean, edge_px, *direct.shape[:2])
        if not is_told or _is_noisy(of_indirect, _LEFT["INDIRECT"]):
            indirect = _spread(self._own_light(noisy_indirect, guides), edge_px, *indirect.shape[:2])
        return Denoised(np.concatenate([direct + indirect, combined[..., 3:]], axis=-1), indirect, kept)

    def guides(self, read: Callable[[str], Pixels], edge_px: int = 1) -> Guides:
        """What a picture's light is filtered by. edge_px: by pixels of that edge, which takes the less time the larger
        they are. read: as of denoised()."""
        albedo, normal = (_binned(read(f"Denoising {name}"), edge_px) for name in ("Albedo", "Normal"))
        if not self._is_quick:
            albedo, normal = self._filtered(albedo=albedo), self._filtered(normal=normal)
        return Guides(albedo, normal, edge_px)

    def light(self, noisy: Pixels, guides: Guides) -> Pixels:
        """All light of a picture or some, by the guides' pixels, (height, width, 3), without noise."""
        return self._filtered(color=noisy, albedo=guides.albedo, normal=guides.normal) if noisy.any() else noisy

    def _own_light(self, noisy: Pixels, guides: Guides) -> Pixels:
        """As light(), of pixels' own samples, and as the pixel filter shows it where that is seen."""
        clean = self.light(noisy, guides)
        return clean if guides.edge_px > 1 else softened(clean, self.filter_width_px)

    def _filtered(self, **images: Pixels) -> Pixels:
        """One image without noise, (height, width, 3): color, which may be of any range, by albedo and normal; or
        these."""
        kind = tuple(images), next(iter(images.values())).shape
        if self._filter is None or self._filter.kind != kind:
            self._filter = None  # and its memory is free for the next
            self._filter = _Filter(*kind, self._is_quick)
        return self._filter.run(images)


def _is_noisy(noise: Pixels, left: float) -> bool:
    return bool(np.mean(noise > left) > _FEW)


def _binned(image: Pixels, edge_px: int) -> Pixels:
    """Means over squares of pixels, (height, width, channels); those at the end reach past it, over its last pixels."""
    if edge_px == 1:
        return image
    past = [-side % edge_px for side in image.shape[:2]]
    whole = np.pad(image, ((0, past[0]), (0, past[1]), (0, 0)), mode="edge") if any(past) else image
    rows = sum(whole[first::edge_px] for first in range(edge_px))
    binned: Pixels = sum(rows[:, first::edge_px] for first in range(edge_px)) / np.float32(edge_px**2)
    return binned


def _spread(image: Pixels, edge_px: int, height: int, width: int) -> Pixels:
    """What _binned() made as large as it was, in squares."""
    return image if edge_px == 1 else image.repeat(edge_px, axis=0).repeat(edge_px, axis=1)[:height, :width]


def _candidates() -> Iterator[str]:
    """Where the library may be, the likeliest first."""
    package = importlib.util.find_spec("pyoidn")
    if package is not None and package.origin is not None:
        yield str(Path(package.origin).parent / "oidn" / "lib" / "libOpenImageDenoise.so")
    of_blender = Path(bpy.utils.resource_path("LOCAL")).parent
    yield from map(str, sorted(of_blender.glob("lib/libOpenImageDenoise.so*")))
    of_system = find_library("OpenImageDenoise")
    if of_system is not None:
        yield of_system


@functools.cache
def _library() -> Any | None:
    for candidate in _candidates():
        try:
            library: Any = ctypes.CDLL(candidate)
        except OSError:
            continue
        library.set_filter_number = getattr(library, "oidnSetFilterInt", None)  # from version 2 on
        handle, text, size, flag = ctypes.c_void_p, ctypes.c_char_p, ctypes.c_size_t, ctypes.c_bool
        # Before version 2 these had other names.
        library.set_filter_flag = getattr(library, "oidnSetFilterBool", None) or library.oidnSetFilter1b
        library.set_device_flag = getattr(library, "oidnSetDeviceBool", None) or library.oidnSetDevice1b
        signatures = [
            (library.oidnNewDevice, [ctypes.c_int], handle),
            (library.oidnCommitDevice, [handle], None),
            (library.oidnReleaseDevice, [handle], None),
            (library.oidnGetDeviceError, [handle, ctypes.POINTER(text)], ctypes.c_int),
            (library.oidnNewFilter, [handle, text], handle),
            (library.oidnSetSharedFilterImage, [handle, text, handle, ctypes.c_int] + [size] * 5, None),
            (library.set_filter_flag, [handle, text, flag], None),
            (library.set_device_flag, [handle, text, flag], None),
            (library.oidnCommitFilter, [handle], None),
            (library.oidnExecuteFilter, [handle], None),
            (library.oidnReleaseFilter, [handle], None),
        ]
        if library.set_filter_number is not None:
            signatures.append((library.set_filter_number, [handle, text, ctypes.c_int], None))
        for function, arguments, result in signatures:
            function.argtypes, function.restype = arguments, result
        return library
    return None


class _Filter:
    """Open Image Denoise's, for images of these names and one shape."""

    def __init__(self, names: tuple[str, ...], shape: tuple[int, ...], is_quick: bool) -> None:
        """shape: (height, width, 3). is_quick: albedo and normal, which color goes by, are noisy."""
        library = _library()
        if library is None:
            raise DenoiserError(f"there is no denoiser. Fix: {HOW_TO_GET_IT}")
        self.kind = names, shape
        self._library = library
        self._device = library.oidnNewDevice(_DEVICE_CPU)
        # It would bind Blender's own threads to cores; and in Debian's Blender the search for these ends in a crash.
        library.set_device_flag(self._device, b"setAffinity", False)
        library.oidnCommitDevice(self._device)
        self._filter = library.oidnNewFilter(self._device, b"RT")
        release = weakref.finalize(self, _release, library, self._filter, self._device)
        release.atexit = False  # type: ignore[misc]  # the library's threads may be gone by then
        self._images = {name: np.zeros(shape, np.float32) for name in (*names, "output")}
        for name, image in self._images.items():
            library.oidnSetSharedFilterImage(
                self._filter, name.encode(), image.ctypes.data, _FORMAT_FLOAT3, shape[1], shape[0], 0, 0, 0
            )
        if "color" in names:
            library.set_filter_flag(self._filter, b"hdr", True)
            library.set_filter_flag(self._filter, b"cleanAux", not is_quick)
        # What light goes by is as good in a quarter of the time.
        if (is_quick or "color" not in names) and library.set_filter_number is not None:
            library.set_filter_number(self._filter, b"quality", _QUALITY_FAST)
            library.oidnGetDeviceError(self._device, None)  # a version that does not know it does without
        library.oidnCommitFilter(self._filter)

    def run(self, images: dict[str, Pixels]) -> Pixels:
        for name, image in images.items():
            self._images[name][:] = image
        self._library.oidnExecuteFilter(self._filter)
        message = ctypes.c_char_p()
        if self._library.oidnGetDeviceError(self._device, ctypes.byref(message)) != 0:
            text = (message.value or b"").decode()
            raise DenoiserError(f"Open Image Denoise failed, noise stays: {text}. Fix: set Denoise to None")
        return self._images["output"].copy()


def _release(library: Any, denoiser: int, device: int) -> None:
    library.oidnReleaseFilter(denoiser)
    library.oidnReleaseDevice(device)
