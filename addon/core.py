"""The native module, imported when first needed: without it the addon still registers and can say what is missing."""

from __future__ import annotations

import importlib
from types import ModuleType

from .report import RenderError


def load() -> ModuleType:
    """pivot_core. Raises RenderError naming the fix when it cannot be imported."""
    try:
        return importlib.import_module("pivot_core")
    except ImportError as error:
        raise RenderError(
            f"the render core does not load ({error}). Fix: build it with './run render', or install the Pivot "
            "extension made for this platform and this Blender's Python"
        ) from error
