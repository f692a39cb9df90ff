"""What a million hairs take in Pivot and in Cycles: one sample of a small picture, CPU seconds and peak memory.

./run python tests/benchmark/hair_speed.py [STRANDS]

Each engine renders in a process of its own: a Curves object's hairs, and those of a particle system's children. What
Blender itself takes of both, before an engine is asked, is in the figures: it is the row of the engine that does
nothing.
"""

from __future__ import annotations

import os
import resource
import subprocess
import sys
import time

import bpy

# isort: split
import addon_utils
import numpy as np

POINTS = 6
PARENTS = 10_000
ENGINES = ("NOTHING", "CYCLES", "PIVOT")


class Nothing(bpy.types.RenderEngine):
    bl_idname, bl_label = "NOTHING", "Nothing"

    def render(self, depsgraph: bpy.types.Depsgraph) -> None:
        """Blender has evaluated the scene."""


def curves(count: int) -> None:
    """A meadow of bent blades, 1 m to each side."""
    random = np.random.default_rng(1)
    data = bpy.data.hair_curves.new("meadow")
    data.add_curves([POINTS] * count)
    root = np.concatenate([random.uniform(-1, 1, (count, 2)), np.zeros((count, 1))], 1)
    lean = random.uniform(-1, 1, (count, 3)) * (0.05, 0.05, 0) + (0, 0, 0.2)
    way = np.linspace(0, 1, POINTS)[None, :, None]
    positions = root[:, None] + way * lean[:, None] + way**2 * (0.05, 0, 0)
    data.position_data.foreach_set("vector", positions.astype(np.float32).ravel())
    radii = data.attributes.new("radius", "FLOAT", "POINT")
    radii.data.foreach_set("value", np.full(POINTS * count, 5e-4, np.float32))
    bpy.context.scene.collection.objects.link(bpy.data.objects.new("meadow", data))


def particles(count: int) -> None:
    """As many children of some parents, on a plane."""
    bpy.ops.mesh.primitive_plane_add(size=2)
    plane = bpy.context.object
    plane.modifiers.new("fur", "PARTICLE_SYSTEM")
    settings = plane.particle_systems[0].settings
    settings.type, settings.count, settings.hair_length, settings.render_step = "HAIR", PARENTS, 0.2, 2
    settings.child_type, settings.rendered_child_count = "INTERPOLATED", count // PARENTS
    settings.radius_scale = 0.001


def work(engine: str, kind: str, count: int) -> None:
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    addon_utils.enable("pivot")
    bpy.utils.register_class(Nothing)
    {"curves": curves, "particles": particles}[kind](count)
    scene = bpy.context.scene
    scene.render.engine = engine
    scene.render.resolution_x, scene.render.resolution_y = 160, 90
    scene.cycles.samples, scene.cycles.use_denoising, scene.cycles.device = 1, False, "CPU"
    scene.pivot.samples = 1
    scene.camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    scene.camera.location, scene.camera.rotation_euler = (0, -3, 2), (1, 0, 0)
    scene.collection.objects.link(scene.camera)
    before_s = time.process_time()
    bpy.ops.render.render()
    took_s, peak_mb = time.process_time() - before_s, resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
    print(f"RESULT {kind:10} {engine:8} {took_s:6.1f} s CPU, {peak_mb:6.0f} MB at most", flush=True)
    os._exit(0)


def main() -> None:
    if len(sys.argv) == 4:
        work(sys.argv[1], sys.argv[2], int(sys.argv[3]))
    count = int(sys.argv[1]) if len(sys.argv) == 2 else 1_000_000
    print(f"Blender {bpy.app.version_string}, {count} hairs, one sample of 160 x 90 pixels")
    for kind in ("curves", "particles"):
        for engine in ENGINES:
            worker = [sys.executable, __file__, engine, kind, str(count)]
            done = subprocess.run(worker, capture_output=True, text=True, check=True)
            print(*(line[7:] for line in done.stdout.splitlines() if line.startswith("RESULT")), sep="\n", flush=True)


if __name__ == "__main__":
    main()
