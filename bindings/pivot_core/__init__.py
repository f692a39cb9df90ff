"""Pivot's C++ core: distributions, scenes and rendering.

The core is built once per x86-64 level; importing this package loads the best build that this CPU runs.
Set PIVOT_ARCH to "v2" or "v3" to force one.
"""

import importlib
import os
import sys
from pathlib import Path
from types import ModuleType

from . import _cpu


def _load() -> ModuleType:
    built = sorted(file.name.split(".")[0].removeprefix("_core_") for file in Path(__file__).parent.glob("_core_*.so"))
    cpu = _cpu.level()
    wanted = os.environ.get("PIVOT_ARCH")
    if wanted and wanted not in built:
        raise ImportError(f"PIVOT_ARCH={wanted} is not built; choose one of {', '.join(built)}")
    runnable = [level for level in built if level <= cpu]
    if not runnable:
        raise ImportError(f"this CPU is x86-64-{cpu}; Pivot needs one of {', '.join(built)}")
    return importlib.import_module(f"._core_{wanted or runnable[-1]}", __name__)


_core = _load()
for _name, _value in vars(_core).items():
    if not _name.startswith("_"):
        globals()[_name] = _value
        if isinstance(_value, ModuleType):  # submodules import as `import pivot_core.distributions` too
            sys.modules[f"{__name__}.{_name}"] = _value
