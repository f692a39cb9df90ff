"""How a table tells what becomes of each property of a Blender type, and how what is left out is reported.

A name may carry a Blender version that has the property, "visible_raycast@5.2"; one without is in the versions that the
tests run. tests/addon/test_census.py holds the tables against each Blender at hand.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any

from ...report import Reporter


@dataclass(frozen=True)
class LeftOut:
    """A property that changes Cycles' picture and not Pivot's: reported unless it is neutral."""

    name: str
    neutral: Any  # the value that changes nothing, or a test of the value
    instead: str  # what happens: "it casts shadows"
    what: str = ""  # what is not supported, with its verb; else the property's name and "is"
    when: Callable[[Any], bool] = lambda _: True  # whether the property counts at all, asked of its owner


@dataclass(frozen=True)
class Table:
    """The properties of one RNA type without those of its bases. Each list is of names between spaces."""

    used: str = ""  # by the exporter, or by Blender in what the exporter reads
    parts: str = ""  # pointers to structs with a table of their own
    left_out: tuple[LeftOut, ...] = ()
    no_meaning: str = ""  # for a picture, or for one without what is reported anyway

    def names(self) -> dict[str, str]:
        """Each property named, with the Blender version it is marked with or ""."""
        listed = f"{self.used} {self.parts} {self.no_meaning}".split() + [row.name for row in self.left_out]
        return dict(split_mark(entry) for entry in listed)


def split_mark(entry: str) -> tuple[str, str]:
    """A name and the Blender version it is marked with, or ""."""
    name, _, version = entry.partition("@")
    return name, version


def is_empty(value: Any) -> bool:
    return len(value) == 0


def report_left_out(data: Any, owner: str, reporter: Reporter, tables: Mapping[str, Table]) -> None:
    """Say of each property of data and its parts that it is left out, unless it is neutral.

    data: a bpy_struct. owner: how reports name it, "light 'Key'". tables: by RNA type.
    """
    rna = data.bl_rna
    kind = rna
    while kind is not None:
        table = tables.get(kind.identifier, Table())
        for row in table.left_out:
            name, _ = split_mark(row.name)
            if name in rna.properties and row.when(data) and not _is_neutral(getattr(data, name), row.neutral):
                what = row.what or f"{rna.properties[name].name} is"
                reporter.warn(f"{owner}: {what} not supported, {row.instead}")
        for part in table.parts.split():
            below = getattr(data, part, None)
            if below is not None:
                report_left_out(below, owner, reporter, tables)
        kind = kind.base


def _is_neutral(value: Any, neutral: Any) -> bool:
    if callable(neutral):
        return neutral(value)
    if isinstance(neutral, float):
        return math.isclose(value, neutral, rel_tol=1e-5, abs_tol=1e-9)
    return value == neutral
