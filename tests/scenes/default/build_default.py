"""Rebuild default.blend from the meshes beside it: ./run blender -b --python tests/scenes/default/build_default.py

An argument after `--` names another file to write.

A kitchen still life of real models on a lacquered table, lit as a product shot by lights of very different sizes.
Lengths are metres, light powers watts. It keeps to what every supported Blender (3.4 .. 5.0) and both engines read
alike: constant inputs or images, creases split in the mesh and no modifiers.
"""

import lzma
import math
import sys
import tempfile
from collections.abc import Iterable
from pathlib import Path

import addon_utils
import bmesh
import bpy
from mathutils import Matrix, Vector

HERE = Path(__file__).resolve().parent
CREASE_ANGLE = math.radians(35)

Colour = tuple[float, float, float]


# -- materials: one shader node, of constant inputs or of an image
def material(name: str, shader: str, **inputs: float | Colour) -> bpy.types.Material:
    """A material of one shader node; inputs by socket name with spaces as underscores."""
    made = bpy.data.materials.new(name)
    made.use_nodes = True
    nodes, links = made.node_tree.nodes, made.node_tree.links
    nodes.clear()
    node, output = nodes.new(shader), nodes.new("ShaderNodeOutputMaterial")
    output.location.x = 300
    links.new(node.outputs["BSDF"], output.inputs["Surface"])
    for key, value in inputs.items():
        node.inputs[key.replace("_", " ")].default_value = (*value, 1.0) if isinstance(value, tuple) else value
    made.diffuse_color = node.inputs[0].default_value  # the colour in Blender's Solid view
    return made


def metal(name: str, colour: Colour, roughness: float) -> bpy.types.Material:
    return material(name, "ShaderNodeBsdfPrincipled", Base_Color=colour, Metallic=1.0, Roughness=roughness)


def plastic(name: str, colour: Colour, roughness: float) -> bpy.types.Material:
    return material(name, "ShaderNodeBsdfPrincipled", Base_Color=colour, Roughness=roughness)


def textured(name: str, image: str, roughness: tuple[float, float], relief_m: float) -> bpy.types.Material:
    """A plastic of the colours of textures/IMAGE.jpg: where these are black it is lower by the relief, and of the
    first roughness."""
    made = plastic(name, (0.5, 0.5, 0.5), 0.5)
    nodes, links = made.node_tree.nodes, made.node_tree.links
    surface = nodes["Principled BSDF"]
    picture, bump, rough = (nodes.new(f"ShaderNode{kind}") for kind in ("TexImage", "Bump", "MapRange"))
    for node, x, y in ((picture, -600, 0), (bump, -250, -300), (rough, -250, 0)):
        node.location = x, y
    picture.image = bpy.data.images.load(str(HERE / "textures" / f"{image}.jpg"))
    picture.image.pack()
    bump.inputs["Distance"].default_value = relief_m
    rough.inputs["To Min"].default_value, rough.inputs["To Max"].default_value = roughness
    links.new(picture.outputs["Color"], surface.inputs["Base Color"])
    links.new(picture.outputs["Color"], bump.inputs["Height"])
    links.new(picture.outputs["Color"], rough.inputs["Value"])
    links.new(bump.outputs["Normal"], surface.inputs["Normal"])
    links.new(rough.outputs["Result"], surface.inputs["Roughness"])
    return made


# -- models
def read_mesh(name: str) -> list[bpy.types.Object]:
    """The objects of meshes/NAME.obj.xz, without its material library and its loose edges."""
    lines = lzma.decompress((HERE / "meshes" / f"{name}.obj.xz").read_bytes()).decode().splitlines()
    kept = [x for x in lines if not x.startswith(("mtllib", "l ")) and not (x.startswith("f ") and len(x.split()) < 4)]
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / f"{name}.obj"
        path.write_text("\n".join(kept))
        bpy.ops.wm.obj_import(filepath=str(path))
    return list(bpy.context.selected_objects)


def shade_smooth(mesh: bpy.types.Mesh) -> None:
    """Smooth faces, split where they meet in a crease, which every Blender version shades alike."""
    edit = bmesh.new()
    edit.from_mesh(mesh)
    bmesh.ops.remove_doubles(edit, verts=edit.verts, dist=1e-5 * max(mesh_size(mesh)))
    for face in edit.faces:
        face.smooth = True
    creases = [edge for edge in edit.edges if edge.is_manifold and edge.calc_face_angle() > CREASE_ANGLE]
    bmesh.ops.split_edges(edit, edges=creases)
    edit.to_mesh(mesh)
    edit.free()


