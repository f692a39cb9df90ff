"""Each kind of shader node that this Blender has, each of its outputs and each choice of its menus, as a material."""

from __future__ import annotations

import importlib
import math
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import bpy
import parts

SIZE = 8
NODE = "asked"  # its name in its tree
# Those that stand for others, or that a tree is made of.
NO_NODES = {"GROUP", "GROUP_INPUT", "GROUP_OUTPUT", "REROUTE", "FRAME"}
# What shader trees have beside ShaderNode* from Blender 5.0 on.
MORE_KINDS = (
    *(f"FunctionNodeInput{kind}" for kind in ("Bool", "Int", "Menu", "Vector")),
    *(f"GeometryNode{kind}" for kind in ("InputSceneTime", "MenuSwitch", "RepeatInput", "RepeatOutput")),
    *("NodeClosureInput", "NodeClosureOutput", "NodeCombineBundle", "NodeEvaluateClosure", "NodeImplicitConversion"),
    *("NodeJoinBundle", "NodeSeparateBundle"),
)
SOCKETS = {"VALUE", "INT", "BOOLEAN", "VECTOR", "RGBA", "SHADER"}  # that a material can be made of
Make = Callable[[Any], None]  # makes the node in a tree, and links it


def main(folder: Path) -> Any:
    """All in one picture: of each case the kind of its node, and what is said of its material."""
    parts.clear()
    parts.size(SIZE, SIZE)
    parts.camera()
    kinds = {}
    for name, kind, make in cases():
        material, tree = parts.material(f"case {len(kinds)}")
        make(tree)
        parts.quad(name, material=material)
        kinds[name] = (kind, material.name)
    bpy.context.scene.render.engine, bpy.context.scene.pivot.samples = "PIVOT", 1
    bpy.ops.render.render()
    said = warnings()
    return {
        "cases": {
            name: {"kind": kind, "said": [text for text in said if f"material '{material}'," in text]}
            for name, (kind, material) in kinds.items()
        },
        "known": sorted(known()),
    }


def warnings() -> list[str]:
    return sorted(importlib.import_module("pivot.engine").PivotRenderEngine.frame_count.warnings)


def known() -> set[str]:
    """Kinds of nodes that the exporter has a row for, or that stand for their own or another's value."""
    tables = {"pivot.export.shader": "_SHADERS", "pivot.export.volume": "_VOLUMES", "pivot.export.nodes": "ROWS"}
    rows = {kind for module, table in tables.items() for kind in getattr(importlib.import_module(module), table)}
    return rows | {"RGB", "VALUE", "MENU_SWITCH"}


def cases() -> Iterator[tuple[str, str, Make]]:
    """A name, the node's type and what makes it: "kind, output", and "kind, menu = choice" of its first output."""
    tree = bpy.data.node_groups.new("asked", "ShaderNodeTree")
    for kind in (*sorted(name for name in dir(bpy.types) if name.startswith("ShaderNode")), *MORE_KINDS):
        try:
            node = tree.nodes.new(kind)
        except RuntimeError:  # a base of nodes, or of other Blenders
            continue
        if node.type in NO_NODES:
            continue
        for output in filter(_is_there, node.outputs):
            yield f"{kind}, {output.identifier}", node.type, _maker(kind, output.identifier)
        for menu, choice in _choices(node) if any(map(_is_there, node.outputs)) else ():
            try:
                setattr(node, menu, choice)
            except TypeError:  # of other editors' nodes
                continue
            if any(map(_is_there, node.outputs)):
                yield f"{kind}, {menu} = {choice}", node.type, _maker(kind, None, menu, choice)


def _is_there(socket: Any) -> bool:
    return socket.enabled and not socket.is_unavailable and socket.type in SOCKETS


def _choices(node: Any) -> Iterator[tuple[str, Any]]:
    """What differs from how it is added."""
    common = bpy.types.ShaderNode.bl_rna.properties
    for rna in node.bl_rna.properties:
        if rna.identifier in common or rna.is_readonly:
            continue
        if rna.type == "ENUM" and not rna.is_enum_flag:
            yield from ((rna.identifier, item.identifier) for item in rna.enum_items if item.identifier != rna.default)
        if rna.type == "BOOLEAN" and not rna.is_array:
            yield rna.identifier, not rna.default


def _maker(kind: str, output: str | None, menu: str = "", choice: Any = None) -> Make:
    def make(tree: Any) -> None:
        node = tree.nodes.new(kind)
        node.name = NODE
        if menu:
            setattr(node, menu, choice)
        socket = next((s for s in node.outputs if _is_there(s) and output in (None, s.identifier)), None)
        if socket is not None:
            _link(tree, socket, tree.nodes["Material Output"])

    return make


def _link(tree: Any, socket: Any, end: Any) -> None:
    """To what its type fits: a shader to the surface or the volume, all else to light that shines, or displacement."""
    kind = socket.node.bl_idname
    if socket.type == "SHADER":
        tree.links.new(socket, end.inputs["Volume" if "Volume" in kind else "Surface"])
        return
    is_displacement = kind.endswith("Displacement")
    shader = tree.nodes.new("ShaderNodeBsdfDiffuse" if is_displacement else "ShaderNodeEmission")
    tree.links.new(socket, end.inputs["Displacement"] if is_displacement else shader.inputs["Color"])
    tree.links.new(shader.outputs[0], end.inputs["Surface"])


def sheet() -> Any:
    """A bent sheet that fills the picture, with a UV map and colours, under a sun and a grey sky; a ball over it."""
    parts.clear()
    parts.size(SIZE, SIZE)
    camera = parts.camera((0, 0, 4), (0.2, 0.1, 0.3))
    camera.data.type, camera.data.ortho_scale = "ORTHO", 1.0
    bpy.ops.mesh.primitive_uv_sphere_add(radius=0.3, location=(-0.9, -1.1, 0.5))
    bpy.ops.mesh.primitive_grid_add(x_subdivisions=6, y_subdivisions=6, size=6)
    sheet = bpy.context.object
    for vertex in sheet.data.vertices:
        vertex.co.z = 0.15 * math.sin(2 * vertex.co.x) + 0.1 * math.cos(3 * vertex.co.y)
    colors = sheet.data.color_attributes.new("colors", "FLOAT_COLOR", "POINT")
    for index, item in enumerate(colors.data):
        item.color = (0.2 + 0.02 * index, 0.5, 0.9 - 0.02 * index, 0.5)
    sheet.data.materials.append(None)
    parts.light("sun", "SUN", energy=2).rotation_euler = (0.4, 0.5, 0)
    parts.world((0.3, 0.4, 0.5))
    return sheet
