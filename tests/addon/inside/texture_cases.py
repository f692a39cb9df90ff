"""Planes coloured by textures of every kind, one picture of all by Cycles and one by Pivot; as files in the folder.

The inputs of each are drawn at random, by its name.
"""

from __future__ import annotations

import itertools
import math
import random
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import bpy
import parts

COLUMNS = 20
TILE_PX = 12
DIMENSIONS = ("1D", "2D", "3D", "4D")
VORONOI_PLACES = {"Position": ("2D", "3D", "4D"), "W": ("1D", "4D")}  # outputs, and the dimensions that have them
RANGES = {  # of inputs that are drawn; others stay
    "W": (-2, 2),
    "Scale": (0.5, 6),
    "Detail": (0, 3),
    "Roughness": (0.1, 0.9),
    "Lacunarity": (1.5, 3),
    "Dimension": (0, 2),
    "Offset": (0, 1),
    "Gain": (0, 3),
    "Distortion": (0.2, 1.5),
    "Smoothness": (0.1, 1),
    "Exponent": (0.5, 4),
    "Randomness": (0.5, 1),
    "Detail Scale": (0.5, 3),
    "Detail Roughness": (0.1, 0.9),
    "Phase Offset": (-3, 3),
    "Mortar Size": (0.01, 0.1),
    "Mortar Smooth": (0, 1),
    "Bias": (-0.5, 0.5),
    "Brick Width": (0.2, 1),
    "Row Height": (0.1, 0.5),
    "Frequency": (0.5, 4),
    "Anisotropy": (0.1, 0.9),
    "Orientation 2D": (-3, 3),
}

Settings = dict[str, Any]


