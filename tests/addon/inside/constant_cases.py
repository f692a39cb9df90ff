"""Emission through each node that is computed from constants: as exported, and as Cycles shows it in tiles."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import bpy
import parts
from recording import record

COLUMNS = 16
TILE_PX = 8
WARM, COOL = (0.8, 0.3, 0.1, 1), (0.2, 0.6, 0.9, 1)
BRIGHT = (2.5, 0.4, 1.2, 1)
TEMPERATURES_K = (100, 799, 800, 900, 1000, 1300, 1700, 2500, 4000, 6500, 10000, 11999, 12000, 40000)


def main(folder: Path) -> Any:
    """Returns the names of the tiles from the lower left, row by row, and the exported emission by name."""
    parts.clear()
    names = []
    for index, (name, make) in enumerate(_cases()):
        if _tile(name, make, (2 * (index % COLUMNS) + 1, 2 * (index // COLUMNS) + 1, 0)):
            names.append(name)
        else:
            names.append("")  # no such node or operation in this Blender
    rows = math.ceil(len(names) / COLUMNS)
    width_m, height_m = 2 * COLUMNS, 2 * rows
    camera = parts.camera((width_m / 2, height_m / 2, 100))
    camera.data.sensor_width = 36
    camera.data.lens = 100 * 36 / max(width_m, height_m)
    parts.size(TILE_PX * COLUMNS, TILE_PX * rows)
    recording = record()
    emission = {name: list(recording.materials[name].emission) for name in names if name}
    _cycles(folder / "constants.exr")
    return {"names": names, "emission": emission, "reports": recording.reports, "columns": COLUMNS, "tile_px": TILE_PX}


def _tile(name: str, make: Callable[[Any], Any], location: Any) -> bool:
    material, emission = parts.shaded(name, "ShaderNodeEmission")
    tree = emission.id_data
    try:
        output = make(tree)
    except (TypeError, RuntimeError, AttributeError):
        return False
    tree.links.new(output, emission.inputs["Strength" if output.type == "VALUE" else "Color"])
    parts.quad(name, location, material)
    return True


def _node(kind: str, *inputs: Any, **settings: Any) -> Callable[[Any], Any]:
    """Makes a node with the settings, and the values of its first inputs, that are there with these settings."""

    def make(tree: Any) -> Any:
        node = tree.nodes.new(f"ShaderNode{kind}")
        for key, value in settings.items():
            setattr(node, key, value)
        there = [socket for socket in node.inputs if socket.enabled and not socket.is_unavailable]
        for socket, value in zip(there, inputs, strict=False):
            socket.default_value = value
        return next(socket for socket in node.outputs if socket.enabled and not socket.is_unavailable)

    return make


def _choices(kind: str, name: str) -> list[str]:
    return [item.identifier for item in getattr(bpy.types, f"ShaderNode{kind}").bl_rna.properties[name].enum_items]


def _cases() -> Iterator[tuple[str, Callable[[Any], Any]]]:
    triples = ((0.7, 0.4, 0.3), (-1.3, 2.0, 0.5), (2.5, -0.6, 0.2), (0.5, 0.0, 0.0))
    for operation, (index, values) in itertools.product(_choices("Math", "operation"), enumerate(triples)):
        yield f"math {operation} {index}", _node("Math", *values, operation=operation)
    yield "math clamped", _node("Math", 3, 2, operation="ADD", use_clamp=True)
    vectors = ((0.8, 0.3, 0.1), (0.2, 0.6, 0.9), (0.3, -0.2, 0.4), 0.7)
    for operation in _choices("VectorMath", "operation"):
        inputs = (vectors[0], 0.7) if operation == "SCALE" else vectors
        inputs = (*vectors[:2], 0.7) if operation == "REFRACT" else inputs
        yield f"vector {operation}", _node("VectorMath", *inputs, operation=operation)
    for kind in _choices("MixRGB", "blend_type"):
        yield f"mix {kind}", _node("MixRGB", 0.7, WARM, COOL, blend_type=kind)
        yield f"mix {kind} bright", _node("MixRGB", 0.4, BRIGHT, WARM, blend_type=kind)
        yield f"mix {kind} new", _node("Mix", 1.3, BRIGHT, COOL, data_type="RGBA", blend_type=kind, clamp_factor=False)
    yield "mix clamped", _node("MixRGB", 1.5, BRIGHT, BRIGHT, use_clamp=True)
    yield "mix result clamped", _node("Mix", 1.5, WARM, BRIGHT, data_type="RGBA", clamp_result=True)
    yield "mix float", _node("Mix", 0.3, 2.0, 5.0, data_type="FLOAT")
    yield "mix vector", _node("Mix", 0.3, vectors[0], vectors[1], data_type="VECTOR")
    uneven = {"data_type": "VECTOR", "factor_mode": "NON_UNIFORM"}
    yield "mix uneven", _node("Mix", (0.1, 0.5, 0.9), vectors[0], vectors[1], **uneven)
    for temperature_k in TEMPERATURES_K:
        yield f"blackbody {temperature_k}", _node("Blackbody", temperature_k)
    for mode in ("RGB", "HSV", "HSL"):
        for index, values in enumerate(((0.7, 0.4, 0.3), (0.05, 0.9, 1.4), (1.0, 0.2, 0.6))):
            yield f"combine {mode} {index}", _node("CombineColor", *values, mode=mode)
        for (index, colour), part in itertools.product(enumerate((WARM, COOL, BRIGHT)), range(3)):
            yield f"separate {mode} {index} {part}", _output(_node("SeparateColor", colour, mode=mode), part)
    for kind, values in (("CombineRGB", (0.7, 0.4, 0.3)), ("CombineHSV", (0.7, 0.4, 0.3)), ("CombineXYZ", (2, 1, 3))):
        yield kind, _node(kind, *values)
    for kind, part in itertools.product(("SeparateRGB", "SeparateHSV", "SeparateXYZ"), range(3)):
        yield f"{kind} {part}", _output(_node(kind, WARM[: 3 if kind == "SeparateXYZ" else 4]), part)
    yield "falloff", _node("LightFalloff", 4.0)
    for kind, low in itertools.product(("MINMAX", "RANGE"), (0.5, 2.0)):
        yield f"clamp {kind} {low}", _node("Clamp", 1.7, low, 1.2, clamp_type=kind)
    yield from _ranges()
    yield "gamma", _node("Gamma", WARM, 2.2)
    yield "gamma 0", _node("Gamma", WARM, 0.0)
    yield "invert", _node("Invert", 0.8, WARM)
    yield "bright contrast", _node("BrightContrast", WARM, 0.1, 0.6)
    yield "hue saturation", _node("HueSaturation", 0.3, 1.4, 1.2, 0.9, WARM)
    yield "hue saturation bright", _node("HueSaturation", 0.9, 0.6, 1.2, 1.0, BRIGHT)
    yield "grey of colour", _node("RGBToBW", WARM)
    yield "colour as number", _number_of("CombineColor", 0.7, 0.4, 0.3)
    yield "vector as number", _number_of("CombineXYZ", 2, 1, 3)
    yield "RGB curves", _curves
    yield "float curve", _float_curve
    yield "ramp", _ramp
    yield "ramp alpha", _output(_ramp, 1)


def _ranges() -> Iterator[tuple[str, Callable[[Any], Any]]]:
    for kind in _choices("MapRange", "interpolation_type"):
        for index, values in enumerate(((0.6, 0.2, 1.2, 1, 3, 4), (1.5, 0.2, 1.2, 3, 1, 4), (0.45, 0.9, 0.1, 1, 2, 3))):
            for clamp in (False, True):
                settings = {"interpolation_type": kind, "clamp": clamp}
                yield f"range {kind} {index} {clamp}", _node("MapRange", *values, **settings)
                vectors = [(value, value * 1.1, value * 0.9) for value in values]
                settings |= {"data_type": "FLOAT_VECTOR"}
                yield f"vector range {kind} {index} {clamp}", _node("MapRange", *vectors, **settings)
    yield "range of nothing", _node("MapRange", 1.0, 0.5, 0.5, 1, 2)


def _output(make: Callable[[Any], Any], index: int) -> Callable[[Any], Any]:
    return lambda tree: make(tree).node.outputs[index]


def _number_of(kind: str, *values: float) -> Callable[[Any], Any]:
    """A colour's or vector's number, by a Math node that adds 0 to it."""

    def make(tree: Any) -> Any:
        output = _node("Math", 0.0, 0.0, operation="ADD")(tree)
        tree.links.new(_node(kind, *values)(tree), output.node.inputs[0])
        return output

    return make


def _curves(tree: Any) -> Any:
    output = _node("RGBCurve", 0.7, WARM)(tree)
    mapping = output.node.mapping
    for curve, y in zip(mapping.curves, (0.8, 0.1, 0.4, 0.6), strict=True):
        curve.points.new(0.5, y)
    mapping.update()
    return output


def _float_curve(tree: Any) -> Any:
    output = _node("FloatCurve", 0.7, 0.3)(tree)
    output.node.mapping.curves[0].points.new(0.5, 0.8)
    output.node.mapping.update()
    return output


def _ramp(tree: Any) -> Any:
    output = _node("ValToRGB", 0.3)(tree)
    elements = output.node.color_ramp.elements
    elements[0].color, elements[1].color = (0.1, 0.2, 0.9, 0.2), WARM
    elements.new(0.6).color = (1, 1, 0, 0.5)
    return output


def _cycles(path: Path) -> None:
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.cycles.device, scene.cycles.samples = "CPU", 1
    scene.cycles.use_denoising = scene.cycles.use_adaptive_sampling = False
    scene.cycles.filter_width = 0.01
    render = scene.render
    render.image_settings.file_format, render.image_settings.color_depth = "OPEN_EXR", "32"
    render.filepath = str(path)
    bpy.ops.render.render(write_still=True)
