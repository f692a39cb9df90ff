"""Nodes that reckon with numbers, vectors and colours: for each, functions that make one and give its output."""

from __future__ import annotations

import itertools
from collections.abc import Callable, Iterator
from typing import Any

import bpy

Make = Callable[[Any], Any]  # of a node tree: an output of a new node

WARM, COOL = (0.8, 0.3, 0.1, 1), (0.2, 0.6, 0.9, 1)
BRIGHT = (2.5, 0.4, 1.2, 1)
TEMPERATURES_K = (100, 799, 800, 900, 1000, 1300, 1700, 2500, 4000, 6500, 10000, 11999, 12000, 40000)
WAVELENGTHS_NM = (370, 376, 380, 452, 511, 578, 633, 779, 781)


def _node(kind: str, *inputs: Any, **settings: Any) -> Make:
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


def node_kinds() -> Iterator[tuple[str, Make]]:
    """By a name of its own, each kind of node with each of its settings, and some values."""
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
    for wavelength_nm in WAVELENGTHS_NM:
        yield f"wavelength {wavelength_nm}", _node("Wavelength", wavelength_nm)
    yield from _turned()
    yield from _curves()
    yield from _ramps()


def _ranges() -> Iterator[tuple[str, Make]]:
    for kind in _choices("MapRange", "interpolation_type"):
        for index, values in enumerate(((0.6, 0.2, 1.2, 1, 3, 4), (1.5, 0.2, 1.2, 3, 1, 4), (0.45, 0.9, 0.1, 1, 2, 3))):
            for clamp in (False, True):
                settings = {"interpolation_type": kind, "clamp": clamp}
                yield f"range {kind} {index} {clamp}", _node("MapRange", *values, **settings)
                vectors = [(value, value * 1.1, value * 0.9) for value in values]
                settings |= {"data_type": "FLOAT_VECTOR"}
                yield f"vector range {kind} {index} {clamp}", _node("MapRange", *vectors, **settings)
    yield "range of nothing", _node("MapRange", 1.0, 0.5, 0.5, 1, 2)


def _output(make: Make, index: int) -> Make:
    return lambda tree: make(tree).node.outputs[index]


def _number_of(kind: str, *values: float) -> Make:
    """A colour's or vector's number, by a Math node that adds 0 to it."""

    def make(tree: Any) -> Any:
        output = _node("Math", 0.0, 0.0, operation="ADD")(tree)
        tree.links.new(_node(kind, *values)(tree), output.node.inputs[0])
        return output

    return make


def _turned() -> Iterator[tuple[str, Make]]:
    vector, angles = (0.8, 0.3, 0.1), (0.4, -1.1, 2.0)
    for kind, invert in itertools.product(_choices("VectorRotate", "rotation_type"), (False, True)):
        inputs: tuple[Any, ...] = (vector, (0.1, 0.2, -0.3))
        inputs += {"AXIS_ANGLE": ((0.2, 2.0, 0.5), 0.7), "EULER_XYZ": (angles,)}.get(kind, (0.7,))
        yield f"rotate {kind} {invert}", _node("VectorRotate", *inputs, rotation_type=kind, invert=invert)
    yield "rotate about nothing", _node("VectorRotate", vector, (0.1, 0.2, -0.3), (0, 0, 0), 0.7)
    for kind in _choices("Mapping", "vector_type"):
        location = [(0.1, 0.2, -0.3)] if kind in {"POINT", "TEXTURE"} else []
        yield f"mapping {kind}", _node("Mapping", vector, *location, angles, (1.5, 0.0, -2.0), vector_type=kind)
    for index in range(2):
        yield f"normal {index}", _output(_normal, index)


def _normal(tree: Any) -> Any:
    output = _node("Normal", (0.8, 0.3, 0.1))(tree)
    output.default_value = (0.6, 0.0, 0.8)
    return output


def _curves() -> Iterator[tuple[str, Make]]:
    for extend in ("EXTRAPOLATED", "HORIZONTAL"):
        yield f"RGB curves {extend}", _curved("RGBCurve", (0.8, 0.1, 0.4, 0.6), extend, 0.7, WARM)
        yield f"vector curves {extend}", _curved("VectorCurve", (0.8, -0.7, 0.4), extend, 0.7, (0.8, -0.3, 0.1))
        yield f"float curve {extend}", _curved("FloatCurve", (0.8,), extend, 0.7, 0.3)


def _curved(kind: str, heights: tuple[float, ...], extend: str, *inputs: Any) -> Make:
    def make(tree: Any) -> Any:
        output = _node(kind, *inputs)(tree)
        mapping = output.node.mapping
        mapping.extend = extend
        for curve, y in zip(mapping.curves, heights, strict=True):
            curve.points.new(0.5, y)
        mapping.curves[0].points[-1].location = (0.9, 0.7)
        mapping.update()
        return output

    return make


def passed_on() -> Iterator[tuple[str, Make]]:
    """What a muted node passes on of an input that nothing feeds, and sockets of groups on the way."""
    yield "muted of nothing", _muted("RGBToBW", WARM)
    for kind in ("Float", "Vector", "Color"):
        yield f"through a group's {kind}", _through_group(kind)


def _muted(*arguments: Any) -> Make:
    def make(tree: Any) -> Any:
        output = _node(*arguments)(tree)
        output.node.mute = True
        return output

    return make


def _through_group(kind: str) -> Make:
    """A colour by way of a group whose only sockets are of a type, in and out."""

    def make(tree: Any) -> Any:
        group = bpy.data.node_groups.new(f"through {kind}", "ShaderNodeTree")
        if hasattr(group, "interface"):
            for direction in ("INPUT", "OUTPUT"):
                group.interface.new_socket("Passed", in_out=direction, socket_type=f"NodeSocket{kind}")
        else:
            group.inputs.new(f"NodeSocket{kind}", "Passed")
            group.outputs.new(f"NodeSocket{kind}", "Passed")
        start, end = (group.nodes.new(f"NodeGroup{side}") for side in ("Input", "Output"))
        group.links.new(start.outputs[0], end.inputs[0])
        node = tree.nodes.new("ShaderNodeGroup")
        node.node_tree = group
        tree.links.new(_node("Invert", 1.0, WARM)(tree), node.inputs[0])
        return node.outputs[0]

    return make


def _ramps() -> Iterator[tuple[str, Make]]:
    kinds = [("RGB", kind, "NEAR") for kind in ("LINEAR", "CONSTANT", "EASE", "CARDINAL", "B_SPLINE")]
    turns = ("NEAR", "FAR", "CW", "CCW")
    for mode, kind, turn in (*kinds, *itertools.product(("HSV", "HSL"), ("LINEAR",), turns)):
        for name, index in (("colour", 0), ("alpha", 1)):
            yield f"ramp {mode} {kind} {turn} {name}", _output(_ramp(mode, kind, turn), index)


def _ramp(mode: str, interpolation: str, turn: str) -> Make:
    def make(tree: Any) -> Any:
        output = _node("ValToRGB", 0.3)(tree)
        ramp = output.node.color_ramp
        ramp.color_mode, ramp.hue_interpolation = mode, turn
        if mode == "RGB":
            ramp.interpolation = interpolation
        ramp.elements[0].color, ramp.elements[1].color = (0.1, 0.2, 0.9, 0.2), WARM
        ramp.elements.new(0.6).color = (1, 1, 0, 0.5)
        return output

    return make
