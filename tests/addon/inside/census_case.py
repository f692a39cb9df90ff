"""The census of one Blender: which of its properties the tables name, and what is said of each that is left out."""

from __future__ import annotations

import functools
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import bpy
import parts

KINDS = (
    "Object",
    "PointLight",
    "SpotLight",
    "SunLight",
    "AreaLight",
    "World",
    "Camera",
    "Mesh",
    "Material",
    "MaterialSlot",
    "Volume",
    "Curves",
    "PointCloud",
    "Scene",
    "ViewLayer",
    "LayerCollection",
)
OTHER_NODES = {
    *("OUTPUT_MATERIAL", "OUTPUT_WORLD", "OUTPUT_LIGHT"),
    *("RGB", "VALUE", "TEX_IMAGE", "TEX_ENVIRONMENT"),
}
CANDIDATES = (True, False, 0, 1, 3, 100, 0.5, "BOX", "CUBIC", "TOP")  # of them one at least changes the picture


def main(folder: Path) -> Any:
    census = sys.modules["pivot.export.census"]
    inputs = _inputs()
    return {
        "unnamed": _unnamed(census.TABLES) + _unnamed_inputs(census.INPUTS, inputs),
        "entries": {kind: table.names() for kind, table in census.TABLES.items()}
        | {f"inputs of {kind}": table.names() for kind, table in census.INPUTS.items()},
        "there": {kind: sorted(names) for kind, names in _there(census.TABLES).items()}
        | {f"inputs of {kind}": names for kind, names in inputs.items()},
        "factory": _factory(),
        "silent": _silent(census),
    }


def _structs(tables: Any) -> Iterator[Any]:
    """The RNA of each kind and of its parts."""
    todo = [getattr(bpy.types, kind).bl_rna for kind in (*KINDS, *_inputs())]
    while todo:
        rna = todo.pop()
        yield rna
        for base in _bases(rna):
            for part in tables[base].parts.split() if base in tables else ():
                if part in rna.properties:
                    todo.append(rna.properties[part].fixed_type)


def _bases(rna: Any) -> Iterator[str]:
    while rna is not None:
        yield rna.identifier
        rna = rna.base


def _properties(rna: Any) -> set[str]:
    own = {"pivot"} if rna.identifier in ("Scene", "ViewLayer", "Material") else set()  # the addon's
    return set(rna.properties.keys()) - {"rna_type"} - own


def _there(tables: Any) -> dict[str, set[str]]:
    """The properties that there are of each table's kind, in it or in what derives from it."""
    there: dict[str, set[str]] = {}
    for rna in _structs(tables):
        for base in _bases(rna):
            there.setdefault(base, set()).update(_properties(rna))
    return there


def _unnamed(tables: Any) -> list[str]:
    unnamed = []
    for rna in _structs(tables):
        named = set().union(*(tables[base].names() for base in _bases(rna) if base in tables))
        unnamed += [f"{rna.identifier}.{name}" for name in sorted(_properties(rna) - named)]
    return unnamed


@functools.cache
def _inputs() -> dict[str, list[str]]:
    """The inputs of each kind of node that the exporter knows, by their identifiers."""
    exported = {"pivot.export.shader": "_SHADERS", "pivot.export.volume": "_VOLUMES", "pivot.export.nodes": "ROWS"}
    known = {kind for module, table in exported.items() for kind in getattr(sys.modules[module], table)} | OTHER_NODES
    tree = bpy.data.node_groups.new("census", "ShaderNodeTree")
    inputs = {}
    for kind in (name for name in dir(bpy.types) if name.startswith("ShaderNode")):
        try:
            node = tree.nodes.new(kind)
        except RuntimeError:  # a base of nodes
            continue
        if node.type in known:
            inputs[kind] = [socket.identifier for socket in node.inputs]
    return inputs


def _unnamed_inputs(tables: Any, inputs: dict[str, list[str]]) -> list[str]:
    return [
        f"{kind}, input {name}"
        for kind, names in inputs.items()
        for name in names
        if kind not in tables or name not in tables[kind].names()
    ]


