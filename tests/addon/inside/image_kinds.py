"""Materials and worlds that show images, by name, to be rendered by Cycles and by Pivot.

They are functions that are given a node tree and a folder for their files, and return whether they make a world.
"""

from __future__ import annotations

import struct
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import bpy
import numpy as np
import parts

SIZE = 64
CASES: dict[str, Callable[[Any, Path], Any]] = {}


def case(function: Callable[[Any, Path], Any]) -> Callable[[Any, Path], Any]:
    CASES[function.__name__.strip("_")] = function
    return function


def pixels(width: int, height: int, alpha: bool = False, high: float = 1.0) -> Any:
    """(height, width, 4) smooth and random at once, the same each time."""
    values = np.random.default_rng(width).random((height, width, 4)) * high
    if not alpha:
        values[..., 3] = 1
    else:
        values[..., 3] = np.linspace(0.1, 1, width)
    return values.astype(np.float32)


def generated(width: int, height: int, is_float: bool = False, alpha: bool = False, space: str = "") -> Any:
    image = bpy.data.images.new("generated", width, height, alpha=True, float_buffer=is_float)
    if space:
        image.colorspace_settings.name = space
    image.pixels.foreach_set(pixels(width, height, alpha, 3.0 if is_float else 1.0).ravel())
    image.update()
    return image


def saved(folder: Path, image: Any, kind: str, depth: str = "8", mode: str = "RGBA", path: Path | None = None) -> Any:
    """The image as a file, loaded."""
    path = path or folder / f"saved.{kind.lower()}"
    settings = bpy.context.scene.render.image_settings
    if hasattr(settings, "media_type"):
        settings.media_type = "IMAGE"
    settings.file_format, settings.color_mode, settings.color_depth = kind, mode, depth
    bpy.context.scene.view_settings.view_transform = "Standard"
    image.save_render(str(path))
    loaded = bpy.data.images.load(str(path))
    loaded.reload()
    return loaded


def texture(tree: Any, image: Any, kind: str = "ShaderNodeTexImage", **settings: Any) -> Any:
    node = tree.nodes.new(kind)
    node.image = image
    for name, value in settings.items():
        setattr(node, name, value)
    emission = next(n for n in tree.nodes if n.type in {"EMISSION", "BACKGROUND"})
    tree.links.new(node.outputs["Color"], emission.inputs["Color"])
    return node


def _with_alpha(tree: Any, node: Any) -> None:
    """The color times alpha / 2 + 1/2: both outputs are asked for."""
    half = tree.nodes.new("ShaderNodeMath")
    half.operation, half.inputs[1].default_value, half.inputs[2].default_value = "MULTIPLY_ADD", 0.5, 0.5
    tree.links.new(node.outputs["Alpha"], half.inputs[0])
    emission = next(n for n in tree.nodes if n.type == "EMISSION")
    tree.links.new(half.outputs[0], emission.inputs["Strength"])


def _variants() -> Iterator[tuple[str, dict[str, Any]]]:
    for interpolation in ("Closest", "Linear", "Cubic", "Smart"):
        yield f"{interpolation.lower()}", {"interpolation": interpolation}
    for extension in ("EXTEND", "CLIP", *(("MIRROR",) if bpy.app.version >= (3, 5) else ())):
        for interpolation in ("Closest", "Linear", "Cubic"):
            name = f"{extension.lower()}_{interpolation.lower()}"
            yield name, {"interpolation": interpolation, "extension": extension}


for _name, _settings in _variants():
    CASES[_name] = lambda tree, _, s=_settings: _with_alpha(tree, texture(tree, generated(5, 7), **s))


@case
def _float_image(tree: Any, _: Path) -> None:
    texture(tree, generated(6, 4, is_float=True))


@case
def _non_color(tree: Any, _: Path) -> None:
    texture(tree, generated(5, 7, space="Non-Color"))


@case
def _alpha_alone(tree: Any, _: Path) -> None:
    node = texture(tree, generated(5, 7, alpha=True))
    tree.links.new(node.outputs["Alpha"], next(n for n in tree.nodes if n.type == "EMISSION").inputs["Color"])


