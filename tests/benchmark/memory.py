"""What a frame of eight million triangles takes in memory, by Pivot and by Cycles, each in its own process; in MiB.

    ./run python tests/benchmark/memory.py

A smooth, wavy grid with a UV map, 64 x 64 pixels, one sample. Blender's own mesh is in the peak; what it took to make
the mesh is not.
"""

from __future__ import annotations

import subprocess
import sys
import tempfile
from pathlib import Path

import bpy

# isort: split
import addon_utils
from export_speed import rolling_grid

SIDE = 2001  # vertices along an edge: 2 (SIDE - 1)^2 triangles
ENGINES = {"PIVOT": "pivot", "CYCLES": "cycles"}


def status_mib(field: str) -> float:
    lines = dict(line.split(":") for line in Path("/proc/self/status").read_text().splitlines())
    return int(lines[field].split()[0]) / 1024


def measure(engine: str, file: str) -> None:
    bpy.ops.wm.open_mainfile(filepath=file)
    addon_utils.enable(ENGINES[engine])
    scene = bpy.context.scene
    scene.render.engine = engine
    if engine == "CYCLES":
        scene.cycles.samples, scene.cycles.use_denoising = 1, False
    else:
        scene.pivot.samples = 1
    mesh_mib = status_mib("VmRSS")
    bpy.ops.render.render()
    print(f"{engine:8} peak {status_mib('VmHWM'):6.0f} MiB, {mesh_mib:.0f} before the render", flush=True)


def main() -> None:
    with tempfile.TemporaryDirectory() as folder:
        file = str(Path(folder) / "grid.blend")
        rolling_grid(SIDE)
        scene = bpy.context.scene
        scene.camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
        scene.camera.location = 0.5, 0.5, 1.5
        scene.collection.objects.link(scene.camera)
        sun = bpy.data.objects.new("sun", bpy.data.lights.new("sun", "SUN"))
        scene.collection.objects.link(sun)
        scene.render.resolution_x = scene.render.resolution_y = 64
        bpy.ops.wm.save_as_mainfile(filepath=file)
        for engine in ENGINES:
            subprocess.run([sys.executable, __file__, engine, file], check=True)


if __name__ == "__main__":
    measure(*sys.argv[1:]) if len(sys.argv) > 1 else main()
