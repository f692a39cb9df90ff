"""Values of node trees baked to voxels: what they are at random points, and what they should be there."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import bpy
import numpy as np
import parts

COLOR = (0.25, 0.5, 0.75, 1.0)


def main(folder: Path) -> Any:
    parts.clear()
    cube = parts.link("cloud", _box())
    cube.location, cube.rotation_euler, cube.scale, cube.color = (1, 2, 3), (0.3, 0.2, 0.1), (2, 1, 0.5), COLOR
    modifier = cube.modifiers.new("longer", "ARRAY")  # beyond the texture space
    modifier.use_relative_offset, modifier.use_constant_offset = False, True
    modifier.constant_offset_displace = (2, 0, 0)
    bpy.context.view_layer.update()
    return {name: _baked(cube, *case) for name, case in CASES.items()}


def _box() -> Any:
    mesh = bpy.data.meshes.new("box")
    corners = [(x, y, z) for x in (1, 3) for y in (0, 2) for z in (-0.5, 0.25)]
    mesh.from_pydata(corners, [], [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)])
    return mesh


def _baked(cube: Any, kind: str, output: str | int, settings: dict[str, Any], expected: Any) -> Any:
    """kind, output, settings: of a node. expected: of points in object and world space."""
    from pivot.core import load
    from pivot.export.baked import Interior, bake
    from pivot.export.context import Context
    from pivot.export.images import ImageCache, ImageTable
    from pivot.export.nodes import Owner, Socket, colour, number
    from pivot.export.program import Program
    from pivot.report import Reporter

    core = load()
    depsgraph = bpy.context.evaluated_depsgraph_get()
    reporter = Reporter(lambda level, text: None, set())
    images = ImageTable(core, 1, ImageCache())
    context = Context(core, core.Scene(), depsgraph, reporter, images)
    material, shader = parts.shaded("baked", "ShaderNodeEmission")
    node = material.node_tree.nodes.new(kind)
    for name, value in settings.items():
        setattr(node, name, value)
    is_number = node.outputs[output].type == "VALUE"
    target = shader.inputs["Strength" if is_number else "Color"]
    material.node_tree.links.new(node.outputs[output], target)
    program = Program(core, context.scene, images)
    value = (number if is_number else colour)(Socket(target), Owner("cloud", reporter, program, material))
    evaluated = cube.evaluated_get(depsgraph)
    to_world = np.array(cube.matrix_world, np.float32)
    interior = Interior(evaluated, evaluated.data, to_world, 0.375)
    lattice = interior.lattice(frozenset())
    [baked] = bake(context, program, [value], lattice, interior, "object 'cloud'")
    x, y, z = lattice.size
    grid = core.VoxelGrid(
        baked.reshape(z, y, x, -1).squeeze(-1) if is_number else baked.reshape(z, y, x, 3),
        lattice.grid_from_object.astype(np.float32),
    )

    points = np.random.default_rng(1).uniform((1, 0, -0.5), (5, 2, 0.25), (200, 3)).astype(np.float32)
    world = points @ to_world[:3, :3].T + to_world[:3, 3]
    spacing = 4 / 127  # of 128 voxels along the longest side
    size = np.array([127, np.rint(2 / spacing), np.rint(0.75 / spacing)])
    in_grid = (points - (1, 0, -0.5)) / (4, 2, 0.75) * size
    if expected is None:  # on voxels, what the program gives there
        in_grid = np.rint(in_grid)
        points = (in_grid / size * (4, 2, 0.75) + (1, 0, -0.5)).astype(np.float32)
        generated = {context.scene.attribute_id("generated:"): _generated(points)}
        registers = [part.index for part in value.parts]
        wanted = program.program.run_at(points, to_world, registers, attributes=generated)
    else:
        wanted = np.reshape(expected(points, world), (-1, 1 if is_number else 3)) * np.ones((len(points), 1))
    found = grid.at(in_grid)[:, : len(value.parts)]
    return {"found": found.tolist(), "wanted": wanted.clip(0).tolist(), "reports": reporter.warnings}


def _generated(points: Any) -> Any:
    """Over the box that the modifier makes twice as long."""
    return (points - (1, 0, -0.5)) / (2, 2, 0.75)


CASES = {
    "object": ("ShaderNodeTexCoord", "Object", {}, lambda points, world: points),
    "position": ("ShaderNodeNewGeometry", "Position", {}, lambda points, world: world),
    "generated": ("ShaderNodeTexCoord", "Generated", {}, lambda points, world: _generated(points)),
    "color": ("ShaderNodeObjectInfo", "Color", {}, lambda points, world: np.tile(COLOR[:3], (len(points), 1))),
    "random": ("ShaderNodeObjectInfo", "Random", {}, lambda points, world: np.full(len(points), 0.375)),
    "noise": ("ShaderNodeTexNoise", 0, {}, None),  # of Generated coordinates,
    "attribute": ("ShaderNodeAttribute", "Fac", {"attribute_name": "nothing"}, lambda points, world: 0 * points[:, 0]),
    "incoming": ("ShaderNodeNewGeometry", "Incoming", {}, lambda points, world: 0 * points),
    "particle": ("ShaderNodeParticleInfo", "Index", {}, lambda points, world: 0 * points[:, 0]),
    "camera": ("ShaderNodeCameraData", "View Distance", {}, lambda points, world: np.linalg.norm(world, axis=1)),
}