def _alpha(mode: str, linked: bool) -> Callable[[Any, Path], Any]:
    def make(tree: Any, _: Path) -> None:
        image = generated(5, 7, alpha=True)
        image.alpha_mode = mode
        node = texture(tree, image)
        if linked:
            _with_alpha(tree, node)

    return make


for _mode in ("STRAIGHT", "PREMUL", "CHANNEL_PACKED", "NONE"):
    CASES[f"alpha_{_mode.lower()}"] = _alpha(_mode, True)
    CASES[f"alpha_{_mode.lower()}_unlinked"] = _alpha(_mode, False)


@case
def _float_straight(tree: Any, _: Path) -> None:
    image = generated(5, 7, is_float=True, alpha=True)
    image.alpha_mode = "STRAIGHT"
    _with_alpha(tree, texture(tree, image))


@case
def _float_without_alpha(tree: Any, _: Path) -> None:
    image = generated(5, 7, is_float=True, alpha=True)
    image.alpha_mode = "NONE"
    _with_alpha(tree, texture(tree, image))


def _file(kind: str, depth: str, mode: str, packed: bool, alpha_mode: str = "") -> Callable[[Any, Path], Any]:
    def make(tree: Any, folder: Path) -> None:
        source = generated(9, 5, is_float=kind == "OPEN_EXR", alpha=mode == "RGBA")
        if alpha_mode == "PREMUL":
            texels = pixels(9, 5, alpha=True)
            texels[..., :3] *= texels[..., 3:]
            source.pixels.foreach_set(texels.ravel())
        image = saved(folder, source, kind, depth, mode)
        if alpha_mode:
            image.alpha_mode = alpha_mode
        if packed:
            image.pack()
        _with_alpha(tree, texture(tree, image))

    return make


for _kind, _depth, _mode, _packed in (
    ("PNG", "8", "RGBA", False),
    ("PNG", "8", "RGBA", True),
    ("PNG", "8", "RGB", False),
    ("PNG", "8", "BW", False),
    ("PNG", "16", "RGB", False),
    ("PNG", "16", "RGBA", False),
    ("PNG", "16", "RGBA", True),
    ("OPEN_EXR", "16", "RGBA", False),
    ("OPEN_EXR", "32", "RGB", False),
    ("OPEN_EXR", "32", "RGBA", True),
    # Debian's Cycles reads mantissas half a step lower than Blender does.
    *((("HDR", "32", "RGB", False),) if bpy.app.version >= (4, 0) else ()),
):
    CASES[f"{_kind}_{_depth}_{_mode}{'_packed' if _packed else ''}".lower()] = _file(_kind, _depth, _mode, _packed)

for _kind, _depth, _mode, _packed in (
    ("PNG", "8", "PREMUL", False),
    ("PNG", "16", "PREMUL", False),
    ("OPEN_EXR", "32", "STRAIGHT", False),
    ("OPEN_EXR", "32", "STRAIGHT", True),
):
    _name = f"{_kind}_{_depth}_{_mode}{'_packed' if _packed else ''}".lower()
    CASES[_name] = _file(_kind, _depth, "RGBA", _packed, _mode)


def _projected(projection: str, blend: float = 0.0) -> Callable[[Any, Path], Any]:
    def make(tree: Any, _: Path) -> None:
        node = texture(tree, generated(5, 7), projection=projection, projection_blend=blend)
        geometry = tree.nodes.new("ShaderNodeNewGeometry")
        tree.links.new(geometry.outputs["Position"], node.inputs["Vector"])
        # Seen from inside, where no place is seen at grazing angles: there footprints are wider than a texel.
        bpy.ops.mesh.primitive_uv_sphere_add(segments=24, ring_count=12, radius=1.4, location=(0.1, 0.2, 4.5))
        ball = bpy.context.object
        ball.rotation_euler = (0.4, 0.5, 0.6)
        ball.scale = (1.2, 1.2, 1.2)
        ball.data.materials.append(bpy.data.materials["picture"])
        ball.data.polygons.foreach_set("use_smooth", [True] * len(ball.data.polygons))

    return make


for _projection in ("FLAT", "SPHERE", "TUBE", "BOX"):
    CASES[f"project_{_projection.lower()}"] = _projected(_projection)