def mesh_size(mesh: bpy.types.Mesh) -> Vector:
    corners = [vertex.co for vertex in mesh.vertices]
    return Vector([max(axis) - min(axis) for axis in zip(*corners, strict=True)])


def model(
    name: str,
    height_m: float,
    at: tuple[float, float],
    turn_deg: float,
    materials: dict[str, bpy.types.Material],
    foot_m: float = 0,
) -> bpy.types.Object:
    """One object of a mesh file, upright with its foot so high above the table; materials by the file's own names
    ('' if it has none)."""
    parts = read_mesh(name)
    with bpy.context.temp_override(active_object=parts[0], selected_editable_objects=parts, selected_objects=parts):
        bpy.ops.object.transform_apply()
        bpy.ops.object.join()
    joined = parts[0]
    joined.name = joined.data.name = name
    mesh = joined.data
    for slot, old in enumerate(mesh.materials):
        mesh.materials[slot] = materials[old.name]
    if not mesh.materials:
        mesh.materials.append(materials[""])
    low = Vector([min(axis) for axis in zip(*(v.co for v in mesh.vertices), strict=True)])
    size = mesh_size(mesh)
    foot = low + Vector((size.x / 2, size.y / 2, 0))
    mesh.transform(Matrix.Scale(height_m / size.z, 4) @ Matrix.Translation(-foot))
    shade_smooth(mesh)
    joined.location = (*at, foot_m)
    joined.rotation_euler.z = math.radians(turn_deg)
    return joined


def studio_floor(half_width_m: float, depth_m: float, height_m: float, made_of: bpy.types.Material) -> None:
    """A table top that sweeps up into a backdrop behind the models."""
    bend_m, steps = 0.6, 24
    arc = [math.pi / 2 * step / steps for step in range(steps + 1)]
    profile = [(-2.0, 0.0), *((depth_m + bend_m * math.sin(a), bend_m * (1 - math.cos(a))) for a in arc)]
    profile.append((depth_m + bend_m, height_m))
    vertices = [(x, y, z) for y, z in profile for x in (-half_width_m, half_width_m)]
    faces = [(2 * i, 2 * i + 1, 2 * i + 3, 2 * i + 2) for i in range(len(profile) - 1)]
    mesh = bpy.data.meshes.new("floor")
    mesh.from_pydata(vertices, [], faces)
    mesh.polygons.foreach_set("use_smooth", [True] * len(faces))
    mesh.materials.append(made_of)
    link(bpy.data.objects.new("floor", mesh))


# -- lights and camera
def link(thing: bpy.types.Object) -> bpy.types.Object:
    bpy.context.scene.collection.objects.link(thing)
    return thing


def aim(thing: bpy.types.Object, position: Iterable[float], target: Iterable[float]) -> None:
    thing.location = position
    thing.rotation_euler = (Vector(target) - Vector(position)).to_track_quat("-Z", "Y").to_euler()


def light(name: str, kind: str, colour: Colour, **settings: float | str) -> bpy.types.Object:
    data = bpy.data.lights.new(name, kind)
    data.color = colour
    for key, value in settings.items():
        setattr(data, key, value)
    return link(bpy.data.objects.new(name, data))


