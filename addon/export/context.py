"""What every exporter needs to hand."""

from __future__ import annotations

from dataclasses import dataclass, field
from types import ModuleType
from typing import Any

import bpy

from ..report import Reporter
from .images import ImageTable
from .mattes import Mattes


@dataclass(frozen=True)
class Context:
    core: ModuleType  # pivot_core
    scene: Any  # pivot_core.Scene, being filled
    depsgraph: bpy.types.Depsgraph
    reporter: Reporter
    images: ImageTable
    mattes: Mattes = field(default_factory=Mattes)
