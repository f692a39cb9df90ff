"""pivot_core's type stubs are those of the module as it is built, and lie beside it."""

import subprocess
import sys
from pathlib import Path

import pivot_core
import pybind11
import pytest

ROOT = Path(__file__).resolve().parent.parent
STUBS = ROOT / "bindings/pivot_core"
BUILT_WITH = (ROOT / "bindings/requirements.txt").read_text().split()[0].removeprefix("pybind11==")


def stubs(folder: Path) -> dict[str, str]:
    return {path.name: path.read_text() for path in folder.glob("*.pyi")}


@pytest.mark.skipif(pybind11.__version__ != BUILT_WITH, reason="another pybind11 writes types in another way")
def test_the_stubs_are_current(tmp_path: Path) -> None:
    made = subprocess.run([sys.executable, "-m", "bindings.stubs", tmp_path], cwd=ROOT, capture_output=True, text=True)
    assert made.returncode == 0, made.stdout + made.stderr
    assert stubs(tmp_path) == stubs(STUBS), "run ./run python -m bindings.stubs"


def test_the_package_ships_them() -> None:
    built = Path(pivot_core.__file__).parent
    assert stubs(built) == stubs(STUBS)
    assert (built / "py.typed").exists()