class _Said:
    def __init__(self) -> None:
        self.texts: list[str] = []

    def warn(self, text: str) -> None:
        self.texts.append(text)


def _things() -> dict[str, Any]:
    """One of each kind, as a person would make it."""
    parts.clear()
    scene = bpy.context.scene
    scene.render.engine = "PIVOT"
    # What some properties only then are for.
    scene.render.film_transparent = scene.render.use_simplify = scene.render.use_motion_blur = True
    things = {kind: parts.light(kind, kind).data for kind in ("POINT", "SPOT", "SUN", "AREA")}
    quad = parts.quad("quad", material=parts.shaded("material", "ShaderNodeBsdfDiffuse")[0])
    collection = bpy.data.collections.new("collection")
    scene.collection.children.link(collection)
    layer = bpy.context.view_layer
    return things | {
        "light": bpy.data.objects["POINT"],
        "mesh": quad,
        "camera": parts.camera().data,
        "world": parts.world((1, 1, 1)),
        "material": quad.active_material,
        "volume": bpy.data.volumes.new("volume"),
        "scene": scene,
        "layer": layer,
        "collection": layer.layer_collection.children["collection"],
    }


def _factory() -> list[str]:
    """What is said of things that nobody changed, and of Blender's own startup scene."""
    census = sys.modules["pivot.export.census"]
    said = _Said()
    for name, thing in _things().items():
        census.report_left_out(thing, name, said)
    bpy.ops.wm.read_homefile(use_factory_startup=True)
    scene = bpy.context.scene
    for thing in (scene, bpy.context.view_layer, scene.world, scene.camera.data, *scene.objects):
        census.report_left_out(thing, "startup", said)
    return said.texts


def _silent(census: Any) -> list[str]:
    """Properties that are left out, there, and changed to each candidate without a word."""
    spoken: set[str] = set()
    met: set[str] = set()
    for thing in _things().values():
        for struct in _with_parts(thing, census.TABLES):
            for base in _bases(struct.bl_rna):
                rows = census.TABLES[base].left_out if base in census.TABLES else ()
                for name in {row.name.partition("@")[0] for row in rows} & _properties(struct.bl_rna):
                    met.add(f"{base}.{name}")
                    if _is_said(census, struct, name):
                        spoken.add(f"{base}.{name}")
    return sorted(met - spoken)


def _with_parts(thing: Any, tables: Any) -> Iterator[Any]:
    yield thing
    for base in _bases(thing.bl_rna):
        for part in tables[base].parts.split() if base in tables else ():
            if getattr(thing, part, None) is not None:
                yield from _with_parts(getattr(thing, part), tables)


def _is_said(census: Any, struct: Any, name: str) -> bool:
    """Whether some value of the property is reported with its owner's name."""
    for candidate in (*CANDIDATES, bpy.data.collections["collection"]):
        before = getattr(struct, name)
        said = _Said()
        try:
            setattr(struct, name, candidate)
        except (TypeError, AttributeError):
            said.texts += _of_collection(census, struct, name)
        else:
            census.report_left_out(struct, "owner", said)
            setattr(struct, name, before)
        if any(text.startswith("owner: ") and " not supported, " in text for text in said.texts):
            return True
    return False


def _of_collection(census: Any, struct: Any, name: str) -> list[str]:
    """What is said of a list with one thing in it."""
    said = _Said()
    if name in ("aovs", "lightgroups"):
        made = getattr(struct, name).add()
        census.report_left_out(struct, "owner", said)
        (bpy.ops.scene.view_layer_remove_aov if name == "aovs" else bpy.ops.scene.view_layer_remove_lightgroup)()
        del made
    if name == "modifiers" and struct.type == "MESH":
        modifier = struct.modifiers.new("subdivision", "SUBSURF")
        if hasattr(modifier, "use_adaptive_subdivision"):  # from Blender 5.0
            modifier.use_adaptive_subdivision = True
        census.report_left_out(struct, "owner", said)
        struct.modifiers.remove(modifier)
    return said.texts
