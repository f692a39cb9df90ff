"""Pivot's C++ core: distributions, scenes and rendering.

The core is built once per x86-64 level; importing this package loads the best build that this CPU runs.
Set PIVOT_ARCH to "v2" or "v3" to force one. The formulas over arrays (distributions, bsdf, film, sampling, shading,
tables) are a module of their own: the Blender extension comes without it.
"""

import importlib
import os
import sys
from importlib.machinery import EXTENSION_SUFFIXES
from pathlib import Path
from types import ModuleType

_FOLDER = Path(__file__).parent
_SUFFIX = EXTENSION_SUFFIXES[0]


def _level() -> str:
    """The x86-64 level to load: PIVOT_ARCH, or the best one that is built and runs here."""
    built = sorted(file.name.removeprefix("_core_").removesuffix(_SUFFIX) for file in _FOLDER.glob(f"_core_*{_SUFFIX}"))
    if not built:
        raise ImportError(f"{_FOLDER} has no build for Python {sys.version_info.major}.{sys.version_info.minor}")
    cpu = importlib.import_module("._cpu", __name__).level()
    wanted = os.environ.get("PIVOT_ARCH")
    if wanted and wanted not in built:
        raise ImportError(f"PIVOT_ARCH={wanted} is not built; choose one of {', '.join(built)}")
    runnable = [level for level in built if level <= cpu]
    if not runnable:
        raise ImportError(f"this CPU is x86-64-{cpu}; Pivot needs one of {', '.join(built)}")
    return wanted or runnable[-1]


def _publish(module: ModuleType) -> None:
    """The native module's names as the package's; its submodules import as `import pivot_core.distributions` too."""
    for name, value in vars(module).items():
        if not name.startswith("_"):
            globals()[name] = value
            if isinstance(value, ModuleType):
                sys.modules[f"{__name__}.{name}"] = value


_core = importlib.import_module(f"._core_{_level()}", __name__)
_publish(_core)
if (_FOLDER / f"_formulas_{_core.arch}{_SUFFIX}").exists():
    _publish(importlib.import_module(f"._formulas_{_core.arch}", __name__))
