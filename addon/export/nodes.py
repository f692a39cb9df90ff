"""Node trees read as constants: what feeds a socket, and the number or colour it stands for.

Pivot shades with constants for now. What constants.py has a row for is computed; a node that varies over a surface is
reported once and stands for its nearest constant: an image for its average, anything else for the mean of its colour
inputs, or mid grey.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple

import bpy
import numpy as np

from ..report import Reporter
from .colour import LUMINANCE, Colour
from .constants import CONSTANTS
from .image import mean_pixel

MID_GREY = 0.5


@dataclass(frozen=True)
class Owner:
    """Whose nodes are being read: how reports name it, "object 'Cube', material 'Red'"."""

    name: str
    reporter: Reporter

    def warn(self, node: bpy.types.Node, text: str) -> None:
        self.reporter.warn(f"{self.name}, node '{node.name}': {text}")


class Socket(NamedTuple):
    """A socket and the group nodes entered to reach it, outermost first."""

    socket: bpy.types.NodeSocket
    groups: tuple[bpy.types.Node, ...] = ()

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


def output_surface(tree: bpy.types.NodeTree) -> Socket | None:
    """The Surface input of the tree's active output, as Cycles chooses it."""
    output = tree.get_output_node("CYCLES")
    return None if output is None else Socket(output.inputs["Surface"])


def source(target: Socket) -> Socket | None:
    """What feeds an input: an output socket of a real node, or the input socket whose own value counts.

    Follows links through reroutes, muted nodes and groups. None where a link leads nowhere.
    """
    while True:
        link = next((link for link in target.socket.links if link.is_valid and not link.is_muted), None)
        if link is None:
            return target
        follow = _through(Socket(link.from_socket, target.groups))
        if follow is None or follow.socket.is_output:
            return follow
        target = follow


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
    if node.type == "GROUP_INPUT":
        return _matching(groups[-1].inputs, output.socket, groups[:-1]) if groups else None
    return output


def _matching(sockets: Any, socket: bpy.types.NodeSocket, groups: tuple[bpy.types.Node, ...]) -> Socket | None:
    match = next((candidate for candidate in sockets if candidate.identifier == socket.identifier), None)
    return None if match is None else Socket(match, groups)


def is_constant(target: Socket, value: float) -> bool:
    """Whether an input surely has one value."""
    feed = source(target)
    return feed is not None and not feed.socket.is_output and np.all(_own_value(feed.socket) == np.float32(value))


def is_linked(target: Socket) -> bool:
    feed = source(target)
    return feed is not None and feed.socket.is_output


def colour(target: Socket, owner: Owner, unknown: float = MID_GREY) -> Colour:
    """The (3,) colour of an input. unknown: the grey of what has no nearest colour."""
    value = _value(target, owner)
    return np.full(3, unknown) if value is None else value


def number(target: Socket, owner: Owner, unknown: float | None = None) -> float:
    """The number of an input. unknown: for what has no nearest number; None: the input's own value, under the link."""
    value = _value(target, owner)
    if value is None:
        value = _own_value(target.socket) if unknown is None else np.full(3, unknown)
    if np.ptp(value) == 0:
        return float(value[0])  # to the last bit, for nodes that round
    feed = source(target)
    return float(value.mean() if feed is not None and feed.socket.type == "VECTOR" else value @ LUMINANCE)


def _own_value(socket: Any) -> Colour:
    """(3,): a socket's own value, numbers as grey."""
    value = np.atleast_1d(np.array(socket.default_value, float))
    return np.full(3, value[0]) if value.size == 1 else value[:3]


def _value(target: Socket, owner: Owner) -> Colour | None:
    """(3,): what an input stands for; None when that has no nearest constant."""
    feed = source(target)
    if feed is None:
        return np.zeros(3)
    node = feed.node
    if not feed.socket.is_output or node.type in {"RGB", "VALUE"}:
        return _own_value(feed.socket)
    if node.type in {"TEX_IMAGE", "TEX_ENVIRONMENT"}:
        return _image_value(feed, owner)
    if node.type in CONSTANTS:
        return CONSTANTS[node.type](Inputs(feed, owner))
    if node.type == "FRESNEL":
        owner.warn(node, "Fresnel factors are not supported, it stands for its mean over all directions")
        return np.full(3, mean_fresnel(number(feed.input("IOR"), owner)))
    if node.type == "LAYER_WEIGHT":
        owner.warn(node, "layer weights are not supported, it stands for its mean over all directions")
        blend = min(number(feed.input("Blend"), owner), 1 - 1e-4)
        return np.full(3, mean_fresnel(1 / (1 - blend)))
    colours = [Socket(s, feed.groups) for s in node.inputs if s.type == "RGBA" and s.enabled]
    if not colours:
        owner.warn(node, f"{node.bl_label} nodes are not supported, it stands for a constant")
        return None
    owner.warn(node, f"{node.bl_label} nodes are not supported, it stands for the mean of its colours")
    return np.mean([colour(c, owner) for c in colours], axis=0)


@dataclass(frozen=True)
class Inputs:
    """The inputs of the node of an output as constants: a constants.Node."""

    feed: Socket
    owner: Owner

    @property
    def node(self) -> Any:
        return self.feed.node

    @property
    def output(self) -> str:
        return self.feed.socket.identifier

    def number(self, *identifiers: str | int, unknown: float | None = None) -> float:
        return number(self.feed.input(*identifiers), self.owner, unknown)

    def colour(self, *identifiers: str | int) -> Colour:
        return colour(self.feed.input(*identifiers), self.owner)

    def warn(self, text: str) -> None:
        self.owner.warn(self.node, text)


def _image_value(feed: Socket, owner: Owner) -> Colour | None:
    node = feed.node
    mean = None if node.image is None else mean_pixel(node.image, node.type == "TEX_ENVIRONMENT")
    if mean is None:
        owner.warn(node, "its image is missing, it stands for mid grey")
        return np.full(3, MID_GREY)
    owner.warn(node, "image textures are not supported, it stands for its average")
    return np.full(3, mean[3]) if feed.socket.name == "Alpha" else mean[:3]


def mean_fresnel(ior: float) -> float:
    """Unpolarised dielectric reflectance averaged over the cosine-weighted hemisphere."""
    cos_i = np.sqrt((np.arange(256) + 0.5) / 256)
    sin2_t = (1 - cos_i**2) / max(ior, 1e-3) ** 2
    cos_t = np.sqrt(np.maximum(0, 1 - sin2_t))
    parallel = (ior * cos_i - cos_t) / (ior * cos_i + cos_t)
    perpendicular = (cos_i - ior * cos_t) / (cos_i + ior * cos_t)
    reflectance = np.where(sin2_t < 1, (parallel**2 + perpendicular**2) / 2, 1.0)
    return float(reflectance.mean())
