"""Random edits beside a Rendered viewport: viewport_edit_case.py -- FOLDER writes FOLDER/result.json and quits.

After each, the viewport's scene must be the same as one that is exported from nothing: rays in both give the same
pictures, bit by bit.
"""

from __future__ import annotations

import random
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import bpy

# isort: split
import bmesh

sys.path.insert(0, str(Path(__file__).resolve().parent))
import parts
import window
from scene_compared import differing

EDITS, TOGETHER = 500, 5  # of these many are made before the viewport's scene is looked at
SEED = 7
FEW_S = 0.02

dice = random.Random(SEED)


class Watch:
    """What the viewport exports."""

    def __init__(self) -> None:
        self.meshes = self.exports = 0
        module: Any = sys.modules["pivot.viewport"]
        groups: Any = sys.modules["pivot.export.groups"]
        export, arrays = module.Viewport._export, groups.mesh_arrays

        def counted(mesh: Any) -> Any:
            self.meshes += 1
            return arrays(mesh)

        def watched_export(*arguments: Any) -> None:
            self.exports += 1
            groups.mesh_arrays = counted
            export(*arguments)
            groups.mesh_arrays = arrays

        module.Viewport._export = watched_export


def somewhere(reach: float = 4.0) -> tuple[float, float, float]:
    return dice.uniform(-reach, reach), dice.uniform(-reach, reach), dice.uniform(-1, 1)


def shade() -> tuple[float, float, float, float]:
    return (*(dice.random() for _ in range(3)), 1.0)


def ball() -> Any:
    mesh = bpy.data.meshes.new("ball")
    made = bmesh.new()
    bmesh.ops.create_icosphere(made, subdivisions=dice.randint(1, 3), radius=1)
    made.to_mesh(mesh)
    made.free()
    return mesh


def grid(side: int) -> Any:
    mesh = bpy.data.meshes.new("grid")
    made = bmesh.new()
    bmesh.ops.create_grid(made, x_segments=side, y_segments=side, size=3)
    made.to_mesh(mesh)
    made.free()
    return mesh


class Edits:
    """One method for each kind of edit."""

    def __init__(self) -> None:
        self.scene = bpy.context.scene
        self.light = parts.light("light", "POINT", (2, 2, 6), energy=2000.0)
        self.materials = [parts.shaded(f"shade {i}", "ShaderNodeBsdfDiffuse", Color=shade())[0] for i in range(4)]
        glass = parts.shaded("glass", "ShaderNodeBsdfTransparent", Color=shade())[0]
        self.materials.append(glass)
        for _ in range(6):
            self.add()

    def objects(self) -> list[Any]:
        return [made for made in self.scene.objects if made.type == "MESH"]

    def any(self) -> Any:
        return dice.choice(self.objects())

    def move_object(self) -> None:
        self.any().location = somewhere()

    def scale_object(self) -> None:
        self.any().scale = (dice.uniform(0.3, 2), 1, dice.uniform(-1, 1))

    def move_lamp(self) -> None:
        self.light.location = (dice.uniform(-3, 3), 2, 6)

    def power(self) -> None:
        self.light.data.energy = dice.uniform(500, 5000)

    def color(self) -> None:
        tree = dice.choice(self.materials).node_tree
        next(node for node in tree.nodes if "Color" in node.inputs).inputs["Color"].default_value = shade()

    def material(self) -> None:
        made = self.any()
        made.material_slots[0].link = "OBJECT"
        made.material_slots[0].material = dice.choice(self.materials[:4])

    def copy(self) -> None:
        of = self.any()
        made = of.copy()
        made.location = somewhere()
        if len(self.objects()) < 14 and not of.modifiers and of.data.shape_keys is None:
            self.scene.collection.objects.link(made)

    def hide(self) -> None:
        if len(self.objects()) > 4:
            made = self.any()
            made.hide_viewport = not made.hide_viewport

    def remove(self) -> None:
        if len(self.objects()) > 4:
            bpy.data.objects.remove(self.any())

    def make_glass(self) -> None:
        made = self.any()
        made.material_slots[0].link = "OBJECT"
        made.material_slots[0].material = self.materials[4]

    def add(self) -> None:
        mesh = ball()
        mesh.materials.append(dice.choice(self.materials[:4]))
        made = parts.link("ball", mesh, somewhere())
        if len(self.objects()) > 14:
            bpy.data.objects.remove(made)

    def vertices(self) -> None:
        mesh = self.any().data
        for vertex in mesh.vertices:
            vertex.co *= dice.uniform(0.8, 1.2)
        mesh.update()

    def rebuild(self) -> None:
        """As many vertices at other places, by way of a mesh of its own that takes the other's place."""
        self.any().data = self.with_material(ball())

    def with_material(self, mesh: Any) -> Any:
        mesh.materials.append(dice.choice(self.materials[:4]))
        return mesh

    def clear_and_fill(self) -> None:
        mesh = self.any().data
        if mesh.shape_keys is None:
            made = bmesh.new()
            bmesh.ops.create_cube(made, size=dice.uniform(1, 2))
            made.to_mesh(mesh)
            made.free()

    def smooth(self) -> None:
        mesh = self.any().data
        mesh.polygons.foreach_set("use_smooth", [dice.random() < 0.5] * len(mesh.polygons))
        mesh.update()

    def add_modifier(self) -> None:
        made = self.any()
        if len(made.modifiers) < 2:
            made.modifiers.new("any", dice.choice(["SUBSURF", "ARRAY", "SOLIDIFY", "WAVE"]))

    def set_modifier(self) -> None:
        for made in self.objects():
            for modifier in made.modifiers:
                if modifier.type == "SOLIDIFY":
                    modifier.thickness = dice.uniform(0.1, 1)
                if modifier.type == "ARRAY":
                    modifier.count = dice.randint(1, 3)

    def remove_modifier(self) -> None:
        self.any().modifiers.clear()

    def hook(self) -> None:
        """Geometry of one object that depends on where another is."""
        one, other = self.any(), self.any()
        if one != other and len(one.modifiers) < 2 and not other.modifiers:
            one.modifiers.new("cast", "CAST").object = other

    def shape_key(self) -> None:
        made = self.any()
        if made.data.shape_keys is None:
            made.shape_key_add(name="basis", from_mix=False)
            key = made.shape_key_add(name="key", from_mix=False)
            for point in key.data:
                point.co *= 1.5
        made.data.shape_keys.key_blocks["key"].value = dice.random()

    def frame(self) -> None:
        self.scene.frame_set(dice.randint(1, 50))


