"""What a picture takes in memory, beside what the addon takes it for, and what there is within limits."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any
from unittest.mock import patch

import bpy
import parts
from fault_cases import render, scene

SIDE_PX = 2000


def main(folder: Path) -> Any:
    memory: Any = sys.modules["pivot.memory"]
    native = sys.modules["pivot.core"].load()
    channels = sys.modules["pivot.passes"].channel_count
    scene()
    layer = bpy.context.view_layer
    layer.use_pass_position = layer.use_pass_normal = True
    render(folder / "small.png")  # loads what is loaded once
    before = memory.peak_bytes()
    parts.size(SIDE_PX, SIDE_PX)
    render(folder / "large.png")
    film = native.Session.bytes_per_pixel(False)
    return {
        "taken": memory.peak_bytes() - before,
        "estimate": memory.picture_bytes(SIDE_PX, SIDE_PX, film, [channels(layer)]),
        "available": memory.available_bytes(),
        "limited": _limited(memory, folder),
    }


def _limited(memory: Any, folder: Path) -> float:
    """What is there in a control group of 100 MB that uses 60, 15 of them for files it can drop."""
    (folder / "pivot.limit").write_text("100000000\n")
    (folder / "pivot.used").write_text("60000000\n")
    (folder / "memory.stat").write_text("anon 1\ninactive_file 15000000\n")
    group = (str(folder), "pivot.limit", "pivot.used", "inactive_file")
    with patch.object(memory, "_CGROUPS", {"": group, "memory": group}):
        return memory.available_bytes()
