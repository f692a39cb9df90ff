"""Inside Blender: random graphs of shader nodes, by the kinds of node_graph_kinds.py."""

from __future__ import annotations

import random
from collections.abc import Iterator
from typing import Any

import bpy
import node_graph_kinds as kinds
from node_graph_scene import ATTRIBUTES, COLOR_LAYERS, UV_MAPS

MOST_NODES = 40
LINKED = 0.35  # how likely an input is linked, after the first
SHARED = 0.15  # how likely a link comes from a node that is there
UNLINKED = 0.15  # how likely a node alone has constant inputs only
TYPES = ("VALUE", "INT", "VECTOR", "RGBA")


class Maker:
    """Fills a tree. allowed: the kinds to draw from. kinds: those drawn. settings: a line about each node, by name."""

    def __init__(self, tree: Any, rng: random.Random, allowed: list[str]) -> None:
        self.tree = tree
        self.rng = rng
        self.allowed = [kind for kind in allowed if hasattr(bpy.types, f"ShaderNode{kind}")]
        self.kinds: set[str] = set()
        self.settings: dict[str, str] = {}
        self._outputs: list[Any] = []  # that a later link may share
        self._may_group = set(kinds.OPERATIONS) & set(allowed) == set(kinds.OPERATIONS)

    def feed(self, target: Any, depth: int) -> None:
        """Link a subtree of that depth to an input."""
        if self._outputs and self.rng.random() < SHARED:
            output = self.rng.choice(self._outputs)
        elif self._may_group and depth > 2 and self.rng.random() < 0.08:
            output = self._group(depth)
        else:
            drawn = kinds.TEXTURES + kinds.SOURCES if depth == 1 else kinds.TEXTURES + kinds.OPERATIONS
            found = [kind for kind in drawn if kind in self.allowed] or self.allowed
            kind = self.rng.choices(found, [kinds.WEIGHTS.get(kind, 1) for kind in found])[0]
            output = self._linked_node(kind, depth)
        self.link(output, target)

    def link(self, output: Any, target: Any) -> None:
        """By way of a reroute at times."""
        if self.rng.random() < 0.05:
            reroute = self.tree.nodes.new("NodeReroute")
            self.tree.links.new(output, reroute.inputs[0])
            output = reroute.outputs[0]
            self.kinds.add(kinds.REROUTE)
        self.tree.links.new(output, target)

    def node(self, kind: str, variant: int | None = None) -> Any:
        """A node of random settings and values. variant: counts through the longest of its enums."""
        node = self.tree.nodes.new(f"ShaderNode{kind}")
        self.kinds.add(kind)
        said = list(self._draw_settings(node, variant))
        self._draw_data(kind, node)
        for socket in usable(node.inputs):
            self._draw_value(kind, socket)
        self.settings[node.name] = " ".join([kind, *said])
        return node

    def scaled(self, kind: str, target: Any) -> Any:
        """The input to link in the place of target, so that its node gets values that mean something to it."""
        low, high = kinds.value_range(kind, target.name, is_factor(target))
        if kind == "TexWhiteNoise":  # its cells are single floats: both renderers are to see the same
            vector = target.type == "VECTOR"
            snap = self.tree.nodes.new("ShaderNodeVectorMath" if vector else "ShaderNodeMath")
            snap.operation = "SNAP"
            snap.inputs[1].default_value = (0.31, 0.37, 0.41) if vector else 0.37
            self.tree.links.new(snap.outputs[0], target)
            target = snap.inputs[0]
        elif high - low > kinds.WIDE:
            scale = self.tree.nodes.new("ShaderNodeMath")
            scale.operation = "MULTIPLY_ADD"
            scale.inputs[1].default_value, scale.inputs[2].default_value = high - low, low
            self.tree.links.new(scale.outputs[0], target)
            target = scale.inputs[0]
        return target

    def single(self, target: Any, kind: str, variant: int) -> None:
        """Feed an input by one node, whose own inputs are constants or coordinates of the plane."""
        node = self.node(kind, variant)
        inputs = list(usable(node.inputs))
        if inputs and self.rng.random() > UNLINKED:
            linked = [socket for socket in inputs if self.rng.random() < 0.6] or [self.rng.choice(inputs)]
            coordinates = self.tree.nodes.new("ShaderNodeTexCoord").outputs
            for number, socket in enumerate(linked):
                low, _ = kinds.value_range(kind, socket.name, is_factor(socket))
                signed = low < 0 and socket.type != "RGBA"
                source = coordinates["Object" if signed else "Generated"]
                if socket.type in {"VALUE", "INT"}:
                    axes = self.tree.nodes.new("ShaderNodeSeparateXYZ")
                    self.tree.links.new(source, axes.inputs[0])
                    source = axes.outputs[number % 2]
                self.tree.links.new(source, self.scaled(kind, socket))
            self.settings[node.name] += f" of {', '.join(socket.name for socket in linked)}"
        outputs = list(usable(node.outputs))
        output = outputs[variant % len(outputs)] if kind in kinds.SOURCES else self.rng.choice(outputs)
        self.tree.links.new(output, target)
        self.settings[node.name] += f" -> {output.name}"

    def _linked_node(self, kind: str, depth: int) -> Any:
        """The output to use of a node with subtrees at its inputs."""
        node = self.node(kind)
        inputs = list(usable(node.inputs))
        self.rng.shuffle(inputs)
        for number, socket in enumerate(inputs if depth > 1 else ()):
            if len(self.settings) < MOST_NODES and (number == 0 or self.rng.random() < LINKED):
                self.feed(self.scaled(kind, socket), depth - 1 if number == 0 else self.rng.randint(1, depth - 1))
        if depth > 1 and self.rng.random() < 0.04:
            node.mute = True
            self.kinds.add(kinds.MUTED)
            self.settings[node.name] += f" {kinds.MUTED}"
        output = self.rng.choice(list(usable(node.outputs)))
        self.settings[node.name] += f" -> {output.name}"
        self._outputs.append(output)
        return output

    def _group(self, depth: int) -> Any:
        """A group of one output and two inputs, which a node in it reads."""
        tree: Any = bpy.data.node_groups.new("group", "ShaderNodeTree")
        sockets = [(f"NodeSocket{self.rng.choice(('Float', 'Vector', 'Color'))}", name) for name in ("A", "B")]
        result = f"NodeSocket{self.rng.choice(('Float', 'Vector', 'Color'))}"
        if hasattr(tree, "interface"):
            for kind, name in sockets:
                tree.interface.new_socket(name, in_out="INPUT", socket_type=kind)
            tree.interface.new_socket("Result", in_out="OUTPUT", socket_type=result)
        else:
            for kind, name in sockets:
                tree.inputs.new(kind, name)
            tree.outputs.new(result, "Result")
        inner = Maker(tree, self.rng, self.allowed)
        inner._outputs = list(tree.nodes.new("NodeGroupInput").outputs)[: len(sockets)]
        end = tree.nodes.new("NodeGroupOutput")
        inner.feed(end.inputs[0], depth - 1)
        self.kinds |= inner.kinds | {kinds.GROUP}
        node = self.tree.nodes.new("ShaderNodeGroup")
        self.settings |= {f"{node.name} / {name}": line for name, line in inner.settings.items()}
        node.node_tree = tree
        for socket in usable(node.inputs):
            self._draw_value(kinds.GROUP, socket)
            self.feed(socket, self.rng.randint(1, depth - 1))
        return node.outputs[0]

    def _draw_settings(self, node: Any, variant: int | None) -> Iterator[str]:
        """Set every enum, switch and number of the node's own; yields what it was set to."""
        common = bpy.types.ShaderNode.bl_rna.properties.keys()
        own = [p for p in node.bl_rna.properties if p.identifier not in common and not p.is_readonly]
        enums = [p for p in own if p.type == "ENUM"]
        longest = max(enums, key=lambda p: len(p.enum_items), default=None)
        for p in sorted(own, key=lambda p: p.type != "ENUM"):
            name = p.identifier
            if p.type == "ENUM":
                values = _enum_values(node, p)
                if not values:
                    continue
                counted = variant is not None and p == longest
                value = values[variant % len(values)] if counted else self.rng.choice(values)
            elif p.type == "BOOLEAN" and not p.is_array:
                value = self.rng.random() < 0.5
            elif p.type in {"INT", "FLOAT"} and not p.is_array:
                value = self._number(p)
            elif p.type == "STRING" and name in {"attribute_name", "layer_name", "uv_map"}:
                value = self.rng.choice({"layer_name": COLOR_LAYERS, "uv_map": ("", *UV_MAPS)}.get(name, ATTRIBUTES))
            else:
                continue
            try:
                setattr(node, name, kinds.FIXED.get(name, value))
            except TypeError:  # an enum's item that this node does not take
                continue
            found = getattr(node, name)
            yield f"{name}={f'{found:.3g}' if isinstance(found, float) else found}"

    def _number(self, p: Any) -> float:
        low, high = p.soft_min, min(p.soft_max, p.soft_min + 4)
        return self.rng.randint(int(low), int(high)) if p.type == "INT" else self.rng.uniform(low, high)

    def _draw_value(self, kind: str, socket: Any) -> None:
        low, high = kinds.value_range(kind, socket.name, is_factor(socket))
        if socket.type == "VALUE":
            socket.default_value = self.rng.uniform(low, high)
        elif socket.type == "INT":
            socket.default_value = round(self.rng.uniform(low, high))
        elif socket.type == "RGBA":
            socket.default_value = [*(self.rng.random() for _ in range(3)), 1]
        elif not socket.hide_value:
            socket.default_value = [self.rng.uniform(low, high) for _ in range(len(socket.default_value))]

    def _draw_data(self, kind: str, node: Any) -> None:
        """What a node holds that is neither a setting nor an input."""
        rng = self.rng
        if hasattr(node, "image"):
            node.image = rng.choice(list(bpy.data.images))
        if kind in {"Value", "RGB", "Normal"}:
            size = {"Value": 0, "RGB": 4, "Normal": 3}[kind]
            drawn = [rng.uniform(-1 if kind == "Normal" else 0, 1) for _ in range(size)]
            node.outputs[0].default_value = drawn or rng.uniform(-2, 2)
        if kind == "TexCoord":
            node.object = rng.choice((None, bpy.data.objects["camera"]))
        if kind == "ValToRGB":
            ramp = node.color_ramp
            ramp.color_mode = rng.choice(("RGB", "HSV", "HSL"))
            ramp.interpolation = rng.choice(("EASE", "CARDINAL", "LINEAR", "B_SPLINE", "CONSTANT"))
            ramp.hue_interpolation = rng.choice(("NEAR", "FAR", "CW", "CCW"))
            for _ in range(rng.randrange(4)):
                ramp.elements.new(rng.random())
            for element in ramp.elements:
                element.color = [rng.random() for _ in range(4)]
        if kind in {"RGBCurve", "VectorCurve", "FloatCurve"}:
            low, high = (-1, 1) if kind == "VectorCurve" else (0, 1)
            node.mapping.extend = rng.choice(("HORIZONTAL", "EXTRAPOLATED"))
            for curve in node.mapping.curves:
                for _ in range(rng.randrange(3)):
                    curve.points.new(rng.uniform(low, high), rng.uniform(low, high))
                for point in curve.points:
                    point.location.y = rng.uniform(low, high)
                    point.handle_type = rng.choice(("AUTO", "AUTO_CLAMPED", "VECTOR"))
            node.mapping.update()


def is_factor(socket: Any) -> bool:
    return "Factor" in socket.bl_idname or socket.name in {"Fac", "Factor"}


def usable(sockets: Any) -> Iterator[Any]:
    """Those that the node's settings leave, of values a graph computes."""
    return (s for s in sockets if s.enabled and s.type in TYPES and not getattr(s, "is_unavailable", False))


def _enum_values(node: Any, p: Any) -> list[str]:
    values = [item for item in list(p.enum_items.keys()) if item]
    if p.identifier == "data_type" and node.bl_idname == "ShaderNodeMix":
        values = ["FLOAT", "VECTOR", "RGBA"]  # rotations are for geometry nodes
    return values
