"""The tree's formatting and lint: ruff for Python, clang-format for C++."""

import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent
SOURCES = [
    path for folder in ("core", "bindings") for path in (ROOT / folder).rglob("*") if path.suffix in {".h", ".cpp"}
]


@pytest.mark.parametrize("command", [["check"], ["format", "--diff"]], ids=" ".join)
def test_python_is_ruff_clean(command: list[str]) -> None:
    ran = subprocess.run([sys.executable, "-m", "ruff", *command, "."], cwd=ROOT, capture_output=True, text=True)
    assert ran.returncode == 0, ran.stdout + ran.stderr


def test_cpp_is_clang_formatted() -> None:
    clang_format = Path(sys.executable).with_name("clang-format")
    ran = subprocess.run([clang_format, "--dry-run", "-Werror", *SOURCES], capture_output=True, text=True)
    assert ran.returncode == 0, ran.stderr


@pytest.mark.parametrize("script", ["run", ".ci/run"])
def test_shell_scripts_parse(script: str) -> None:
    assert subprocess.run(["bash", "-n", ROOT / script]).returncode == 0