CASES["project_box_blended"] = _projected("BOX", 0.4)
CASES["project_box_all_blended"] = _projected("BOX", 1.0)


@case
def _environment_on_a_surface(tree: Any, _: Path) -> None:
    texture(tree, generated(9, 5), "ShaderNodeTexEnvironment")


@case
def _mapped(tree: Any, _: Path) -> None:
    mapping = texture(tree, generated(5, 7)).texture_mapping
    mapping.translation, mapping.rotation, mapping.scale = (0.1, 0.2, 0.3), (0.1, 0.2, 0.5), (1.5, 0.7, 2)
    mapping.vector_type = "TEXTURE"


def _space(name: str, alpha: bool = False) -> Callable[[Any, Path], Any]:
    def make(tree: Any, _: Path) -> None:
        _with_alpha(tree, texture(tree, generated(5, 7, alpha=alpha, space=name)))

    return make


CASES["space_filmic"] = _space("Filmic sRGB")
CASES["space_filmic_alpha"] = _space("Filmic sRGB", alpha=True)
CASES["space_acescg"] = _space("ACEScg" if bpy.app.version >= (4, 0) else "Linear ACEScg")
CASES["space_linear"] = _space("Linear Rec.709" if bpy.app.version >= (4, 0) else "Linear")


def _files(folder: Path, names: tuple[str, ...]) -> Any:
    """The first of several, each of other pixels."""
    for index, name in enumerate(names):
        saved(folder, generated(4 + index, 5), "PNG", path=folder / name)
    return bpy.data.images.load(str(folder / names[0]))


def _sequence(scene_frame: int, **user: Any) -> Callable[[Any, Path], Any]:
    def make(tree: Any, folder: Path) -> None:
        image = _files(folder, ("frame_007.png", "frame_008.png", "frame_009.png"))
        image.source = "SEQUENCE"
        node = texture(tree, image)
        for name, value in ({"frame_duration": 3, "frame_start": 1, "frame_offset": 6} | user).items():
            setattr(node.image_user, name, value)
        bpy.context.scene.frame_set(scene_frame)

    return make


CASES["sequence"] = _sequence(2)
CASES["sequence_held"] = _sequence(9)
CASES["sequence_cyclic"] = _sequence(5, use_cyclic=True)


def _tiled(missing: int) -> Callable[[Any, Path], Any]:
    """Three tiles; where the fourth would be nothing is."""

    def make(tree: Any, folder: Path) -> None:
        image = _files(folder, ("tile.1001.png", "tile.1002.png", "tile.1011.png"))
        image.source = "TILED"
        for number in (1002, 1011):
            image.tiles.new(number)
        image.filepath = str(folder / "tile.<UDIM>.png")
        (folder / f"tile.{missing}.png").unlink(missing_ok=True)
        texture(tree, image)

    return make


CASES["tiles"] = _tiled(0)
CASES["tiles_without_one"] = _tiled(1011)


@case
def _tiles_packed(tree: Any, folder: Path) -> None:
    _tiled(0)(tree, folder)
    node = next(n for n in tree.nodes if n.type == "TEX_IMAGE")
    node.image.pack()
    _files(folder, ("tile.1002.png", "tile.1001.png", "tile.1011.png"))  # which are not to be read


def _written(folder: Path, kind: str, **settings: Any) -> Path:
    """What Cycles renders of a world that is another color in each of four frames, in one file."""
    scene = bpy.context.scene
    keyed = parts.world((0, 0, 0)).node_tree.nodes["Background"].inputs["Color"]
    for frame in range(1, 5):
        keyed.default_value = (frame / 8, 0.3, 1 - frame / 8, 1)
        keyed.keyframe_insert("default_value", frame=frame)
    parts.size(SIZE, SIZE)
    parts.camera()
    scene.render.engine, scene.cycles.samples, scene.cycles.use_denoising = "CYCLES", 1, False
    scene.view_settings.view_transform = "Standard"
    image_settings = scene.render.image_settings
    if hasattr(image_settings, "media_type"):
        image_settings.media_type = "VIDEO" if kind == "FFMPEG" else "MULTI_LAYER_IMAGE"
    image_settings.file_format = kind
    for name, value in settings.items():
        setattr(scene.render.ffmpeg if kind == "FFMPEG" else image_settings, name, value)
    bpy.context.view_layer.use_pass_z = bpy.context.view_layer.use_pass_normal = True
    scene.frame_start, scene.frame_end = 1, 4
    scene.render.dither_intensity = 0
    scene.render.filepath = str(folder / ("written.avi" if kind == "FFMPEG" else "written.exr"))
    bpy.ops.render.render(animation=kind == "FFMPEG", write_still=True)
    if hasattr(image_settings, "media_type"):
        image_settings.media_type = "IMAGE"
    scene.world = None
    bpy.data.objects.remove(scene.camera)
    return Path(scene.render.filepath)