def place_models() -> None:
    chrome = metal("chrome", (0.82, 0.82, 0.84), 0.12)
    steel = metal("brushed steel", (0.62, 0.61, 0.6), 0.28)
    aluminium = metal("aluminium", (0.8, 0.8, 0.79), 0.22)
    gold = metal("gold", (1.0, 0.71, 0.29), 0.25)
    enamel = plastic("red enamel", (0.36, 0.016, 0.012), 0.16)
    porcelain = plastic("porcelain", (0.8, 0.79, 0.76), 0.1)
    coffee = plastic("coffee", (0.02, 0.008, 0.003), 0.08)
    black = plastic("black plastic", (0.012, 0.012, 0.013), 0.35)
    white = plastic("white plastic", (0.75, 0.73, 0.7), 0.3)
    burlap = textured("burlap", "teddy_bear", (0.9, 0.7), 0.002)
    crust = textured("bread", "bread", (0.35, 0.8), 0.002)
    wood = textured("wood", "chopping_board", (0.3, 0.5), 0.0005)
    mixer_materials = {
        "Kitchenaid_Yellow": enamel,
        "Kitchenaid_Chrome": chrome,
        "Kitchenaid_Chrome_Writing": chrome,
        "Kitchenaid_BrushedChrome": steel,
        "Kitchenaid_BrushedChrome_Writing": steel,
        "Kitchenaid_BlackPlastic": black,
        "Kitchenaid_White": white,
        "Kitchenaid_Glass": steel,
    }
    model("mixer", 0.36, (-0.28, 0.14), 112, mixer_materials)
    model("moka_pot", 0.2, (0.11, 0.06), -40, {"Metal": aluminium, "Handle": black, "Screw": chrome})
    model("coffee_cup", 0.064, (0.13, -0.2), -30, {"Ceramique": porcelain, "Coffee": coffee})
    model("bunny", 0.15, (-0.09, -0.13), 10, {"": gold})
    model("teddy_bear", 0.2, (0.36, 0.02), -25, {"teddy": burlap, "eyes": black})
    model("chopping_board", 0.021, (0.345, -0.255), 22, {"Chopping-board": wood})
    model("bread", 0.066, (0.345, -0.255), 32, {"bread01": crust}, foot_m=0.021)
    studio_floor(3, 0.9, 3, plastic("lacquer", (0.035, 0.045, 0.06), 0.2))


def place_lights() -> None:
    key = light("key", "AREA", (1, 0.94, 0.86), shape="RECTANGLE", size=0.6, size_y=0.35, energy=21)
    aim(key, (-0.8, -0.6, 0.95), (0, 0, 0.1))
    for name, colour, energy, radius, position in (
        ("warm globe", (1, 0.6, 0.28), 6, 0.08, (0.56, 0.6, 0.26)),
        ("cool globe", (0.3, 0.55, 1), 4.5, 0.045, (-0.62, 0.6, 0.24)),
        ("white bead", (1, 1, 1), 2, 0.012, (-0.03, 0.55, 0.22)),
        ("red bead", (1, 0.2, 0.1), 3, 0.025, (0.26, 0.6, 0.2)),
    ):
        light(name, "POINT", colour, energy=energy, shadow_soft_size=radius).location = position
    sun = light("sun", "SUN", (1, 0.97, 0.92), energy=0.7, angle=math.radians(8))
    aim(sun, (1, -0.6, 1.2), (0, 0, 0))
    world = bpy.data.worlds.new("dim")
    world.use_nodes = True
    world.node_tree.nodes["Background"].inputs["Color"].default_value = (0.010, 0.012, 0.016, 1)
    bpy.context.scene.world = world


def place_camera() -> None:
    camera = bpy.data.cameras.new("camera")
    camera.lens, camera.clip_start = 60, 0.01
    bpy.context.scene.camera = link(bpy.data.objects.new("camera", camera))
    aim(bpy.context.scene.camera, (0.1, -1.65, 0.56), (0.025, 0, 0.125))


def set_render(scene: bpy.types.Scene) -> None:
    """A picture of 960 x 540 by Pivot, and settings under which Cycles computes what Pivot does."""
    layer = scene.view_layers[0]
    layer.use_pass_z = layer.use_pass_normal = layer.use_pass_position = True
    layer.use_pass_diffuse_color = layer.use_pass_emit = True
    scene.render.engine = "CYCLES"
    scene.render.resolution_x, scene.render.resolution_y = 960, 540
    scene.view_settings.view_transform = "Standard"
    cycles = scene.cycles
    cycles.samples, cycles.use_adaptive_sampling, cycles.use_denoising = 128, False, False
    cycles.max_bounces = cycles.diffuse_bounces = cycles.glossy_bounces = 4
    cycles.sample_clamp_indirect, cycles.blur_glossy = 0, 1
    addon_utils.enable("pivot")
    scene.pivot.filter_glossy = 1  # without it the metals' caustics are specks
    scene.pivot.samples, scene.pivot.denoise = 32, "INDIRECT"
    scene.render.engine = "PIVOT"


def build(path: Path) -> None:
    bpy.ops.wm.read_factory_settings(use_empty=True)
    place_models()
    place_lights()
    place_camera()
    set_render(bpy.context.scene)
    bpy.ops.wm.save_as_mainfile(filepath=str(path), compress=True)


if __name__ == "__main__":
    build(Path(sys.argv[-1]) if "--" in sys.argv else HERE / "default.blend")