def steps() -> Iterator[Callable[[], bool]]:
    window.clear()
    yield window.now
    watch, viewports = Watch(), window.Viewports()
    main, area = window.view()
    main.scene.render.engine, main.scene.pivot.samples = "PIVOT", 1
    area.spaces.active.overlay.show_overlays = False
    edits = Edits()
    kinds = [name for name in dir(edits) if not name.startswith("_") and callable(getattr(edits, name))]
    kinds = [name for name in kinds if name not in ("objects", "any", "with_material")]
    area.spaces.active.shading.type = "RENDERED"
    yield viewports.have_pictures
    result: dict[str, Any] = {"wrong": [], "kinds": kinds, "meshes": dict.fromkeys(kinds, 0), "edits": 0}
    for number in range(EDITS):
        kind = kinds[number] if number < len(kinds) else dice.choice(kinds)
        meshes = watch.meshes
        # What Blender says of an edit comes with the next turn of its loop, so what rests now need not yet.
        getattr(edits, kind)()
        result["edits"] += 1
        is_alone = number < len(kinds)
        if not is_alone and number % TOGETHER:
            main.view_layer.update()
            continue
        yield window.after(FEW_S, viewports.have_pictures)
        if is_alone:
            result["meshes"][kind] = watch.meshes - meshes
        wrong = differing(viewports.any)
        if wrong:
            result["wrong"].append([number, kind, wrong])
    result["exports"] = watch.exports

    for made in list(edits.objects()):
        bpy.data.objects.remove(made)
    large = [parts.link("large", grid(500), (0, 0, z)) for z in (0, 1)]
    yield window.after(FEW_S, viewports.have_pictures)
    result["triangles"] = sum(2 * len(made.data.polygons) for made in large)
    for name, moved in (("object", large[0]), ("lamp", edits.light)):
        watch.meshes, exports = 0, watch.exports
        moved.location.x = 1
        yield window.after(FEW_S, viewports.have_pictures)
        result[name] = {"meshes": watch.meshes, "exports": watch.exports - exports, "wrong": differing(viewports.any)}

    for made in large:
        bpy.data.objects.remove(made)
    parts.link("undone", ball(), (0, 0, 0))
    undone = result["undone"] = []
    for number in range(2):
        with window.in_view():
            bpy.ops.ed.undo_push(message="before")
        mesh = bpy.data.objects["undone"].data
        if number % 2 == 0:
            for vertex in mesh.vertices:
                vertex.co *= 1.5
            mesh.update()
        else:  # what was in the mesh's place comes back to it
            bpy.data.objects["undone"].data = ball()
            bpy.data.meshes.remove(mesh)
        for undo in (bpy.ops.ed.undo_push, bpy.ops.ed.undo, bpy.ops.ed.redo, bpy.ops.ed.undo):
            with window.in_view():
                undo()
            yield window.after(5 * FEW_S, viewports.have_pictures)
            extent = max(vertex.co.length for vertex in bpy.data.objects["undone"].data.vertices)
            undone.append([round(extent, 2), differing(viewports.any)])
    window.write(result)


window.follow(steps(), deadline_s=140.0)
