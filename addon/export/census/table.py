"""How a table tells what becomes of each property of a Blender type.

A name may carry a Blender version that has the property, "visible_raycast@5.2"; one without is in the versions that the
tests run. tests/addon/test_census.py holds the tables against each Blender at hand.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any


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
