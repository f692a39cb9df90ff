"""The native module, imported when first needed: without it the addon still registers and can say what is missing."""

from __future__ import annotations

import importlib
import sys
from pathlib import Path
from types import ModuleType

from .report import RenderError

VERSION = "0.1.0"  # of the addon and of the core that goes with it
BUNDLED = Path(__file__).parent / "pivot_core"  # the zip for Blender 3.4 has it inside; elsewhere it is on sys.path


def load() -> ModuleType:
    """pivot_core. Raises RenderError naming the fix when it cannot be imported, or is another version's."""
    try:
        core = importlib.import_module(f"{__package__}.pivot_core" if BUNDLED.is_dir() else "pivot_core")
    except ImportError as error:
        raise RenderError(
            f"the render core does not load ({error}). Fix: build it with './run render', or install the Pivot "
            f"that is made for Linux on x86-64 and this Blender's Python, {sys.version_info.major}."
            f"{sys.version_info.minor}"
        ) from error
    if core.version != VERSION:
        raise RenderError(
            f"the render core is version {core.version}, the addon {VERSION}. Fix: restart Blender; if that does not "
            "help, install Pivot again"
        )
    return core
