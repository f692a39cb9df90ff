"""Colours as Blender's nodes reckon with them: hue, saturation, value and lightness, and the types of blending.

A colour is (3,) linear RGB of any size, negative too. [C] is Cycles 4.5, kernel/svm/color_util.h and util/color.h,
whose choices beyond 0..1 these follow.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

Colour = NDArray[np.float64]  # (3,) linear RGB

LUMINANCE = np.array((0.2126, 0.7152, 0.0722))  # of linear Rec. 709


def _hue(rgb: Colour) -> float:
    """0..1, of a colour that has one."""
    red, green, blue = rgb
    largest, span = rgb.max(), np.ptp(rgb)
    if red == largest:
        return float((green - blue) / span / 6 % 1)
    return float((2 + (blue - red) / span if green == largest else 4 + (red - green) / span) / 6)


def hsv_from_rgb(rgb: Colour) -> Colour:
    largest, span = rgb.max(), np.ptp(rgb)
    saturation = span / largest if largest != 0 else 0.0
    return np.array((_hue(rgb) if saturation != 0 else 0.0, saturation, largest))


def rgb_from_hsv(hsv: Colour) -> Colour:
    hue, saturation, value = hsv
    if saturation == 0:
        return np.full(3, value)
    sector = math.floor((0 if hue == 1 else hue) * 6)
    fraction = (0 if hue == 1 else hue) * 6 - sector
    low, falling, rising = (value * (1 - saturation * part) for part in (1, fraction, 1 - fraction))
    sectors = (
        (value, rising, low),
        (falling, value, low),
        (low, value, rising),
        (low, falling, value),
        (rising, low, value),
        (value, low, falling),
    )
    return np.array(sectors[sector if 0 <= sector < 6 else 5])  # [C] for hues beyond 0..1


def hsl_from_rgb(rgb: Colour) -> Colour:
    largest, smallest = rgb.max(), rgb.min()
    lightness = min(1.0, (largest + smallest) / 2)
    if largest == smallest:
        return np.array((0.0, 0.0, lightness))
    saturation = np.ptp(rgb) / ((2 - largest - smallest) if lightness > 0.5 else (largest + smallest))
    return np.array((_hue(rgb), saturation, lightness))


def rgb_from_hsl(hsl: Colour) -> Colour:
    hue, saturation, lightness = hsl
    pure = np.array((abs(hue * 6 - 3) - 1, 2 - abs(hue * 6 - 2), 2 - abs(hue * 6 - 4)))
    return (np.clip(pure, 0, 1) - 0.5) * (1 - abs(2 * lightness - 1)) * saturation + lightness


def mixed(factor: float | Colour, a: Colour, b: Colour) -> Colour:
    return (1 - factor) * a + factor * b


def blend(kind: str, factor: float, a: Colour, b: Colour) -> Colour:
    """kind: Blender's blend_type. Raises KeyError for one that is not known."""
    with np.errstate(all="ignore"):
        return _BLENDS[kind](factor, a, b)


def _screen(factor: float, a: Colour, b: Colour) -> Colour:
    return 1 - (1 - factor * b) * (1 - a)


def _overlay(factor: float, a: Colour, b: Colour) -> Colour:
    rest = 1 - factor
    return np.where(a < 0.5, a * (rest + 2 * factor * b), 1 - (rest + 2 * factor * (1 - b)) * (1 - a))


def _divide(factor: float, a: Colour, b: Colour) -> Colour:
    return np.where(b != 0, mixed(factor, a, a / np.where(b != 0, b, 1)), a)


def _dodge(factor: float, a: Colour, b: Colour) -> Colour:
    rest = 1 - factor * b
    brightened = np.where(rest <= 0, 1, np.minimum(a / np.where(rest > 0, rest, 1), 1))
    return np.where(a != 0, brightened, a)


def _burn(factor: float, a: Colour, b: Colour) -> Colour:
    kept = 1 - factor + factor * b
    return np.where(kept <= 0, 0, np.clip(1 - (1 - a) / np.where(kept > 0, kept, 1), 0, 1))


def _hue_of(factor: float, a: Colour, b: Colour) -> Colour:
    hue, saturation, _ = hsv_from_rgb(b)
    return a if saturation == 0 else mixed(factor, a, rgb_from_hsv(np.array((hue, *hsv_from_rgb(a)[1:]))))


def _saturation_of(factor: float, a: Colour, b: Colour) -> Colour:
    hue, saturation, value = hsv_from_rgb(a)
    if saturation == 0:
        return a
    return rgb_from_hsv(np.array((hue, (1 - factor) * saturation + factor * hsv_from_rgb(b)[1], value)))


def _value_of(factor: float, a: Colour, b: Colour) -> Colour:
    hue, saturation, value = hsv_from_rgb(a)
    return rgb_from_hsv(np.array((hue, saturation, (1 - factor) * value + factor * hsv_from_rgb(b)[2])))


def _colour_of(factor: float, a: Colour, b: Colour) -> Colour:
    hue, saturation, _ = hsv_from_rgb(b)
    return a if saturation == 0 else mixed(factor, a, rgb_from_hsv(np.array((hue, saturation, hsv_from_rgb(a)[2]))))


def _soft_light(factor: float, a: Colour, b: Colour) -> Colour:
    return mixed(factor, a, (1 - a) * b * a + a * _screen(1.0, a, b))


_BLENDS: dict[str, Callable[[float, Colour, Colour], Colour]] = {
    "MIX": mixed,
    "ADD": lambda factor, a, b: a + factor * b,
    "SUBTRACT": lambda factor, a, b: a - factor * b,
    "MULTIPLY": lambda factor, a, b: mixed(factor, a, a * b),
    "DIVIDE": _divide,
    "DIFFERENCE": lambda factor, a, b: mixed(factor, a, np.abs(a - b)),
    "EXCLUSION": lambda factor, a, b: np.maximum(mixed(factor, a, a + b - 2 * a * b), 0),
    "DARKEN": lambda factor, a, b: mixed(factor, a, np.minimum(a, b)),
    "LIGHTEN": lambda factor, a, b: mixed(factor, a, np.maximum(a, b)),
    "SCREEN": _screen,
    "OVERLAY": _overlay,
    "DODGE": _dodge,
    "BURN": _burn,
    "SOFT_LIGHT": _soft_light,
    "LINEAR_LIGHT": lambda factor, a, b: a + factor * (2 * b - 1),
    "HUE": _hue_of,
    "SATURATION": _saturation_of,
    "VALUE": _value_of,
    "COLOR": _colour_of,
}
