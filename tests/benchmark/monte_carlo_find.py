"""Which renderers there are: the versions of Blender, Pivot and Mitsuba that given Pythons can import."""

from __future__ import annotations

import subprocess
from collections.abc import Iterable


def probe(python: str, code: str) -> str | None:
    """What a Python prints for the code, or None where it fails."""
    done = subprocess.run([python, "-c", code], capture_output=True, text=True)
    return done.stdout.strip().splitlines()[-1] if done.returncode == 0 and done.stdout.strip() else None


def find_blenders(pythons: Iterable[str]) -> dict[str, str]:
    """Blender's version, as 4.5, of each Python that has bpy, by the Python; says which have none."""
    found = {}
    for python in pythons:
        version = probe(python, "import bpy; print('.'.join(map(str, bpy.app.version[:2])))")
        if version is None:
            print(f"skipped: Cycles of {python}, which has no bpy")
        else:
            found[python] = version
    return found


def find_mitsuba(python: str) -> str | None:
    """Its version; says where there is none."""
    version = probe(python, "import mitsuba; print(mitsuba.__version__)")
    if version is None:
        print(f"skipped: Mitsuba, which {python} cannot import")
    return version


def has_pivot(python: str) -> bool:
    found = probe(python, "import pivot_core; print(1)") is not None
    if not found:
        print(f"skipped: Pivot, which {python} cannot import")
    return found
