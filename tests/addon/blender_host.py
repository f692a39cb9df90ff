"""The Blenders this machine has, and how a test runs a script in one.

A host is Debian's `blender` on the PATH, or the bpy module of the Python that runs pytest and of those in
PIVOT_TEST_PYTHONS, paths with a colon between. Scripts live in inside/; each has main(folder) and runs in a Blender of
its own, with the addon enabled and an empty scene.
"""

from __future__ import annotations

import argparse
import functools
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[2]
INSIDE = Path(__file__).resolve().parent / "inside"
TIMEOUT_S = 300


@dataclass(frozen=True)
class Host:
    command: tuple[str, ...]  # what a script's path and arguments follow
    version: tuple[int, int]
    kind: str  # as the tests' header says it

    def __str__(self) -> str:
        return f"{self.version[0]}.{self.version[1]}"

    def start(self, script: str, folder: Path) -> subprocess.CompletedProcess[str]:
        """Run inside/<script>.py's main(folder), which writes what it likes to the folder."""
        return subprocess.run(
            [*self.command, str(INSIDE / "start.py"), "--", script, str(folder)],
            env=environment(folder),
            capture_output=True,
            text=True,
            timeout=TIMEOUT_S,
            check=False,
        )

    def run(self, script: str, folder: Path) -> Any:
        """Run it and return what main(folder) returned, by way of JSON. It and Blender's exit must succeed."""
        done = self.start(script, folder)
        assert done.returncode == 0, f"exit status {done.returncode}\n{done.stdout}\n{done.stderr}"
        return json.loads((folder / "result.json").read_text())


def environment(folder: Path) -> dict[str, str]:
    """The person's, but for Blender's settings, which come from nowhere, and its scripts, which hold the addon."""
    private = {f"BLENDER_USER_{name}": str(folder / "blender") for name in ("RESOURCES", "CONFIG", "DATAFILES")}
    return os.environ | private | {"BLENDER_USER_SCRIPTS": str(user_scripts())}


@functools.cache
def user_scripts() -> Path:
    """PIVOT_SCRIPTS, or a folder of links to the tree's addon and build."""
    given = os.environ.get("PIVOT_SCRIPTS")
    if given:
        return Path(given)
    scripts = Path(tempfile.mkdtemp(prefix="pivot_scripts_"))
    modules = scripts / "addons" / "modules"
    modules.mkdir(parents=True)
    (scripts / "addons" / "pivot").symlink_to(ROOT / "addon")
    (modules / "pivot_core").symlink_to(ROOT / "build" / "python" / "pivot_core")
    return scripts


@functools.cache
def hosts() -> tuple[Host, ...]:
    blender = shutil.which("blender")
    found = [find_host(blender)] if blender else []
    others = os.environ.get("PIVOT_TEST_PYTHONS", "")
    pythons = (sys.executable, *filter(None, others.split(":")))
    return (*filter(None, found), *filter(None, map(bpy_host, pythons)))


def find_host(program: str) -> Host | None:
    """A Blender, or the bpy of a Python, if it is one."""
    text = subprocess.run([program, "--version"], capture_output=True, text=True, check=True).stdout
    version = re.search(r"Blender (\d+)\.(\d+)", text)
    if version is None:
        return bpy_host(program)
    command = (program, "--background", "--factory-startup", "--python-exit-code", "1", "--python")
    return Host(command, (int(version[1]), int(version[2])), program)


def host_argument(program: str) -> Host:
    """find_host() as the type of a command's argument."""
    host = find_host(program)
    if host is None:
        raise argparse.ArgumentTypeError(f"{program} is no Blender and has no bpy")
    return host


def bpy_host(python: str) -> Host | None:
    """The bpy of a Python, if it has one."""
    ask = "import sys, importlib.metadata as m; print(*sys.version_info[:2], *m.version('bpy').split('.')[:2])"
    asked = subprocess.run([python, "-c", ask], capture_output=True, text=True)
    if asked.returncode:
        return None
    *of_python, major, minor = asked.stdout.split()
    return Host((python,), (int(major), int(minor)), f"bpy for Python {'.'.join(of_python)}")
