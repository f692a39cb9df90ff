"""What every exporter needs to hand."""

from __future__ import annotations

from dataclasses import dataclass, field
from types import ModuleType
from typing import Any

import bpy

from ..report import Reporter
from .images import ImageTable
from .mattes import Mattes


@dataclass
class Placed:
    """Where in the core's scene the depsgraph's instances are; an index is one of these."""

    instances: list[tuple[list[int], int]] = field(default_factory=list)  # of some, the first of successive ids
    filled: set[int] = field(default_factory=set)  # those with a volume
    shining: set[int] = field(default_factory=set)
    meshes: dict[int, int] = field(default_factory=dict)  # by the core's id the first instance that has it
    curves: dict[int, tuple[int, str]] = field(default_factory=dict)  # likewise, and the name of their source


@dataclass(frozen=True)
class Context:
    core: ModuleType  # pivot_core
    scene: Any  # pivot_core.Scene, being filled
    depsgraph: bpy.types.Depsgraph
    reporter: Reporter
    images: ImageTable
    mattes: Mattes = field(default_factory=Mattes)
    placed: Placed = field(default_factory=Placed)
