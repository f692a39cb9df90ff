"""IES files, which tell how strongly a lamp shines each way, as Cycles reads them. [C] is its 4.5: util/ies.cpp.

Only the photometric types C, which most files are of, are read.
"""

from __future__ import annotations

import re

import bpy
import numpy as np
from numpy.typing import NDArray

_ROWS, _COLUMNS = 361, 720
_WATT_PER_CANDELA = 0.0706650768394  # 4 pi / 177.83: of light like D65, and the whole lamp's [C]
_HAS_SEAM = bpy.app.version[:2] == (4, 5)  # it takes 0 for what is beyond 0 and 360 degrees around; 3.4 and 5.2 do not

Floats = NDArray[np.float64]


class IesError(ValueError):
    """What is wrong with a file."""


def ies_picture(text: str) -> NDArray[np.float32]:
    """(_ROWS, _COLUMNS, 3): what Blender's node gives; rows from straight down to straight up, columns all around."""
    down_deg, around_deg, intensity = read_ies(text)
    rows = np.linspace(0, 180, _ROWS)
    columns = (np.arange(_COLUMNS) + 0.5) * (360 / _COLUMNS)
    picture = _smooth(around_deg, intensity, columns, is_closed=True)
    picture = _smooth(down_deg, picture.T, rows, is_closed=False)
    picture[(rows < down_deg[0]) | (rows > down_deg[-1])] = 0
    return np.repeat(np.maximum(picture, 0)[..., None], 3, axis=-1).astype(np.float32)


def read_ies(text: str) -> tuple[Floats, Floats, Floats]:
    """(V,) angles from straight down, (H,) from 0 to 360 around, ascending, and (H, V) intensities. [C]"""
    start = re.search(r"^TILT=(\S*).*$", text, re.MULTILINE)
    if start is None:
        raise IesError("it has no line TILT=")
    words = re.split(r"[\s,]+", text[start.end() :].strip())
    try:
        numbers = np.array(words, float)
    except ValueError as error:
        raise IesError("it has words where numbers should be") from error
    if start[1] == "INCLUDE":  # how the lamp is held: an angle and a factor for each of some
        numbers = numbers[2 + 2 * int(numbers[1]) :]
    if len(numbers) < 13:
        raise IesError("it ends too early")
    down_count, around_count, kind = (int(number) for number in numbers[3:6])
    if kind != 1:
        raise IesError("its photometric type is not C")
    parts = np.split(numbers[13:], np.cumsum([down_count, around_count, down_count * around_count]))
    if min(down_count, around_count) < 1 or len(parts[2]) < down_count * around_count:
        raise IesError("it ends too early")
    factor = numbers[2] * numbers[10] * numbers[11] * _WATT_PER_CANDELA
    down, around, intensity = parts[0], parts[1], parts[2].reshape(around_count, down_count) * factor
    if down[0] == 90:
        down, intensity = 180 - down[::-1], intensity[:, ::-1]
    return down, *_all_around(around, intensity)


def _all_around(around: Floats, intensity: Floats) -> tuple[Floats, Floats]:
    """What symmetry leaves out of a file. [C]"""
    if around[0] == 90:
        around = around - 90
    if len(around) == 1:
        return np.array([0.0, 360.0]), np.repeat(intensity, 2, axis=0)
    for whole in (180.0, 360.0):
        if around[-1] == whole / 2:
            around = np.concatenate([around, whole - around[-2::-1]])
            intensity = np.concatenate([intensity, intensity[-2::-1]])
    if around[-1] != 360:
        around, intensity = np.append(around, 360), np.concatenate([intensity, intensity[:1]])
    return around, intensity


def _smooth(at: Floats, values: Floats, wanted: Floats, is_closed: bool) -> Floats:
    """(W, ...): values at places by Catmull and Rom's cubics, as if these stood evenly.

    is_closed: the last is the first; else the values are mirrored there. [C]
    """
    if len(at) == 1:
        return np.repeat(values, len(wanted), axis=0)
    last = len(at) - 1
    i = np.clip(np.searchsorted(at, wanted, side="right") - 1, 0, last - 1)
    x = np.clip((wanted - at[i]) / (at[i + 1] - at[i]), 0, 1).reshape(-1, *[1] * (values.ndim - 1))
    before, behind = i - 1, i + 2
    if is_closed:
        seam = (before < 0, behind > last) if _HAS_SEAM else (None, None)
        before, behind = before % last, behind % last
    else:
        seam = None, None
        before, behind = np.abs(before), np.where(behind > last, last - 1, behind)
    a, b, c, d = (values[index] for index in (before, i, i + 1, behind))
    for beyond, is_beyond in zip((a, d), seam, strict=True):
        if is_beyond is not None:
            beyond[is_beyond] = 0
    return 0.5 * (((d + 3 * (b - c) - a) * x + (2 * a - 5 * b + 4 * c - d)) * x + (c - a)) * x + b
