"""The operations of Blender's Math and Vector Math nodes, for numbers and arrays alike.

[C] is Cycles 4.5, kernel/svm/math_util.h: where an operation has no answer these give Cycles'.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray

Vector = NDArray[np.float64]  # (3,)


def scalar_math(operation: str, a: Any, b: Any, c: Any) -> Any:
    """operation: of the Math node. Raises KeyError for one that is not known."""
    with np.errstate(all="ignore"):
        return _MATH[operation](a, b, c)


def vector_math(operation: str, a: Vector, b: Vector, c: Vector, scale: float) -> Vector:
    """(3,), a number as three of it. operation: of the Vector Math node. Raises KeyError for one that is not known."""
    with np.errstate(all="ignore"):
        if operation in _VECTOR_MATH:
            return np.broadcast_to(_VECTOR_MATH[operation](a, b, c, scale), 3)
        return _MATH[operation](a, b, c)


def divided(a: Any, b: Any) -> Any:
    """a / b, and 0 where b is 0."""
    return np.where(b != 0, a / np.where(b != 0, b, 1), 0.0)


def _power(a: Any, b: Any) -> Any:
    return np.where((a < 0) & (b != np.trunc(b)), 0.0, np.power(np.asarray(a, float), b))


def _logarithm(a: Any, b: Any) -> Any:
    positive = (a > 0) & (b > 0)
    return np.where(positive, divided(np.log(np.where(positive, a, 1)), np.log(np.where(positive, b, 1))), 0.0)


def _wrap(a: Any, upper: Any, lower: Any) -> Any:
    span = upper - lower
    return np.where(span != 0, a - span * np.floor(divided(a - lower, span)), lower)


def _ping_pong(a: Any, scale: Any) -> Any:
    turns = divided(a - scale, scale * 2)
    return np.where(scale != 0, np.abs((turns - np.floor(turns)) * scale * 2 - scale), 0.0)


def _smooth_minimum(a: Any, b: Any, distance: Any) -> Any:
    overlap = divided(np.maximum(distance - np.abs(a - b), 0), distance)
    return np.minimum(a, b) - overlap**3 * distance / 6


def _compare(a: Any, b: Any, epsilon: Any) -> Any:
    return np.where(np.abs(a - b) <= np.maximum(epsilon, np.finfo(np.float32).eps), 1.0, 0.0)


_MATH: dict[str, Callable[[Any, Any, Any], Any]] = {
    "ADD": lambda a, b, _: a + b,
    "SUBTRACT": lambda a, b, _: a - b,
    "MULTIPLY": lambda a, b, _: a * b,
    "DIVIDE": lambda a, b, _: divided(a, b),
    "MULTIPLY_ADD": lambda a, b, c: a * b + c,
    "POWER": lambda a, b, _: _power(a, b),
    "LOGARITHM": lambda a, b, _: _logarithm(a, b),
    "SQRT": lambda a, *_: np.sqrt(np.maximum(a, 0)),
    "INVERSE_SQRT": lambda a, *_: np.where(a > 0, 1 / np.sqrt(np.where(a > 0, a, 1)), 0.0),
    "ABSOLUTE": lambda a, *_: np.abs(a),
    "EXPONENT": lambda a, *_: np.exp(a),
    "MINIMUM": lambda a, b, _: np.minimum(a, b),
    "MAXIMUM": lambda a, b, _: np.maximum(a, b),
    "LESS_THAN": lambda a, b, _: np.where(a < b, 1.0, 0.0),
    "GREATER_THAN": lambda a, b, _: np.where(a > b, 1.0, 0.0),
    "SIGN": lambda a, *_: np.sign(a),
    "COMPARE": _compare,
    "SMOOTH_MIN": _smooth_minimum,
    "SMOOTH_MAX": lambda a, b, c: -_smooth_minimum(-a, -b, c),
    "ROUND": lambda a, *_: np.floor(a + 0.5),
    "FLOOR": lambda a, *_: np.floor(a),
    "CEIL": lambda a, *_: np.ceil(a),
    "TRUNC": lambda a, *_: np.trunc(a),
    "FRACT": lambda a, *_: a - np.floor(a),
    "FRACTION": lambda a, *_: a - np.floor(a),  # the Vector Math node's name for it
    "MODULO": lambda a, b, _: np.where(b != 0, np.fmod(a, np.where(b != 0, b, 1)), 0.0),
    "FLOORED_MODULO": lambda a, b, _: np.where(b != 0, a - np.floor(divided(a, b)) * b, 0.0),
    "WRAP": _wrap,
    "SNAP": lambda a, b, _: np.floor(divided(a, b)) * b,
    "PINGPONG": lambda a, b, _: _ping_pong(a, b),
    "SINE": lambda a, *_: np.sin(a),
    "COSINE": lambda a, *_: np.cos(a),
    "TANGENT": lambda a, *_: np.tan(a),
    "ARCSINE": lambda a, *_: np.arcsin(np.clip(a, -1, 1)),
    "ARCCOSINE": lambda a, *_: np.arccos(np.clip(a, -1, 1)),
    "ARCTANGENT": lambda a, *_: np.arctan(a),
    "ARCTAN2": lambda a, b, _: np.arctan2(a, b),
    "SINH": lambda a, *_: np.sinh(a),
    "COSH": lambda a, *_: np.cosh(a),
    "TANH": lambda a, *_: np.tanh(a),
    "RADIANS": lambda a, *_: np.radians(a),
    "DEGREES": lambda a, *_: np.degrees(a),
}


def _unit(a: Vector) -> Vector:
    return divided(a, np.linalg.norm(a))


def _refract(incident: Vector, normal: Vector, eta: float) -> Vector:
    cosine = normal @ incident
    k = 1 - eta**2 * (1 - cosine**2)
    return np.zeros(3) if k < 0 else eta * incident - (eta * cosine + np.sqrt(k)) * normal


_VECTOR_MATH: dict[str, Callable[[Vector, Vector, Vector, float], Any]] = {
    "CROSS_PRODUCT": lambda a, b, *_: np.cross(a, b),
    "PROJECT": lambda a, b, *_: divided(a @ b, b @ b) * b,
    "REFLECT": lambda a, b, *_: a - 2 * (a @ _unit(b)) * _unit(b),
    "REFRACT": lambda a, b, _, eta: _refract(a, _unit(b), eta),
    "FACEFORWARD": lambda a, b, c, _: a if b @ c < 0 else -a,
    "DOT_PRODUCT": lambda a, b, *_: a @ b,
    "DISTANCE": lambda a, b, *_: np.linalg.norm(a - b),
    "LENGTH": lambda a, *_: np.linalg.norm(a),
    "SCALE": lambda a, _b, _c, scale: a * scale,
    "NORMALIZE": lambda a, *_: _unit(a),
}
