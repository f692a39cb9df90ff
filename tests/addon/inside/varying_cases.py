"""Emission through each node whose inputs vary over a surface: tiles as Cycles and Pivot show them."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

from node_kinds import Make, node_kinds
from node_tiles import render, tiles

TILE_PX = 16
# What inputs vary by: numbers that a tile's x and y are multiplied with, and one to add. x and y are whole multiples of
# a quarter, -2 to 1.75: both engines have the same to the last bit, and what has no answer at 0 or 1 is met.
MIXTURES = (
    *((1, 0, 0), (0, 1, 0), (0.5, -0.5, 0), (0.25, 0.25, 1), (-1, 0.5, 2), (0, -1, 0.75), (0.5, 0, 0.5)),
    *((0, 0.25, -1), (1, 1, 0.25), (-0.25, 0, 3), (0.75, -1.5, 0.5)),
)
BY_INPUT = {  # of a kind of node and an input's name: what says more of it
    ("BLACKBODY", "Temperature"): (4000, 300, 8000),
    ("WAVELENGTH", "Wavelength"): (100, 12, 575),
    ("VALTORGB", "Fac"): (0.25, 1 / 64, 0.53),
    ("VALTORGB", "Factor"): (0.25, 1 / 64, 0.53),
}


def main(folder: Path) -> Any:
    made = tiles(_kinds(), TILE_PX)
    for engine in ("CYCLES", "PIVOT"):
        render(engine, folder / f"{engine.lower()}.exr")
    return made


def _kinds() -> Iterator[tuple[str, Any]]:
    met: set[Any] = set()
    for name, make in node_kinds():
        yield name, lambda tree, middle, make=make: _varying(tree, middle, make, met)


def _varying(tree: Any, middle: Any, make: Make, met: set[Any]) -> Any:
    """The output, all inputs linked. Raises RuntimeError where a tile has the node with the same settings already."""
    output = make(tree)
    node = output.node
    settings = (repr(getattr(node, p.identifier)) for p in node.bl_rna.properties if p.type in {"ENUM", "BOOLEAN"})
    key = (node.bl_idname, output.identifier, *settings)
    if key in met and not hasattr(node, "color_ramp") and not hasattr(node, "mapping"):
        raise RuntimeError("there already")
    met.add(key)
    place = _place(tree, middle)
    there = [s for s in node.inputs if s.enabled and not s.is_unavailable and not s.is_linked and s.name != "Smooth"]
    for index, socket in enumerate(there):
        tree.links.new(_input(tree, place, socket, index), socket)
    return output


def _place(tree: Any, middle: Any) -> Any:
    """An output: the place on the tile, in quarters."""
    value = tree.nodes.new("ShaderNodeNewGeometry").outputs["Position"]
    for operation, operand in (("SUBTRACT", middle), ("SCALE", TILE_PX / 2), ("FLOOR", None), ("SCALE", 0.25)):
        node = tree.nodes.new("ShaderNodeVectorMath")
        node.operation = operation
        tree.links.new(value, node.inputs[0])
        if operation == "SCALE":
            node.inputs["Scale"].default_value = operand
        elif operand:
            node.inputs[1].default_value = operand
        value = node.outputs["Vector"]
    return value


def _input(tree: Any, place: Any, socket: Any, index: int) -> Any:
    """An output for an input: a number, or three."""
    if socket.type == "VALUE":
        return _mixture(tree, place, BY_INPUT.get((socket.node.type, socket.name), MIXTURES[index % len(MIXTURES)]))
    combined = tree.nodes.new("ShaderNodeCombineXYZ")
    for part in range(3):
        tree.links.new(_mixture(tree, place, MIXTURES[(index + 4 * part) % len(MIXTURES)]), combined.inputs[part])
    return combined.outputs[0]


def _mixture(tree: Any, place: Any, weights: tuple[float, float, float]) -> Any:
    x, y, added = weights
    product = tree.nodes.new("ShaderNodeVectorMath")
    product.operation = "DOT_PRODUCT"
    tree.links.new(place, product.inputs[0])
    product.inputs[1].default_value = (x, y, 0)
    total = tree.nodes.new("ShaderNodeMath")
    total.operation = "ADD"
    tree.links.new(product.outputs["Value"], total.inputs[0])
    total.inputs[1].default_value = added
    return total.outputs[0]
