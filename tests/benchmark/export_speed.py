"""How long the addon takes to export a million triangles with corner normals and UVs; prints CPU seconds.

./run python tests/benchmark/export_speed.py
./run blender -b --python tests/benchmark/export_speed.py
"""

from __future__ import annotations

import importlib
import time
from collections.abc import Callable

import bpy

# isort: split
import addon_utils
import numpy as np

SIDE = 709  # vertices along an edge of the grid: 2 (SIDE - 1)^2 triangles
RUNS = 5


def rolling_grid(side: int) -> bpy.types.Object:
    """A smooth, wavy square of side x side vertices, with a UV map, as the scene's only mesh."""
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    x, y = np.meshgrid(np.linspace(0, 1, side), np.linspace(0, 1, side))
    positions = np.stack([x, y, 0.1 * np.sin(9 * x) * np.cos(7 * y)], axis=-1)
    vertex = np.arange(side * side, dtype=np.int32).reshape(side, side)
    quads = np.stack([vertex[:-1, :-1], vertex[:-1, 1:], vertex[1:, 1:], vertex[1:, :-1]], axis=-1).reshape(-1, 4)
    mesh = bpy.data.meshes.new("grid")
    mesh.vertices.add(positions.size // 3)
    mesh.vertices.foreach_set("co", np.ravel(positions).astype(np.float32))
    mesh.loops.add(quads.size)
    mesh.loops.foreach_set("vertex_index", np.ravel(quads))
    mesh.polygons.add(len(quads))
    mesh.polygons.foreach_set("loop_start", np.arange(0, quads.size, 4, dtype=np.int32))
    if bpy.app.version < (4, 1):
        mesh.polygons.foreach_set("loop_total", np.full(len(quads), 4, np.int32))
    mesh.polygons.foreach_set("use_smooth", np.ones(len(quads), bool))
    mesh.uv_layers.new()
    mesh.update(calc_edges=True)
    grid = bpy.data.objects.new("grid", mesh)
    bpy.context.scene.collection.objects.link(grid)
    return grid


def cpu_s(work: Callable[[], object]) -> float:
    start_s = time.process_time()
    work()
    return time.process_time() - start_s


def main() -> None:
    grid = rolling_grid(SIDE)
    addon_utils.enable("pivot")
    core = importlib.import_module("pivot.core").load()
    mesh = importlib.import_module("pivot.export.mesh")
    scene = importlib.import_module("pivot.export.scene")
    reporter = importlib.import_module("pivot.report").Reporter(print, set())
    print(f"Blender {bpy.app.version_string}, {2 * (SIDE - 1) ** 2} triangles, CPU seconds:")
    for _ in range(RUNS):
        grid.data.update_tag()  # drops what Blender has cached of the normals
        depsgraph = bpy.context.evaluated_depsgraph_get()
        export_s = cpu_s(lambda graph=depsgraph: scene.export_scene(core, graph, reporter, lambda: None))
        arrays = vars(mesh.mesh_arrays(grid.evaluated_get(depsgraph).data))
        core_s = cpu_s(lambda data=arrays: core.Scene().add_mesh("grid", **data))
        print(f"export {export_s:.3f}, of which the core's add_mesh {core_s:.3f}", flush=True)


if __name__ == "__main__":
    main()
