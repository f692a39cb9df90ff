"""Node trees read as values: what feeds a socket, and the numbers or registers it stands for.

A node is a row in a table of one of the files beside this one. One without a row is reported once and stands for its
nearest constant: the mean of its colour inputs, or mid grey.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any, NamedTuple

import bpy
import numpy as np

from ...report import Reporter
from ..program import Program, UnknownOp, Value
from . import colours, constants, curves, geometry, images, lamps, maths, normals, object, ray, skies, textures
from .row import Row

MID_GREY = 0.5

# By bpy.types.Node.type.
ROWS: dict[str, Row] = (
    maths.ROWS
    | constants.ROWS
    | colours.ROWS
    | curves.ROWS
    | geometry.ROWS
    | object.ROWS
    | ray.ROWS
    | skies.ROWS
    | normals.ROWS
    | textures.ROWS
    | images.ROWS
    | lamps.ROWS
)


@dataclass(frozen=True)
class Owner:
    """Whose nodes are being read: how reports name it, "object 'Cube', material 'Red'", and the program they become."""

    name: str
    reporter: Reporter
    program: Program
    data: bpy.types.ID | None = None  # the material, world or light
    neighbour: int = 0  # 1 or 2: what nodes give at the places beside; from 3 on, where bump mapping looks
    lamp_axes: Any = None  # of a lamp's own space in world space, (3, 3); None of what is none
    displaced_normal: Value | None = None  # the surface's own, where bump mapping by the output has turned it

    def warn(self, node: bpy.types.Node, text: str) -> None:
        self.reporter.warn(f"{self.name}, node '{node.name}': {text}")


class Socket(NamedTuple):
    """A socket, the group nodes entered to reach it, outermost first, and the types of the sockets passed on the way.

    A value becomes of each type that it passes: groups, reroutes and muted nodes have sockets of their own.
    """

    socket: bpy.types.NodeSocket
    groups: tuple[bpy.types.Node, ...] = ()
    passed: tuple[str, ...] = ()  # the last is the nearest to the socket

    @property
    def node(self) -> Any:
        return self.socket.node

    def input(self, *identifiers: str | int) -> Socket:
        """The node's input of the first identifier it has (their names differ between Blenders), or by position.

        Raises KeyError when it has none of them.
        """
        found = self.find_input(*identifiers)
        if found is None:
            raise KeyError(f"{self.node.bl_idname} has none of the inputs {identifiers}")
        return found

    def find_input(self, *identifiers: str | int) -> Socket | None:
        for identifier in identifiers:
            for index, socket in enumerate(self.node.inputs):
                if identifier in (socket.identifier, index):
                    return Socket(socket, self.groups)
        return None


def active_tree(data: bpy.types.ID) -> bpy.types.NodeTree | None:
    """The node tree a material, world or light is shaded by, None without."""
    if bpy.app.version >= (5, 0) and not isinstance(data, bpy.types.Light):
        return data.node_tree
    return data.node_tree if data.use_nodes else None


def output_socket(tree: bpy.types.NodeTree, name: str) -> Socket | None:
    """An input of the tree's active output, "Surface" or "Volume", as Cycles chooses it; None: it has none of them."""
    output = tree.get_output_node("CYCLES")
    found = None if output is None else output.inputs.get(name)
    return None if found is None else Socket(found)


def source(target: Socket) -> Socket | None:
    """What feeds an input: an output socket of a real node, or the input socket whose own value counts.

    Follows links through reroutes, muted nodes and groups. None where a link leads nowhere.
    """
    passed: tuple[str, ...] = ()
    while True:
        # Blender looks for the links of a socket through the whole tree.
        links = target.socket.links if target.socket.is_linked else ()
        link = next((link for link in links if _counts(link)), None)
        if link is None:
            return target._replace(passed=passed)
        follow = _through(Socket(link.from_socket, target.groups))
        if link.from_node.mute and link.from_node.type != "REROUTE":
            if follow is None or (_UNFED_IS_UNLINKED and not follow.socket.is_linked):
                return target._replace(passed=passed)  # as if there were no link
            if not follow.socket.is_linked:
                return None
        if follow is None or follow.socket.is_output:
            return None if follow is None else follow._replace(passed=passed)
        passed += (link.from_socket.type, follow.socket.type)
        target = follow


def _counts(link: bpy.types.NodeLink) -> bool:
    """Outputs that a node has not with its settings feed nothing."""
    return link.is_valid and not link.is_muted and not link.from_socket.is_unavailable


