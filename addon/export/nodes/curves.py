"""Nodes of curves that a person draws: tables of as many values as Cycles takes, so that pictures are equal."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import Any

import bpy
import numpy as np

from ..program import Value
from .row import Node, Row

_TABLE_SIZE = 257 if bpy.app.version >= (4, 0) else 256


def _table(node: Node, place: Value, values: Sequence[float], *, interpolates: bool) -> Value:
    """A curve from 0 to 1 that stays as it is beyond."""
    return node.op("table", place, settings=(0.0, 1.0, interpolates, False, *values))


def _colour_ramp(node: Node) -> Value:
    ramp, factor = node.node.color_ramp, node.number("Fac", unknown=math.nan)
    rgba = np.array([ramp.evaluate(x) for x in np.linspace(0, 1, _TABLE_SIZE)])
    channels = [3] if node.output == "Alpha" else [0, 1, 2]
    if factor.is_constant and math.isnan(factor.numbers[0]):
        node.warn("colour ramps over what varies are not supported, it stands for the mean of its colours")
        return node.program.joined(*(node.program.number(rgba[:, channel].mean()) for channel in channels))
    interpolates = ramp.interpolation != "CONSTANT"
    return node.program.joined(
        *(_table(node, factor, rgba[:, channel], interpolates=interpolates) for channel in channels)
    )


def _curve(node: Node, curves: Sequence[Any], place: Value, evaluate: Callable[[float], float]) -> Value:
    """What a curve makes of one part. curves: all of the node's, which share a range."""
    first = min(curve.points[0].location[0] for curve in curves)
    last = max(curve.points[-1].location[0] for curve in curves)
    values = [evaluate(x) for x in np.linspace(first, last, _TABLE_SIZE)]
    extrapolates = node.node.mapping.extend == "EXTRAPOLATED"
    return node.op("table", place, settings=(first, last, True, extrapolates, *values))


def _curves_of_three(node: Node, name: str) -> Value:
    """RGB Curves, whose fourth curve comes before the others, and Vector Curves."""
    mapping, value = node.node.mapping, node.vector(name)
    mapping.initialize()
    curves = list(mapping.curves)
    combined = curves[3] if node.node.type == "CURVE_RGB" else None

    def curved(index: int) -> Value:
        def evaluate(x: float) -> float:
            inner = mapping.evaluate(combined, x) if combined else x
            return float(mapping.evaluate(curves[index], inner))

        return _curve(node, curves, value[index], evaluate)

    return node.program.mixed(node.number("Fac"), value, node.program.joined(*map(curved, range(3))))


def _float_curve(node: Node) -> Value:
    mapping, value = node.node.mapping, node.number("Value")
    mapping.initialize()
    curve = mapping.curves[0]
    curved = _curve(node, [curve], value, lambda x: float(mapping.evaluate(curve, x)))
    return node.program.mixed(node.number("Factor"), value, curved)


ROWS: dict[str, Row] = {
    "VALTORGB": _colour_ramp,
    "CURVE_RGB": lambda node: _curves_of_three(node, "Color"),
    "CURVE_VEC": lambda node: _curves_of_three(node, "Vector"),
    "CURVE_FLOAT": _float_curve,
}