def main(folder: Path) -> Any:
    """Returns the names of the tiles from the lower left, row by row, and what the export said."""
    parts.clear()
    names = []
    for name, kind, output, settings in _cases():
        location = (2 * (len(names) % COLUMNS) + 1, 2 * (len(names) // COLUMNS) + 1, 0)
        _tile(name, location, kind, output, settings)
        names.append(name)
    rows = math.ceil(len(names) / COLUMNS)
    parts.camera((COLUMNS, rows, max(COLUMNS, rows))).data.angle = math.pi / 2
    parts.size(TILE_PX * COLUMNS, TILE_PX * rows)
    parts.render_steady(folder / "textures_CYCLES.exr", "CYCLES")
    parts.render_steady(folder / "textures_PIVOT.exr", "PIVOT")
    program = sys.modules["pivot.export.program"].Program(sys.modules["pivot_core"], None, None)
    first = program.op("position")[0]
    _world(folder)
    return {"names": names, "columns": COLUMNS, "tile_px": TILE_PX, "varies": not first.is_always(0.0)}


def _cases() -> Iterator[tuple[str, str, str, Settings]]:
    """Names, kinds of node, outputs and settings."""
    for texture, dimensions, types in (
        ("Noise", "noise_dimensions", "noise_type"),
        ("Musgrave", "musgrave_dimensions", "musgrave_type"),
    ):
        if not hasattr(bpy.types, f"ShaderNodeTex{texture}"):
            continue
        for size, kind in itertools.product(DIMENSIONS, _choices(texture, types) or [""]):
            settings = {dimensions: size} | ({types: kind} if kind else {})
            yield f"{texture} {size} {kind}", texture, "Fac", settings
            if texture == "Noise" and kind in {"", "FBM"}:
                yield f"Noise {size} colour", texture, "Color", settings
                yield f"Noise {size} as it is", texture, "Fac", settings | {"normalize": False}
    for size, feature, metric in itertools.product(
        DIMENSIONS, _choices("Voronoi", "feature"), _choices("Voronoi", "distance")
    ):
        settings = {"voronoi_dimensions": size, "feature": feature, "distance": metric}
        if metric != "EUCLIDEAN" and (size == "1D" or feature in {"DISTANCE_TO_EDGE", "N_SPHERE_RADIUS"}):
            continue
        outputs = {"DISTANCE_TO_EDGE": ["Distance"], "N_SPHERE_RADIUS": ["Radius"]}
        places = [output for output, sizes in VORONOI_PLACES.items() if size in sizes]
        for output in outputs.get(feature, ["Distance", "Color", *places]):
            if output in {"Distance", "Radius"} or metric == "EUCLIDEAN":
                yield f"Voronoi {size} {feature} {metric} {output}", "Voronoi", output, settings
        if feature != "N_SPHERE_RADIUS":
            yield f"Voronoi {size} {feature} {metric} normal", "Voronoi", "Distance", settings | {"normalize": True}
    yield "output that is not there", "Voronoi", "W", {"voronoi_dimensions": "2D"}
    for kind in _choices("Gradient", "gradient_type"):
        yield f"Gradient {kind}", "Gradient", "Color", {"gradient_type": kind}
    for profile, (kind, direction) in itertools.product(
        _choices("Wave", "wave_profile"), (("BANDS", "bands_direction"), ("RINGS", "rings_direction"))
    ):
        for axis in _choices("Wave", direction):
            settings = {"wave_type": kind, "wave_profile": profile, direction: axis}
            yield f"Wave {profile} {kind} {axis}", "Wave", "Fac", settings
    for depth in range(11):
        yield f"Magic {depth}", "Magic", "Color" if depth % 2 else "Fac", {"turbulence_depth": depth}
    for index in range(4):
        settings = {"offset": 0.3 * index, "offset_frequency": index + 1, "squash": 1.3, "squash_frequency": 4 - index}
        yield f"Brick {index}", "Brick", "Color" if index % 2 else "Fac", settings
    for kind, output in itertools.product(_choices("Gabor", "gabor_type"), ("Value", "Phase", "Intensity")):
        yield f"Gabor {kind} {output}", "Gabor", output, {"gabor_type": kind}
        yield f"Gabor {kind} {output} along", "Gabor", output, {"gabor_type": kind, "along": True}
    for output in ("Color", "Fac"):
        yield f"Checker {output}", "Checker", output, {}
    for size, output in itertools.product(DIMENSIONS, ("Value", "Color")):
        yield f"White noise {size} {output}", "WhiteNoise", output, {"noise_dimensions": size}
    for texture in ("Noise", "Voronoi", "Wave", "Magic", "Brick", "Checker"):
        output = "Distance" if texture == "Voronoi" else "Fac"
        yield f"{texture} of what varies", texture, output, {"linked": True}
    for kind in ("POINT", "TEXTURE", "VECTOR", "NORMAL"):
        yield f"mapped {kind}", "Noise", "Fac", {"mapping": kind}


def _choices(texture: str, name: str) -> list[str]:
    kind = getattr(bpy.types, f"ShaderNodeTex{texture}", None)
    found = kind.bl_rna.properties.get(name) if kind else None
    return [item.identifier for item in found.enum_items] if found else []


def _tile(name: str, location: Any, kind: str, output: str, settings: Settings) -> None:
    material, emission = parts.shaded(name, "ShaderNodeEmission")
    tree = emission.id_data
    node = tree.nodes.new(f"ShaderNodeTex{kind}")
    for key, value in settings.items():
        if key == "mapping":
            mapping = node.texture_mapping
            mapping.vector_type, mapping.mapping_x, mapping.mapping_y = value, "Y", "X"
            mapping.translation, mapping.rotation, mapping.scale = (0.1, 0.3, 0.5), (0.2, 0.4, 0.6), (0.5, 1.5, 2)
        elif hasattr(node, key):
            setattr(node, key, value)
    draw = random.Random(name)
    for socket in node.inputs:
        if socket.name in RANGES:
            socket.default_value = draw.uniform(*RANGES[socket.name])
        elif socket.type == "RGBA":
            socket.default_value = (draw.random(), draw.random(), draw.random(), 1)
        elif socket.identifier == "Orientation 3D":
            socket.default_value = (draw.uniform(-1, 1), draw.uniform(-1, 1), draw.uniform(-1, 1))
    if "along" in settings:
        node.inputs["Anisotropy"].default_value = 1
    vector = _steps(tree, [coordinate + draw.uniform(-1, 1) for coordinate in location])
    tree.links.new(vector, _input(node, "Vector"))
    for socket in node.inputs:
        if socket.identifier == "W" or (socket.identifier in RANGES and "linked" in settings):
            tree.links.new(_part(tree, vector, draw.uniform(*RANGES[socket.identifier])), socket)
    tree.links.new(next(socket for socket in node.outputs if socket.identifier == output), emission.inputs["Color"])
    parts.quad(name, location, material)


def _input(node: Any, identifier: str) -> Any:
    """Which need not be of use with the node's settings, so that its name would not find it."""
    return next((socket for socket in node.inputs if socket.identifier == identifier), None)


def _steps(tree: Any, origin: Any) -> Any:
    """Positions in steps of a pixel, whose last bits do not depend on where in a pixel a sample is; from an origin."""
    pixels_per_m = TILE_PX / 2
    output = tree.nodes.new("ShaderNodeNewGeometry").outputs["Position"]
    for operation, by in (
        ("MULTIPLY", (pixels_per_m,) * 3),
        ("FLOOR", None),
        ("MULTIPLY", (1 / pixels_per_m,) * 3),
        ("SUBTRACT", origin),
    ):
        step = tree.nodes.new("ShaderNodeVectorMath")
        step.operation = operation
        tree.links.new(output, step.inputs[0])
        if by:
            step.inputs[1].default_value = by
        output = step.outputs[0]
    return output


def _part(tree: Any, vector: Any, offset: float) -> Any:
    """A third of a vector's first number, and more."""
    part, total = tree.nodes.new("ShaderNodeSeparateXYZ"), tree.nodes.new("ShaderNodeMath")
    total.operation = "MULTIPLY_ADD"
    total.inputs[1].default_value, total.inputs[2].default_value = 0.3, offset
    tree.links.new(vector, part.inputs[0])
    tree.links.new(part.outputs[0], total.inputs[0])
    return total.outputs[0]


def _world(folder: Path) -> None:
    """Noise all around, its Vector not linked: where there is no mesh, generated coordinates are the direction."""
    parts.clear()
    tree = parts.world((1, 1, 1)).node_tree
    noise = tree.nodes.new("ShaderNodeTexNoise")
    tree.links.new(noise.outputs["Color"], tree.nodes["Background"].inputs["Color"])
    parts.camera(rotation=(1.3, 0, 0.5))
    for engine in ("CYCLES", "PIVOT"):
        parts.render_steady(folder / f"world_{engine}.exr", engine)
