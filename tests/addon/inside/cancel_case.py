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
