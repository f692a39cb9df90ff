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
    """A .pyi for pivot_core and for each of its submodules."""
    if "bool" not in vars(np):  # NumPy 1 lacks the name that pybind11 gives to an array's type
        np.bool = np.bool_
    core = f"pivot_core._core_{pivot_core.arch}"
    with tempfile.TemporaryDirectory() as out:
        pybind11_stubgen.main([core, "-o", out, "--exit-code"])
        for stub in Path(out, *core.split(".")).glob("*.pyi"):
            text = stub.read_text().replace(core, "pivot_core")
            text = re.sub(r"^arch: str = .*", "arch: str", text, flags=re.MULTILINE)  # of the build at hand
            (folder / stub.name).write_text(text)
    subprocess.run([sys.executable, "-m", "ruff", "format", "--quiet", *folder.glob("*.pyi")], check=True)


if __name__ == "__main__":
    write_stubs(Path(sys.argv[1]) if len(sys.argv) > 1 else HERE / "pivot_core")
