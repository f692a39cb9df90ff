"""Write pivot_core's type stubs, from the module as it is built: `./run python -m bindings.stubs`

They go to bindings/pivot_core/, or to the folder given.
"""

import re
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
import pivot_core
import pybind11_stubgen

HERE = Path(__file__).parent


def write_stubs(folder: Path) -> None:
    """A .pyi for pivot_core, whose native modules are two, and for each of its submodules."""
    if "bool" not in vars(np):  # NumPy 1 lacks the name that pybind11 gives to an array's type
        np.bool = np.bool_
    core, formulas = (f"pivot_core._{module}_{pivot_core.arch}" for module in ("core", "formulas"))
    with tempfile.TemporaryDirectory() as out:
        for module in (core, formulas):
            pybind11_stubgen.main([module, "-o", out, "--exit-code"])
        submodules = [stub for stub in Path(out, *formulas.split(".")).glob("*.pyi") if stub.stem != "__init__"]
        for stub in submodules:
            (folder / stub.name).write_text(stub.read_text().replace(formulas, "pivot_core"))
        names = sorted(stub.stem for stub in submodules)
        text = Path(out, *core.split(".")).with_suffix(".pyi").read_text().replace(core, "pivot_core")
        text = re.sub(r"^(arch|version): str = .*", r"\1: str", text, flags=re.MULTILINE)  # of the build at hand
        text = re.sub(
            r"^(__all__: list\[str\] = \[)", rf"from . import {', '.join(names)}\n\1", text, flags=re.MULTILINE
        )
        text = text.replace("__all__: list[str] = [", "__all__: list[str] = [" + "".join(f"'{n}', " for n in names))
        (folder / "__init__.pyi").write_text(text)
    subprocess.run([sys.executable, "-m", "ruff", "format", "--quiet", *folder.glob("*.pyi")], check=True)


if __name__ == "__main__":
    write_stubs(Path(sys.argv[1]) if len(sys.argv) > 1 else HERE / "pivot_core")
