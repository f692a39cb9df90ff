"""Nodes that reckon with colours."""

from __future__ import annotations

import bpy

from ..colour_space import RGB_FROM_XYZ
from ..program import Value
from .row import Node, Row

_HUE_SATURATION = "hue_saturation" if bpy.app.version >= (4, 3) else "hue_saturation_remainder"


def _mix_rgb(node: Node) -> Value:
    factor = node.number("Fac").clamped()
    mixed = node.op(f"blend_{node.node.blend_type.lower()}", factor, node.colour("Color1"), node.colour("Color2"))
    return mixed.clamped() if node.node.use_clamp else mixed


def _mix(node: Node) -> Value:
    kind = node.node.data_type
    uneven = kind == "VECTOR" and node.node.factor_mode == "NON_UNIFORM"
    factor = node.vector("Factor_Vector") if uneven else node.number("Factor_Float")
    if node.node.clamp_factor:
        factor = factor.clamped()
    if kind == "FLOAT":
        return node.program.mixed(factor, node.number("A_Float"), node.number("B_Float"))
    if kind == "VECTOR":
        return node.program.mixed(factor, node.vector("A_Vector"), node.vector("B_Vector"))
    mixed = node.op(f"blend_{node.node.blend_type.lower()}", factor, node.colour("A_Color"), node.colour("B_Color"))
    return mixed.clamped() if node.node.clamp_result else mixed


def _combine(node: Node, mode: str) -> Value:
    parts = [node.number(index) for index in range(3)]
    return node.program.joined(*parts) if mode == "RGB" else node.op(f"combine_{mode.lower()}", *parts)


def _separate(node: Node, mode: str) -> Value:
    colour = node.colour(0)
    parts = colour if mode == "RGB" else node.op(f"separate_{mode.lower()}", colour)
    return parts[node.output_index]


def _hue_saturation(node: Node) -> Value:
    return node.op(
        _HUE_SATURATION,
        node.colour("Color"),
        *(node.number(name) for name in ("Hue", "Saturation", "Value", "Fac")),
    )


def _wavelength(node: Node) -> Value:
    """Over Cycles' own scale, by which no part is above 1; what lies outside of RGB's gamut is clamped to it."""
    rows = [node.program.colour(row / 2.52) for row in RGB_FROM_XYZ]
    xyz = node.op("wavelength_xyz", node.number("Wavelength"))
    return node.op("transform", xyz, *rows, node.program.colour((0, 0, 0))).at_least(0.0)


ROWS: dict[str, Row] = {
    "MIX_RGB": _mix_rgb,
    "MIX": _mix,
    "COMBINE_COLOR": lambda node: _combine(node, node.node.mode),
    "COMBRGB": lambda node: _combine(node, "RGB"),
    "COMBHSV": lambda node: _combine(node, "HSV"),
    "SEPARATE_COLOR": lambda node: _separate(node, node.node.mode),
    "SEPRGB": lambda node: _separate(node, "RGB"),
    "SEPHSV": lambda node: _separate(node, "HSV"),
    "HUE_SAT": _hue_saturation,
    "BRIGHTCONTRAST": lambda node: node.op(
        "bright_contrast", node.colour("Color"), node.number("Bright"), node.number("Contrast")
    ),
    "GAMMA": lambda node: node.op("gamma", node.colour("Color"), node.number("Gamma")),
    "INVERT": lambda node: node.op("invert", node.colour("Color"), node.number("Fac")),
    "RGBTOBW": lambda node: node.colour("Color").luminance(),
    "BLACKBODY": lambda node: node.op("blackbody", node.number("Temperature")),
    "WAVELENGTH": _wavelength,
}
