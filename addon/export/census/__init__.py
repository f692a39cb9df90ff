"""What Pivot makes of each property of the Blender types it reads, a table for each type and a file for each area."""

from __future__ import annotations

import functools
import math
from dataclasses import dataclass
from typing import Any

from ...report import Reporter
from .camera import CAMERA
from .light import LIGHT
from .material import MATERIAL
from .node import INPUTS, NODE
from .object import OBJECT
from .scene import SCENE
from .table import LeftOut, Table, split_mark
from .volume import VOLUME
from .world import WORLD

__all__ = ["INPUTS", "TABLES", "report_left_out"]

TABLES: dict[str, Table] = OBJECT | LIGHT | WORLD | CAMERA | MATERIAL | NODE | SCENE | VOLUME


def report_left_out(data: Any, owner: str, reporter: Reporter) -> None:
    """Say of each property of a Blender struct and its parts that it is left out, unless it changes nothing.

    owner: how reports name it, "light 'Key'".
    """
    said = _said_of(type(data))
    for name, what, row in said.rows:
        if row.when(data) and not _is_neutral(getattr(data, name), row.neutral):
            reporter.warn(f"{owner}: {what} not supported, {row.instead}")
    for part in said.parts:
        below = getattr(data, part)
        if below is not None:
            report_left_out(below, owner, reporter)


@dataclass(frozen=True)
class _SaidOf:
    """What may be said of one type in this Blender."""

    rows: tuple[tuple[str, str, LeftOut], ...]  # the property, what is not supported, and its row
    parts: tuple[str, ...]


@functools.cache  # asking Blender takes longer than an object's report may
def _said_of(kind: Any) -> _SaidOf:
    """kind: a class of bpy.types, or of an addon's."""
    properties = kind.bl_rna.properties
    rows: list[tuple[str, str, LeftOut]] = []
    parts: list[str] = []
    rna = kind.bl_rna
    while rna is not None:
        table = TABLES.get(rna.identifier, Table())
        for row in table.left_out:
            name, _ = split_mark(row.name)
            if name in properties:
                rows.append((name, row.what or f"{properties[name].name} is", row))
        parts += [part for part in table.parts.split() if part in properties]
        rna = rna.base
    return _SaidOf(tuple(rows), tuple(parts))


def _is_neutral(value: Any, neutral: Any) -> bool:
    if callable(neutral):
        return neutral(value)
    if isinstance(neutral, float):
        return math.isclose(value, neutral, rel_tol=1e-5, abs_tol=1e-9)
    return value == neutral
