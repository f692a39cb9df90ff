"""How the Rendered viewport keeps up with the hand, beside Cycles' on the same machine.

./run python tests/benchmark/viewport.py [PIVOT] [CYCLES]

Needs xvfb-run and a Blender with a window. What counts is what the screen shows, which is read from outside: pictures a
second while a 3D view of 960 x 540 orbits the default scene; and how long after an edit a new picture is there, with a
cube and with a million triangles. Of Pivot it also says how long the interface waits for a draw, the edge of the pixels
while orbiting, when the picture of an edit was begun, and how many meshes it exported for it.
"""

from __future__ import annotations

import json
import mmap
import statistics
import struct
import subprocess
import sys
import tempfile
import time
import zlib
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tests" / "addon"))

from blender_host import environment  # noqa: E402

SIZE = 960, 540
LOOK_S = 0.004
ROW_STEP = 9  # of the screen's rows each so many is read


class Screen:
    """What Xvfb shows, as it changes."""

    def __init__(self, path: Path) -> None:
        with path.open("rb") as file:
            self._pixels = mmap.mmap(file.fileno(), 0, access=mmap.ACCESS_READ)
        header = struct.unpack(">25I", self._pixels[:100])  # XWD's
        self._first, self._row = header[0] + 12 * header[19], header[12]
        self._last = 0

    def changed(self) -> bool:
        last = self._last
        self._last = 0
        for y in range(0, SIZE[1], ROW_STEP):
            start = self._first + y * self._row
            self._last = zlib.crc32(self._pixels[start : start + 4 * SIZE[0]], self._last)
        return self._last != last


def measured(engine: str) -> tuple[dict[str, Any], list[float]]:
    """What the worker wrote, and when the screen changed."""
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        command = ["xvfb-run", "-a", "-s", f"-screen 0 {SIZE[0]}x{SIZE[1]}x24 -fbdir {folder}", "blender"]
        command += ["--factory-startup", "--window-geometry", "0", "0", *map(str, SIZE)]
        command += ["--python", str(Path(__file__).with_name("viewport_worker.py")), "--", str(folder), engine]
        with subprocess.Popen(command, env=environment(folder), stdout=subprocess.PIPE, text=True) as blender:
            screen = folder / "Xvfb_screen0"
            while not screen.exists() or screen.stat().st_size == 0:
                time.sleep(0.1)
            seen, changes = Screen(screen), []
            while blender.poll() is None:
                if seen.changed():
                    changes.append(time.monotonic())
                time.sleep(LOOK_S)
            result = folder / "result.json"
            if not result.exists():
                raise RuntimeError(blender.stdout.read() if blender.stdout else "")
            return json.loads(result.read_text()), changes


def main() -> None:
    for engine in sys.argv[1:] or ("PIVOT", "CYCLES"):
        found, changes = measured(engine)
        began_s, ended_s = found["orbit"]
        pictures = sum(began_s < change < ended_s for change in changes)
        print(f"{engine}, {found['size'][0]} x {found['size'][1]}")
        print(
            f"  orbit: {pictures / (ended_s - began_s):.1f} pictures a second, {found['cpu_s'] / max(pictures, 1):.3f} "
            "CPU seconds each",
            end="",
        )
        if "draw_ms" in found:
            half, most = found["draw_ms"]
            print(f", by pixels of {found['pixel_px']:.1f}; {found['draws']} draws, one {half:.1f} ms", end="")
            print(f", of 20 one over {most:.1f} ms", end="")
        print()
        for name, edits in found["edits"].items():
            times_s = [edit["time_s"] for edit in edits]
            shown_ms = [1e3 * (next(change for change in changes if change > t) - t) for t in times_s]
            print(f"  {name} moved: a new picture after {statistics.median(shown_ms):.0f} ms", end="")
            if edits[0]["start_ms"] is not None:
                start_ms, cpu_ms = (statistics.median(edit[key] for edit in edits) for key in ("start_ms", "cpu_ms"))
                meshes = sum(edit["meshes"] for edit in edits)
                print(f", begun after {start_ms:.0f} ms ({cpu_ms:.0f} of CPU), {meshes} meshes exported", end="")
            print()


if __name__ == "__main__":
    main()