def _movie(scene_frame: int, **user: Any) -> Callable[[Any, Path], Any]:
    def make(tree: Any, folder: Path) -> None:
        path = _written(folder, "FFMPEG", format="AVI", codec="FFV1")
        image = bpy.data.images.load(str(path))
        assert image.source == "MOVIE"
        node = texture(tree, image)
        _varied(tree, node)
        for name, value in ({"frame_duration": 4, "frame_start": 1} | user).items():
            setattr(node.image_user, name, value)
        bpy.context.scene.frame_set(scene_frame)

    return make


def _varied(tree: Any, node: Any) -> None:
    """What is even over the square gets a gradient."""
    coordinate = tree.nodes.new("ShaderNodeTexCoord")
    emission = next(n for n in tree.nodes if n.type == "EMISSION")
    tree.links.new(coordinate.outputs["Generated"], emission.inputs["Strength"])


CASES["movie"] = _movie(3)
CASES["movie_cyclic"] = _movie(6, use_cyclic=True)


def _layers(packed: bool, **settings: Any) -> Callable[[Any, Path], Any]:
    def make(tree: Any, folder: Path) -> None:
        image = bpy.data.images.load(str(_written(folder, "OPEN_EXR_MULTILAYER", **settings)))
        if packed:
            image.pack()
        _varied(tree, texture(tree, image))

    return make


CASES["layers"] = _layers(False)
if bpy.app.version >= (4, 0):  # Debian's Cycles shows it in pink
    CASES["layers_packed"] = _layers(True)
CASES["layers_piz"] = _layers(False, exr_codec="PIZ")
if "use_exr_interleave" in bpy.types.ImageFormatSettings.bl_rna.properties:
    CASES["layers_interleaved"] = _layers(False, use_exr_interleave=True)


def layers_without_colors(tree: Any, folder: Path) -> None:
    """The file's layer is of B, G, R and U, which no Blender writes."""
    path = _written(folder, "OPEN_EXR_MULTILAYER")
    path.write_bytes(path.read_bytes().replace(b"Combined.A\0", b"Combined.U\0"))
    texture(tree, bpy.data.images.load(str(path)))


@case
def _missing_file(tree: Any, folder: Path) -> None:
    image = saved(folder, generated(4, 4), "PNG")
    image.filepath = str(folder / "nowhere.png")
    texture(tree, image)


def _broken_file(tree: Any, folder: Path) -> None:
    path = folder / "broken.exr"
    path.write_bytes(struct.pack("<2I", 20000630, 2) + b"broken")
    texture(tree, bpy.data.images.load(str(path)))


if bpy.app.version >= (4, 0):  # Debian's Blender itself hangs
    CASES["broken_file"] = _broken_file


@case
def _no_image(tree: Any, _: Path) -> None:
    texture(tree, None)


def world(projection: str, interpolation: str = "Linear", is_float: bool = True) -> Callable[[Any, Path], Any]:
    def make(_tree: Any, _: Path) -> bool:
        tree = parts.world((0, 0, 0)).node_tree
        image = generated(16, 8, is_float=is_float)
        texture(tree, image, "ShaderNodeTexEnvironment", projection=projection, interpolation=interpolation)
        return True

    return make


CASES["world"] = world("EQUIRECTANGULAR")
CASES["world_cubic_bytes"] = world("EQUIRECTANGULAR", "Cubic", False)
CASES["world_mirror_ball"] = world("MIRROR_BALL")
