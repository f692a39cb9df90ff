"""Sample progress and time left, in the interface and on a terminal."""

from __future__ import annotations

import time
from typing import Any

import bpy

_HEADLESS_S = 1.0  # between lines on a terminal
# Up to 4.5 update_stats prints its line in the background, later it prints none.
_PRINT = bpy.app.background and bpy.app.version >= (5, 0)


class Progress:
    """Shows how far a session is: "Sample 12/64 | 19 % | 00:07 left"."""

    def __init__(self, engine: bpy.types.RenderEngine, samples: int) -> None:
        self._engine = engine
        self._samples = samples
        self._start_s = time.monotonic()
        self._line_s = 0.0

    @property
    def elapsed_s(self) -> float:
        return time.monotonic() - self._start_s

    def show(self, session: Any, last: bool = False) -> None:
        """last: show it however short ago the line before it was."""
        self._engine.update_progress(session.progress)
        if bpy.app.background and not last and self.elapsed_s - self._line_s < _HEADLESS_S:
            return
        self._line_s = self.elapsed_s
        line = progress_line(session.samples_done, self._samples, session.progress, self.elapsed_s)
        self._engine.update_stats("", line)
        if _PRINT:
            print(f"Pivot | {line}", flush=True)


def progress_line(samples_done: int, samples: int, progress: float, elapsed_s: float) -> str:
    left = f"{_clock(elapsed_s * (1 - progress) / progress)} left" if progress > 0 else "starting"
    return f"Sample {samples_done}/{samples} | {100 * progress:.0f} % | {left}"


def _clock(seconds: float) -> str:
    minutes, second = divmod(round(seconds), 60)
    hours, minute = divmod(minutes, 60)
    return f"{hours}:{minute:02}:{second:02}" if hours else f"{minute:02}:{second:02}"
