"""What Pivot makes of each property of the Blender types it reads, a table for each type and a file for each area."""

from __future__ import annotations

from typing import Any

from ...report import Reporter
from . import table
from .camera import CAMERA
from .light import LIGHT
from .material import MATERIAL
from .node import INPUTS, NODE
from .object import OBJECT
from .scene import SCENE
from .table import Table
from .world import WORLD

__all__ = ["INPUTS", "TABLES", "report_left_out"]

TABLES: dict[str, Table] = OBJECT | LIGHT | WORLD | CAMERA | MATERIAL | NODE | SCENE


def report_left_out(data: Any, owner: str, reporter: Reporter) -> None:
    """Say of each property of a Blender struct and its parts that it is left out, unless it changes nothing.

    owner: how reports name it, "light 'Key'".
    """
    table.report_left_out(data, owner, reporter, TABLES)
