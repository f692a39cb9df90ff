"""A chart in the making: a Blender of its own that works in the background, its progress, and how it ends."""

from __future__ import annotations

import os
import re
import signal
import subprocess
import sys
import tempfile
from pathlib import Path

import bpy

from .errors import Row
from .measure import rows_from_json

_ADDON = __package__.rpartition(".")[0]
_WORKER = Path(__file__).with_name("worker.py")
_STEP = re.compile(r"\[(\d+)/(\d+)\] (.*)")


class ChartJob:
    """Charts the scene as it is when the job begins. Everything it writes is in `folder`."""

    def __init__(self, ladder: str) -> None:
        self.folder = Path(tempfile.mkdtemp(prefix="pivot_chart_", dir=bpy.app.tempdir))
        self.chart = self.folder / "chart.png"
        blend = self.folder / f"{Path(bpy.data.filepath).stem or 'untitled'}.blend"
        bpy.ops.wm.save_as_mainfile(filepath=str(blend), copy=True, relative_remap=True, check_existing=False)
        arguments = ["--", _ADDON, str(blend), ladder, str(self.folder)]
        if bpy.app.binary_path:
            command = [bpy.app.binary_path, "--background", "-noaudio", "--python", str(_WORKER), *arguments]
        else:  # Blender as a Python module
            command = [sys.executable, str(_WORKER), *arguments]
        self._log = self.folder / "log.txt"
        with self._log.open("w") as log:
            self._process = subprocess.Popen(
                command, stdin=subprocess.DEVNULL, stdout=log, stderr=subprocess.STDOUT, start_new_session=True
            )

    def done(self) -> bool:
        return self._process.poll() is not None

    def wait(self) -> None:
        self._process.wait()

    def progress(self) -> tuple[float, str]:
        """0..1, and what is rendered now."""
        steps = _STEP.findall(self._log.read_text(errors="replace"))
        if not steps:
            return 0.0, "starting"
        done, total, what = steps[-1]
        return int(done) / max(int(total), 1), what.strip()

    def cancel(self) -> None:
        if not self.done():
            os.killpg(self._process.pid, signal.SIGTERM)
            self._process.wait()

    def rows(self) -> list[Row]:
        """Of a job that is done. Raises RuntimeError with what went wrong."""
        if self._process.returncode != 0 or not self.chart.exists():
            errors = [line for line in self._log.read_text(errors="replace").splitlines() if line.startswith("Error")]
            why = errors[-1].removeprefix("Error: ") if errors else f"Blender ended with {self._process.returncode}"
            raise RuntimeError(f"{why} (log: {self._log})")
        return rows_from_json((self.folder / "rows.json").read_text())
