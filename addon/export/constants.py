"""Shader nodes computed from constants, a row of the table for each, with Cycles' meaning."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, Protocol

import numpy as np

from .arithmetic import divided, scalar_math, vector_math
from .blackbody import blackbody
from .colour import LUMINANCE, Colour, blend, hsl_from_rgb, hsv_from_rgb, mixed, rgb_from_hsl, rgb_from_hsv


class Node(Protocol):
    """A node whose inputs are read as constants."""

    @property
    def node(self) -> Any: ...

    @property
    def output(self) -> str:
        """The identifier of the output that is asked for."""

    def number(self, *identifiers: str | int, unknown: float | None = None) -> float:
        """unknown: for an input that has no nearest constant; None: its own value."""

    def colour(self, *identifiers: str | int) -> Colour:
        """Vectors are colours here."""

    def warn(self, text: str) -> None: ...


def _grey(value: Any) -> Colour:
    return np.full(3, float(value))


def _math(node: Node) -> Colour:
    value = float(scalar_math(node.node.operation, *(node.number(index) for index in range(3))))
    return _grey(np.clip(value, 0, 1) if node.node.use_clamp else value)


def _vector_math(node: Node) -> Colour:
    a, b, c = (node.colour(index) for index in range(3))
    return vector_math(node.node.operation, a, b, c, node.number("Scale"))


def _mix_rgb(node: Node) -> Colour:
    factor = np.clip(node.number("Fac"), 0, 1)
    result = blend(node.node.blend_type, factor, node.colour("Color1"), node.colour("Color2"))
    return np.clip(result, 0, 1) if node.node.use_clamp else result


def _mix(node: Node) -> Colour:
    kind = node.node.data_type
    uneven = kind == "VECTOR" and node.node.factor_mode == "NON_UNIFORM"
    factor: Any = node.colour("Factor_Vector") if uneven else node.number("Factor_Float")
    if node.node.clamp_factor:
        factor = np.clip(factor, 0, 1)
    if kind == "FLOAT":
        return _grey(mixed(factor, node.number("A_Float"), node.number("B_Float")))
    if kind != "RGBA":
        return mixed(factor, node.colour("A_Vector"), node.colour("B_Vector"))
    result = blend(node.node.blend_type, factor, node.colour("A_Color"), node.colour("B_Color"))
    return np.clip(result, 0, 1) if node.node.clamp_result else result


def _combined(node: Node) -> Colour:
    return np.array([node.number(index) for index in range(3)])


def _separated(node: Node, parts: Colour) -> Colour:
    index = next(i for i, socket in enumerate(node.node.outputs) if socket.identifier == node.output)
    return _grey(parts[index])


_FROM_RGB: dict[str, Callable[[Colour], Colour]] = {"RGB": np.array, "HSV": hsv_from_rgb, "HSL": hsl_from_rgb}
_TO_RGB: dict[str, Callable[[Colour], Colour]] = {"RGB": np.array, "HSV": rgb_from_hsv, "HSL": rgb_from_hsl}


def _light_falloff(node: Node) -> Colour:
    if node.output != "Quadratic" or node.number("Smooth") != 0:
        node.warn("falloff other than quadratic and smoothing are not supported, it falls with the square of distance")
    return _grey(node.number("Strength"))


def _clamp(node: Node) -> Colour:
    value, low, high = (node.number(name) for name in ("Value", "Min", "Max"))
    if node.node.clamp_type == "RANGE" and low > high:
        low, high = high, low
    return _grey(min(max(value, low), high))


def _map_range(node: Node) -> Colour:
    if node.node.data_type == "FLOAT_VECTOR":
        names = ("Vector", "From_Min_FLOAT3", "From_Max_FLOAT3", "To_Min_FLOAT3", "To_Max_FLOAT3", "Steps_FLOAT3")
        value, from_min, from_max, to_min, to_max, steps = (node.colour(name) for name in names)
    else:
        names = ("Value", "From Min", "From Max", "To Min", "To Max", "Steps")
        value, from_min, from_max, to_min, to_max, steps = (_grey(node.number(name)) for name in names)
    place = divided(value - from_min, from_max - from_min)
    kind = node.node.interpolation_type
    if kind == "STEPPED":
        place = np.where(steps > 0, divided(np.floor(place * (steps + 1)), steps), 0)
    elif kind == "SMOOTHSTEP":
        place = np.clip(place, 0, 1)
        place = place**2 * (3 - 2 * place)
    elif kind == "SMOOTHERSTEP":
        place = np.clip(place, 0, 1)
        place = place**3 * (place * (place * 6 - 15) + 10)
    result = mixed(place, to_min, to_max)
    if node.node.data_type == "FLOAT" and from_min[0] == from_max[0]:
        result = np.zeros(3)
    return np.clip(result, np.minimum(to_min, to_max), np.maximum(to_min, to_max)) if node.node.clamp else result


def _gamma(node: Node) -> Colour:
    colour, gamma = node.colour("Color"), node.number("Gamma")
    return np.ones(3) if gamma == 0 else np.where(colour > 0, np.where(colour > 0, colour, 1) ** gamma, colour)


def _invert(node: Node) -> Colour:
    colour = node.colour("Color")
    return mixed(node.number("Fac"), colour, 1 - colour)


def _bright_contrast(node: Node) -> Colour:
    contrast = node.number("Contrast")
    return np.maximum((1 + contrast) * node.colour("Color") + node.number("Bright") - contrast / 2, 0)


def _hue_saturation(node: Node) -> Colour:
    colour = node.colour("Color")
    hue, saturation, value = hsv_from_rgb(colour)
    hue = (hue + node.number("Hue") + 0.5) % 1
    saturation = np.clip(saturation * node.number("Saturation"), 0, 1)
    turned = rgb_from_hsv(np.array((hue, saturation, value * node.number("Value"))))
    return np.maximum(mixed(node.number("Fac"), colour, turned), 0)


def _rgb_curves(node: Node) -> Colour:
    mapping, colour = node.node.mapping, node.colour("Color")
    mapping.initialize()
    *channels, combined = mapping.curves
    curved = [mapping.evaluate(c, mapping.evaluate(combined, x)) for c, x in zip(channels, colour, strict=True)]
    return mixed(node.number("Fac"), colour, np.array(curved))


def _float_curve(node: Node) -> Colour:
    mapping, value = node.node.mapping, node.number("Value")
    mapping.initialize()
    return _grey(mixed(node.number("Factor"), value, mapping.evaluate(mapping.curves[0], value)))


def _colour_ramp(node: Node) -> Colour:
    ramp, factor = node.node.color_ramp, node.number("Fac", unknown=math.nan)
    if math.isnan(factor):
        node.warn("colour ramps over what varies are not supported, it stands for the mean of its colours")
        rgba = np.mean([ramp.evaluate(x) for x in np.linspace(0, 1, 33)], axis=0)
    else:
        rgba = np.array(ramp.evaluate(min(max(factor, 0.0), 1.0)))
    return _grey(rgba[3]) if node.output == "Alpha" else rgba[:3]


CONSTANTS: dict[str, Callable[[Node], Colour]] = {  # by bpy.types.Node.type
    "MATH": _math,
    "VECT_MATH": _vector_math,
    "MIX_RGB": _mix_rgb,
    "MIX": _mix,
    "BLACKBODY": lambda node: blackbody(node.number("Temperature")),
    "COMBINE_COLOR": lambda node: _TO_RGB[node.node.mode](_combined(node)),
    "COMBRGB": _combined,
    "COMBHSV": lambda node: rgb_from_hsv(_combined(node)),
    "COMBXYZ": _combined,
    "SEPARATE_COLOR": lambda node: _separated(node, _FROM_RGB[node.node.mode](node.colour("Color"))),
    "SEPRGB": lambda node: _separated(node, node.colour("Image")),
    "SEPHSV": lambda node: _separated(node, hsv_from_rgb(node.colour("Color"))),
    "SEPXYZ": lambda node: _separated(node, node.colour("Vector")),
    "LIGHT_FALLOFF": _light_falloff,
    "CLAMP": _clamp,
    "MAP_RANGE": _map_range,
    "GAMMA": _gamma,
    "INVERT": _invert,
    "BRIGHTCONTRAST": _bright_contrast,
    "HUE_SAT": _hue_saturation,
    "CURVE_RGB": _rgb_curves,
    "CURVE_FLOAT": _float_curve,
    "VALTORGB": _colour_ramp,
    "RGBTOBW": lambda node: _grey(node.colour("Color") @ LUMINANCE),
}
