"""A render that fails where no script catches it."""

from __future__ import annotations

from pathlib import Path

import bpy
import parts


def main(folder: Path) -> None:
    parts.clear()
    parts.camera()
    parts.quad("ground").location.x = float("nan")
    bpy.context.scene.render.engine = "PIVOT"
    bpy.context.scene.render.filepath = str(folder / "picture.png")
    bpy.ops.wm.save_as_mainfile(filepath=str(folder / "fault.blend"))
    bpy.ops.render.render(write_still=True)
