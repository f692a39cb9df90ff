"""Curves and points with a thickness as arrays, and those of Curves and Point Cloud objects."""

from __future__ import annotations

import functools
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import bpy
import numpy as np
from numpy.typing import NDArray

from .attributes import VALUES, attribute_values
from .islands import random_of_numbers

Array = NDArray[np.float32]
CURVE_RADIUS_M, POINT_RADIUS_M = 0.005, 0.01  # of data without radii, as Cycles has it
_SHAPES = {"RIBBONS": "RIBBON", "THICK": "ROUND"}


@dataclass(frozen=True)
class CurveArrays:
    """P points of C curves, a point cloud's as curves of one; arguments of pivot_core.Scene.add_curves."""

    positions: Array  # (P, 3)
    radii_m: Array  # (P,)
    offsets: NDArray[np.int32]  # (C + 1,), where each starts, and P
    point_attributes: dict[str, Array] = field(default_factory=dict)  # (P, 1..4)

    def add_of_curves(self, name: str, values: Array) -> None:
        """An attribute of (C, 1..4) values."""
        self.point_attributes[name] = np.repeat(values.reshape(len(self.offsets) - 1, -1), np.diff(self.offsets), 0)


@dataclass(frozen=True)
class CurveSource:
    """What curves of an object are read from."""

    name: str  # tells it from others of the object
    slot: int  # of its material
    state: tuple[int, ...]  # how many parts it has: with others it is another
    read: Callable[[frozenset[str]], CurveArrays]  # with the attributes of these names
    settings: dict[str, Any] = field(default_factory=dict)  # in the place of the scene's


def curve_source(data: bpy.types.Curves | bpy.types.PointCloud) -> CurveSource:
    """Of a Curves or Point Cloud object's evaluated data."""
    if isinstance(data, bpy.types.PointCloud):
        balls = {"shape": "BALL"}
        return CurveSource("points", 0, (len(data.points),), functools.partial(point_arrays, data), balls)
    state = len(data.points), len(data.curves)
    return CurveSource("curves", 0, state, functools.partial(curve_arrays, data))


def curve_settings(scene: bpy.types.Scene) -> dict[str, Any]:
    """How rays meet all curves of a scene, by Cycles' settings where it is there. [Cycles 4.5 bvh/embree.cpp]"""
    settings = getattr(scene, "cycles_curves", None)
    if settings is None:
        return {}
    subdivisions = min(max(1 << settings.subdivisions, 1), 16)  # of which Embree's tessellation has one more
    return {"shape": _SHAPES.get(settings.shape, "ROUND"), "subdivisions": subdivisions + 1}


def curve_arrays(curves: bpy.types.Curves, names: frozenset[str]) -> CurveArrays:
    """Of a Curves object's evaluated data; names: of the attributes that its materials ask for."""
    positions, offsets = np.empty((len(curves.points), 3), np.float32), np.zeros(len(curves.curves) + 1, np.int32)
    curves.position_data.foreach_get("vector", positions.ravel())
    if len(curves.curves):
        curves.curve_offset_data.foreach_get("value", offsets)
    arrays = CurveArrays(positions, _radii(curves, len(positions), CURVE_RADIUS_M), offsets)
    add_strand_attributes(arrays, names)
    _add_attributes(arrays, curves, names)
    return arrays


def point_arrays(points: bpy.types.PointCloud, names: frozenset[str]) -> CurveArrays:
    """Of a Point Cloud object's evaluated data, likewise."""
    count = len(points.points)
    positions, at = np.empty((count, 3), np.float32), points.attributes.get("position")
    if count:
        at.data.foreach_get("vector", positions.ravel())
    arrays = CurveArrays(positions, _radii(points, count, POINT_RADIUS_M), np.arange(count + 1, dtype=np.int32))
    _add_attributes(arrays, points, names)
    for name in names:
        kind, _, inner = name.partition(":")
        if kind == "point":
            arrays.point_attributes[name] = _POINT[inner](arrays)
    return arrays


def _radii(data: Any, count: int, otherwise_m: float) -> Array:
    radii, radius = np.full(count, otherwise_m, np.float32), data.attributes.get("radius")
    if radius is not None and radius.domain == "POINT" and radius.data_type == "FLOAT":
        radius.data.foreach_get("value", radii)
    return np.maximum(radii, 0)


def _add_attributes(arrays: CurveArrays, data: Any, names: frozenset[str]) -> None:
    for name in names:
        kind, _, inner = name.partition(":")
        attribute = None
        if kind == "uv" and not inner:  # as Cycles has it: the first of two numbers that each curve has
            attribute = next((a for a in data.attributes if (a.data_type, a.domain) == ("FLOAT2", "CURVE")), None)
        elif kind in {"uv", "attribute"}:
            attribute = data.attributes.get(inner)
        if attribute is not None and attribute.data_type in VALUES:
            _add_attribute(arrays, attribute, name)


def _add_attribute(arrays: CurveArrays, attribute: Any, name: str) -> None:
    values = attribute_values(attribute)
    if attribute.domain == "POINT":
        arrays.point_attributes[name] = values
    else:
        arrays.add_of_curves(name, values)


def add_strand_attributes(arrays: CurveArrays, names: frozenset[str]) -> None:
    """What Blender's Curves Info tells of each curve and of the way along it."""
    for name in names:
        kind, _, inner = name.partition(":")
        if kind == "strand":
            _STRAND[inner](arrays, name)


def ways_along(arrays: CurveArrays) -> tuple[Array, Array]:
    """How far each point lies along its curve (P,), and how long each curve is (C,), m."""
    steps = np.zeros(len(arrays.positions), np.float64)
    steps[1:] = np.linalg.norm(np.diff(arrays.positions, axis=0), axis=1)
    starts, ends = arrays.offsets[:-1], arrays.offsets[1:]
    has_points = ends > starts
    steps[starts[has_points]] = 0
    whole = np.concatenate([[0.0], np.cumsum(steps)])
    along = whole[1:] - np.repeat(whole[starts], ends - starts)
    return along.astype(np.float32), (whole[ends] - whole[starts]).astype(np.float32)


def _intercept(arrays: CurveArrays, name: str) -> None:
    along, lengths = ways_along(arrays)
    of_points = np.repeat(lengths, np.diff(arrays.offsets))
    arrays.point_attributes[name] = (along / np.where(of_points > 0, of_points, 1))[:, None]


def _length(arrays: CurveArrays, name: str) -> None:
    arrays.add_of_curves(name, ways_along(arrays)[1])


def _random(arrays: CurveArrays, name: str) -> None:
    arrays.add_of_curves(name, random_of_numbers(np.arange(len(arrays.offsets) - 1, dtype=np.uint32), words=2))


# What Blender's Point Info tells of each point of a cloud, (P, 1 or 3).
_POINT: dict[str, Callable[[CurveArrays], Array]] = {
    "position": lambda arrays: arrays.positions,
    "radius": lambda arrays: arrays.radii_m[:, None],
    "random": lambda arrays: random_of_numbers(np.arange(len(arrays.positions), dtype=np.uint32), words=2)[:, None],
}
_STRAND: dict[str, Callable[[CurveArrays, str], None]] = {
    "intercept": _intercept,
    "length": _length,
    "random": _random,
}
