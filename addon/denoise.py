"""Denoising by Open Image Denoise: the library that this Python, this Blender or the system has, by its C interface.

[OIDN] https://www.openimagedenoise.org/documentation.html
"""

from __future__ import annotations

import ctypes
import functools
import importlib.util
from collections.abc import Callable, Iterator
from ctypes.util import find_library
from pathlib import Path
from typing import Any

import bpy
import numpy as np
from numpy.typing import NDArray

from .report import Reporter

HOW_TO_GET_IT = (
    "install Open Image Denoise: the Python package pyoidn, a Blender from blender.org, or the system's library"
)
_DEVICE_CPU = 1  # OIDNDeviceType
_FORMAT_FLOAT3 = 3  # OIDNFormat
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


def denoised(mode: str, read: Callable[[str], Pixels], is_quick: bool = False) -> Pixels:
    """Combined, (height, width, 4): its light without noise, its alpha as it was.

    mode: 'ALL', or 'INDIRECT', which keeps direct light as it is: shadows and highlights stay sharp.
    read: takes a pass name of pivot_core.Session, whose settings have denoising_passes. is_quick: in a tenth of the
    time, and a little worse. Raises DenoiserError.
    """
    albedo, normal = read("Denoising Albedo"), read("Denoising Normal")
    if not is_quick:
        albedo, normal = _filtered(albedo=albedo), _filtered(normal=normal)
    combined = read("Combined")
    if mode == "ALL":
        light = _filtered(is_quick, color=read("Noisy Image")[..., :3], albedo=albedo, normal=normal)
    else:
        direct = combined[..., :3] - read("Indirect")
        light = direct + _filtered(is_quick, color=read("Noisy Indirect"), albedo=albedo, normal=normal)
    return np.concatenate([light, combined[..., 3:]], axis=-1)


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


def _filtered(is_quick: bool = False, **images: Pixels) -> Pixels:
    """One image without noise, (height, width, 3): color, which may be of any range, by albedo and normal; or these.

    is_quick: albedo and normal, which color goes by, are noisy.
    """
    library = _library()
    if library is None:
        raise DenoiserError(f"there is no denoiser. Fix: {HOW_TO_GET_IT}")
    device = library.oidnNewDevice(_DEVICE_CPU)
    try:
        # It would bind Blender's own threads to cores; and in Debian's Blender the search for these ends in a crash.
        library.set_device_flag(device, b"setAffinity", False)
        library.oidnCommitDevice(device)
        denoiser = library.oidnNewFilter(device, b"RT")
        output = np.zeros_like(next(iter(images.values())), order="C")
        buffers = {name: np.ascontiguousarray(image, np.float32) for name, image in images.items()} | {"output": output}
        height, width = output.shape[:2]
        for name, buffer in buffers.items():
            library.oidnSetSharedFilterImage(
                denoiser, name.encode(), buffer.ctypes.data, _FORMAT_FLOAT3, width, height, 0, 0, 0
            )
        if "color" in images:
            library.set_filter_flag(denoiser, b"hdr", True)
            library.set_filter_flag(denoiser, b"cleanAux", not is_quick)
        if is_quick and library.set_filter_number is not None:
            library.set_filter_number(denoiser, b"quality", _QUALITY_FAST)
            library.oidnGetDeviceError(device, None)  # a version that does not know it does without
        library.oidnCommitFilter(denoiser)
        library.oidnExecuteFilter(denoiser)
        library.oidnReleaseFilter(denoiser)
        message = ctypes.c_char_p()
        if library.oidnGetDeviceError(device, ctypes.byref(message)) != 0:
            text = (message.value or b"").decode()
            raise DenoiserError(f"Open Image Denoise failed, noise stays: {text}. Fix: set Denoise to None")
    finally:
        library.oidnReleaseDevice(device)
    return output
