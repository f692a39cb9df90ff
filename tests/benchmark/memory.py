"""What frames of many triangles take, by Pivot and by Cycles, each in its own process: CPU seconds, and memory in MiB.

    ./run python tests/benchmark/memory.py

Eight million triangles of a smooth, wavy grid with a UV map; and ten million, a thousand of each of ten thousand balls
that stand on the vertices of a grid. 64 x 64 pixels, one sample: nearly all of it is export and building. Blender's own
mesh is in the peak; what it took to make the mesh is not. What Blender itself takes before it asks an engine is the
row of the engine that does nothing.
"""

from __future__ import annotations

import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import bpy

# isort: split
import addon_utils
from export_speed import rolling_grid
from hair_speed import Nothing

SIDE = 2001  # vertices along an edge: 2 (SIDE - 1)^2 triangles
BALLS = 100  # along an edge
ENGINES = {"NOTHING": "", "PIVOT": "pivot", "CYCLES": "cycles"}


def grid() -> None:
    rolling_grid(SIDE)


def instances() -> None:
    bpy.ops.mesh.primitive_grid_add(x_subdivisions=BALLS - 1, y_subdivisions=BALLS - 1, size=1, location=(0.5, 0.5, 0))
    ground = bpy.context.object
    bpy.ops.mesh.primitive_uv_sphere_add(segments=24, ring_count=22, radius=0.004)  # 1008 triangles
    bpy.context.object.parent, ground.instance_type = ground, "VERTS"


KINDS = {"grid": grid, "instances": instances}


def status_mib(field: str) -> float:
    lines = dict(line.split(":") for line in Path("/proc/self/status").read_text().splitlines())
    return int(lines[field].split()[0]) / 1024


def measure(kind: str, engine: str, file: str) -> None:
    bpy.ops.wm.open_mainfile(filepath=file)
    if ENGINES[engine]:
        addon_utils.enable(ENGINES[engine])
    else:
        bpy.utils.register_class(Nothing)
    scene = bpy.context.scene
    scene.render.engine = engine
    if engine == "CYCLES":
        scene.cycles.samples, scene.cycles.use_denoising = 1, False
    elif engine == "PIVOT":
        scene.pivot.samples = 1
    mesh_mib, before_s = status_mib("VmRSS"), time.process_time()
    bpy.ops.render.render()
    took_s = time.process_time() - before_s
    print(
        f"{kind:9} {engine:8} {took_s:5.2f} s of CPU, peak {status_mib('VmHWM'):6.0f} MiB, {mesh_mib:.0f} before",
        flush=True,
    )
    os._exit(0)  # bpy may wait for its own threads there


def main() -> None:
    for kind, make in KINDS.items():
        with tempfile.TemporaryDirectory() as folder:
            file = str(Path(folder) / f"{kind}.blend")
            bpy.ops.wm.read_factory_settings(use_empty=True)
            make()
            scene = bpy.context.scene
            scene.camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
            scene.camera.location = 0.5, 0.5, 1.5
            scene.collection.objects.link(scene.camera)
            sun = bpy.data.objects.new("sun", bpy.data.lights.new("sun", "SUN"))
            scene.collection.objects.link(sun)
            scene.render.resolution_x = scene.render.resolution_y = 64
            bpy.ops.wm.save_as_mainfile(filepath=file)
            for engine in ENGINES:
                subprocess.run([sys.executable, __file__, kind, engine, file], check=True)


if __name__ == "__main__":
    measure(*sys.argv[1:]) if len(sys.argv) > 1 else main()