def _through(output: Socket) -> Socket | None:
    """The input that an output only passes on; the output itself where its node computes something; None: nothing."""
    node, groups = output.node, output.groups
    if node.mute and node.type != "REROUTE":
        link = next((link for link in node.internal_links if link.to_socket == output.socket), None)
        return Socket(link.from_socket, groups) if link else None
    if node.type == "REROUTE":
        inner = Socket(node.inputs[0], groups)
        return inner if node.inputs[0].is_linked else None
    if node.type == "GROUP":
        nodes = node.node_tree.nodes if node.node_tree else ()
        end = next((n for n in nodes if n.type == "GROUP_OUTPUT" and n.is_active_output), None)
        return _matching(end.inputs, output.socket, (*groups, node)) if end else None
    if node.type == "MENU_SWITCH":  # from Blender 5.0
        return _chosen(output)
    if node.type == "GROUP_INPUT":
        return _matching(groups[-1].inputs, output.socket, groups[:-1]) if groups else None
    return output


def _chosen(output: Socket) -> Socket:
    """The input that a Menu Switch's menu names; the output itself where that is not known."""
    menu = source(output.input("Menu"))
    if menu is None or output.socket.identifier != "Output":
        return output
    if menu.socket.is_output and menu.node.bl_idname != "FunctionNodeInputMenu":
        return output
    name = menu.node.value if menu.socket.is_output else menu.socket.default_value
    item = next((socket for socket in output.node.inputs[1:] if socket.name == name), None)
    return output if item is None else Socket(item, output.groups)


def _matching(sockets: Any, socket: bpy.types.NodeSocket, groups: tuple[bpy.types.Node, ...]) -> Socket | None:
    match = next((candidate for candidate in sockets if candidate.identifier == socket.identifier), None)
    return None if match is None else Socket(match, groups)


def is_constant(target: Socket, value: float) -> bool:
    """Whether an input surely has one value."""
    feed = source(target)
    return feed is not None and not feed.socket.is_output and bool(np.all(_own_value(feed.socket) == np.float32(value)))


def is_linked(target: Socket) -> bool:
    feed = source(target)
    return feed is not None and feed.socket.is_output


def colour(target: Socket, owner: Owner, unknown: float = MID_GREY) -> Value:
    """The three parts of a colour or vector. unknown: the grey of what has no nearest colour."""
    value, _ = _value(target, owner)
    return owner.program.colour([unknown] * 3) if value is None else value.widened()


def number(target: Socket, owner: Owner, unknown: float | None = None) -> Value:
    """One part. unknown: for what has no nearest number; None: the input's own value, under the link."""
    value, kind = _value(target, owner)
    if value is None:
        own = _own_value(target.socket)
        return owner.program.number(float(own.mean()) if unknown is None else unknown)
    return _as_number(value, kind)


def normal(feed: Socket, owner: Owner, *identifiers: str) -> Value | None:
    """What a shader's Normal input, or one of these, is turned to, world space; None: the surface's own."""
    target = feed.find_input(*(identifiers or ("Normal",)))
    return colour(target, owner) if target is not None and is_linked(target) else owner.displaced_normal


def tangent(feed: Socket, owner: Owner) -> Value:
    """Which way a shader's Tangent input points, world space."""
    target = feed.find_input("Tangent")
    if target is not None and is_linked(target):
        return colour(target, owner)
    return geometry.default_tangent(Node(feed, owner))


def displaced(target: Socket, owner: Owner) -> Owner:
    """The owner with the normal that the displacement at a socket turns it to, as bump mapping."""
    program, filter_width = owner.program, normals.DISPLACEMENT_FILTER_WIDTH
    own, first = program.op("normal"), program.program.bump_neighbour(filter_width)
    owners = [replace(owner, neighbour=neighbour) for neighbour in (0, first, first + 1)]
    heights = program.joined(*(program.op("vector_dot_product", colour(target, each), own) for each in owners))
    one = program.number(1.0)
    return replace(
        owner, displaced_normal=program.op("bump", own, heights, one, one, settings=normals.bump_settings(filter_width))
    )


def _own_value(socket: Any) -> Any:
    """(1,) or (3,): a socket's own value."""
    return np.atleast_1d(np.array(socket.default_value, float))[:3]


def _value(target: Socket, owner: Owner) -> tuple[Value | None, str]:
    """What an input stands for, None when that has no nearest constant; and the type of the socket it comes from."""
    feed = source(target)
    if feed is None:
        return owner.program.number(0.0), "VALUE"
    value, kind = _given(feed, owner)
    if value is None or (kind == "RGBA" and not _COLOURS_CONVERT):
        return value, kind
    for passed in reversed(feed.passed):
        if passed in _NUMBERS:
            value, kind = _as_number(value, kind), passed
        elif passed in _TRIPLES:
            value, kind = value.widened(), passed
    return value, kind


