"""Ctrl-C half a second into a long render."""

from __future__ import annotations

import os
import signal
import threading
import time
from pathlib import Path
from typing import Any

import bpy
import parts
from fault_cases import render, scene


def main(folder: Path) -> Any:
    """How long the render went on, and whether it left a picture."""
    # A shell's background job starts with the signal ignored, and Python then leaves it so; a terminal's does not.
    if signal.getsignal(signal.SIGINT) == signal.SIG_IGN:
        signal.signal(signal.SIGINT, signal.default_int_handler)
    scene()
    parts.size(512, 512)
    bpy.context.scene.pivot.samples = 100_000
    sent_s: list[float] = []

    def interrupt() -> None:
        sent_s.append(time.perf_counter())
        os.kill(os.getpid(), signal.SIGINT)

    threading.Timer(0.5, interrupt).start()
    result = render(folder / "cancelled.png")
    return result | {"latency_s": time.perf_counter() - sent_s[0]}
