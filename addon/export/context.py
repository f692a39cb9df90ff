"""What every exporter needs to hand."""

from __future__ import annotations

from dataclasses import dataclass
from types import ModuleType
from typing import Any

import bpy

from ..report import Reporter
from .images import ImageTable


@dataclass(frozen=True)
class Context:
    core: ModuleType  # pivot_core
    scene: Any  # pivot_core.Scene, being filled
    depsgraph: bpy.types.Depsgraph
    reporter: Reporter
    images: ImageTable