def _as_number(value: Value, kind: str) -> Value:
    """The one part of a value that comes from a socket of a type."""
    if len(value.parts) == 1:
        return value
    return value.mean() if kind == "VECTOR" else value.luminance()


_UNFED_IS_UNLINKED = bpy.app.version >= (5, 0)  # what a muted node passes on of an input that nothing feeds; before: 0
# From 5.0 on, Blender hands Cycles a tree without groups, in which colours have passed their sockets as they were.
_COLOURS_CONVERT = bpy.app.version < (5, 0)
_NUMBERS, _TRIPLES = {"VALUE", "INT", "BOOLEAN"}, {"RGBA", "VECTOR"}  # types of sockets


def _given(feed: Socket, owner: Owner) -> tuple[Value | None, str]:
    """What a feed gives, None when that has no nearest constant; and the type of its socket."""
    node, kind = feed.node, feed.socket.type
    if not feed.socket.is_output or node.type in {"RGB", "VALUE"}:
        own = _own_value(feed.socket)
        return (owner.program.number(own[0]) if own.size == 1 else owner.program.colour(own)), kind
    lack = f"{node.bl_label} nodes are"
    if node.type in ROWS:
        try:
            return ROWS[node.type](Node(feed, owner)), kind
        except UnknownOp as op:  # a setting of a newer Blender's
            lack = f"{op} of {node.bl_label} nodes is"
    colours = [Socket(s, feed.groups) for s in node.inputs if s.type == "RGBA" and s.enabled]
    if not colours:
        owner.warn(node, f"{lack} not supported, it stands for a constant")
        return None, kind
    owner.warn(node, f"{lack} not supported, it stands for the mean of its colours")
    total = sum((colour(c, owner) for c in colours), start=owner.program.colour((0, 0, 0)))
    return total / float(len(colours)), kind


@dataclass(frozen=True)
class Node:
    """A node of which an output is asked for: what a row sees."""

    feed: Socket
    owner: Owner

    @property
    def node(self) -> Any:
        return self.feed.node

    @property
    def output(self) -> str:
        """The identifier of the output that is asked for."""
        return self.feed.socket.identifier

    @property
    def output_index(self) -> int:
        return next(i for i, socket in enumerate(self.node.outputs) if socket.identifier == self.output)

    @property
    def program(self) -> Program:
        return self.owner.program

    @property
    def neighbour(self) -> int:
        return self.owner.neighbour

    def has(self, *identifiers: str | int) -> bool:
        return self.feed.find_input(*identifiers) is not None

    def is_linked(self, *identifiers: str | int) -> bool:
        target = self.feed.find_input(*identifiers)
        return target is not None and is_linked(target)

    def number(self, *identifiers: str | int, unknown: float | None = None) -> Value:
        """unknown: for an input that has no nearest constant; None: its own value."""
        return number(self.feed.input(*identifiers), self.owner, unknown)

    def colour(self, *identifiers: str | int) -> Value:
        """The three parts of a colour or a vector."""
        return colour(self.feed.input(*identifiers), self.owner)

    vector = colour

    def own_value(self, identifier: str) -> float:
        return float(self.feed.input(identifier).socket.default_value)

    def normal(self) -> Value:
        turned = normal(self.feed, self.owner)
        return self.op("normal") if turned is None else turned

    @property
    def is_world(self) -> bool:
        return isinstance(self.owner.data, bpy.types.World)

    @property
    def lamp_axes(self) -> Any:
        return self.owner.lamp_axes

    @property
    def material_index(self) -> int:
        return self.owner.data.pass_index if isinstance(self.owner.data, bpy.types.Material) else 0

    def op(self, name: str, *inputs: Value, settings: Any = (), image: Any = None) -> Value:
        return self.program.op(name, *inputs, settings=settings, image=image, neighbour=self.owner.neighbour)

    def beside(self, neighbour: int) -> Node:
        """The same at a place beside, along one of two directions (1, 2), or at the place itself (0)."""
        return replace(self, owner=replace(self.owner, neighbour=neighbour))

    def bumped(self, filter_width: float) -> tuple[Node, Node]:
        """The same at the two places that bump mapping looks at, so many footprints away."""
        first = self.program.program.bump_neighbour(filter_width)
        return self.beside(first), self.beside(first + 1)

    def warn(self, text: str) -> None:
        self.owner.warn(self.node, text)
