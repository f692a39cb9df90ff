"""Pictures of microfacets: the buttons that make them, what is saved, what is read, and the panel."""

from __future__ import annotations

import sys
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import bpy
import numpy as np
import parts


def main(folder: Path) -> Any:
    return {
        "made": _made(),
        "saved": _saved(folder),
        "map": _from_map(),
        "errors": _errors(folder),
        "read": _read(folder),
        "drawn": _panel(),
        "evaluated": _evaluated(),
    }


def _start() -> Any:
    """A material on the active object."""
    parts.clear()
    bpy.context.scene.render.engine = "PIVOT"
    made = parts.quad("quad", material=parts.shaded("cloth", "ShaderNodeBsdfGlossy")[0])
    bpy.context.view_layer.objects.active = made
    return made.active_material


def _pixels(image: Any) -> Any:
    return sys.modules["pivot.ndf.image"].ndf_pixels(image)


def _is_as(image: Any, picture: Any) -> bool:
    return bool(np.array_equal(_pixels(image), picture / picture.max()))


def _made() -> Any:
    draw = sys.modules["pivot.ndf.draw"]
    pivot = _start().pivot
    result = {"before": [pivot.use_ndf_image, pivot.ndf_image is None]}
    result["draw"] = list(
        bpy.ops.pivot.ndf_draw(distribution="BECKMANN", roughness_x=0.5, roughness_y=0.25, rotation=0.5, size=64)
    )
    result["use"], result["name"] = pivot.use_ndf_image, pivot.ndf_image.name
    result["color space"] = pivot.ndf_image.colorspace_settings.is_data
    lobe = draw.Lobe((0.25, 0.0625), 0.5, is_beckmann=True)
    result["is as drawn"] = _is_as(pivot.ndf_image, draw.drawn(64, [lobe]))
    result["weave"] = list(bpy.ops.pivot.ndf_weave())
    picture = _pixels(pivot.ndf_image)
    middle, twin = picture[256, 256], np.abs(picture - picture[::-1, ::-1]).max()
    result["peaks"], result["twin"] = float(middle / picture.max()), float(twin)
    return result


def _saved(folder: Path) -> Any:
    material = _start()
    bpy.ops.pivot.ndf_draw(size=64)
    before = _pixels(material.pivot.ndf_image)
    path = str(folder / "saved.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path)
    bpy.ops.wm.open_mainfile(filepath=path)
    pivot = bpy.data.materials["cloth"].pivot
    return [pivot.use_ndf_image, bool(np.array_equal(_pixels(pivot.ndf_image), before))]


def _image(name: str, pixels: Any, is_float: bool = True, is_data: bool = True) -> Any:
    """pixels: (height, width, 3)."""
    image = bpy.data.images.new(name, pixels.shape[1], pixels.shape[0], float_buffer=is_float, is_data=is_data)
    rgba = np.concatenate((pixels, np.ones_like(pixels[..., :1])), axis=2).astype(np.float32)
    image.pixels.foreach_set(rgba.ravel())
    return image


def _from_map() -> Any:
    """Where the brightest pixel is of maps of one normal, and of a ramp of heights."""
    pivot = _start().pivot
    _image("normals", np.full((8, 8, 3), (0.75, 0.65, 0.9)))
    _image("ramp", np.broadcast_to(np.linspace(0, 1, 257)[:256, None, None], (256, 256, 3)))
    settings = {
        "opengl": {"image": "normals", "kind": "OPENGL"},
        "directx": {"image": "normals", "kind": "DIRECTX"},
        "rough": {"image": "normals", "kind": "OPENGL", "roughness": 0.3},
        "height": {"image": "ramp", "kind": "HEIGHT", "height": 0.5},
    }
    peaks = {}
    for name, arguments in settings.items():
        assert bpy.ops.pivot.ndf_from_map(size=128, **arguments) == {"FINISHED"}
        row, column = np.unravel_index(_pixels(pivot.ndf_image).argmax(), (128, 128))
        peaks[name] = [(column + 0.5) / 64 - 1, (row + 0.5) / 64 - 1]
    return peaks


def _errors(folder: Path) -> Any:
    material = _start()
    ones = np.ones((4, 4, 3))
    _image("inward", 0 * ones)
    _image("colors", ones, is_float=False, is_data=False)
    _image("holes", np.nan * ones)
    missing = _image("missing", ones, is_float=False)
    missing.source, missing.filepath = "FILE", str(folder / "nowhere.png")
    said = {}
    for name in ("", "nowhere", "inward", "colors", "holes", "missing"):
        try:
            bpy.ops.pivot.ndf_from_map(image=name)
        except RuntimeError as error:
            said[name] = str(error)
    said["untouched"] = material.pivot.ndf_image is None and not material.pivot.use_ndf_image
    bpy.context.view_layer.objects.active = None
    said["poll"] = bpy.ops.pivot.ndf_draw.poll()
    return said


def _read(folder: Path) -> Any:
    """Images as they are read: numbers of floats and of bytes, colors of bytes, from files."""
    parts.clear()
    pixels = np.zeros((2, 2, 3))
    pixels[..., 0] = [[0, 51 / 255], [102 / 255, 1]]
    read = {"floats": _pixels(_image("floats", pixels * 3)).tolist()}
    for name, is_data in (("numbers", True), ("colors", False)):
        image = _image(name, pixels, is_float=False, is_data=is_data)
        image.filepath_raw, image.file_format = str(folder / f"{name}.png"), "PNG"
        image.save()
        loaded = bpy.data.images.load(image.filepath_raw)
        if is_data:
            loaded.colorspace_settings.name = "Non-Color"
        read[name] = _pixels(loaded).tolist()
        read[f"{name} kept"] = loaded.has_data
    missing = bpy.data.images.new("missing", 4, 4)
    missing.source, missing.filepath = "FILE", str(folder / "nowhere.png")
    tiled = bpy.data.images.new("tiles", 4, 4, tiled=True)
    for image in (missing, tiled):
        try:
            _pixels(image)
        except Exception as error:
            read[image.name] = [type(error).__name__, str(error)]
    return read


class _Layout:
    """Notes what a panel puts into it, and asks Blender for what it shows of it."""

    def __init__(self, shown: list[str]) -> None:
        self.shown = shown

    def column(self, **_: Any) -> _Layout:
        return self

    def prop(self, data: Any, name: str, **_: Any) -> None:
        self.shown.append(data.bl_rna.properties[name].identifier)

    def template_ID(self, data: Any, name: str, new: str, open: str) -> None:
        self.shown.append(data.bl_rna.properties[name].identifier)

    def template_icon(self, icon_value: int, scale: float) -> None:
        self.shown.append(f"icon {icon_value}")

    def icon(self, image: Any) -> int:
        return image.size[0]

    def operator(self, name: str) -> None:
        module, operator = name.split(".")
        getattr(getattr(bpy.ops, module), operator).get_rna_type()
        self.shown.append(name)


def _panel() -> Any:
    panel = sys.modules["pivot.ndf.panel"].PIVOT_MATERIAL_PT_ndf
    material = _start()
    polls = [
        bool(panel.poll(SimpleNamespace(material=each, engine=engine)))
        for each, engine in ((material, "PIVOT"), (material, "CYCLES"), (None, "PIVOT"))
    ]
    drawn = []
    for _ in range(2):
        shown: list[str] = []
        itself = SimpleNamespace(layout=_Layout(shown))
        panel.draw_header(itself, SimpleNamespace(material=material))
        panel.draw(itself, SimpleNamespace(material=material))
        drawn.append(shown)
        bpy.ops.pivot.ndf_draw(size=64)
    return {"polls": polls, "shown": drawn}


def _evaluated() -> Any:
    """Whether a render sees the settings, keyed, and is told when they change."""
    material = _start()
    bpy.ops.pivot.ndf_draw(size=64)
    told = []

    def note(_: Any, depsgraph: Any) -> None:
        told.append([update.id.name for update in depsgraph.updates])

    bpy.context.evaluated_depsgraph_get().update()
    bpy.app.handlers.depsgraph_update_post.append(note)
    material.pivot.use_ndf_image = False
    bpy.context.view_layer.update()
    bpy.app.handlers.depsgraph_update_post.remove(note)
    for frame, value in ((1, True), (2, False)):
        material.pivot.use_ndf_image = value
        material.pivot.keyframe_insert("use_ndf_image", frame=frame)
    seen = []
    for frame in (1, 2):
        bpy.context.scene.frame_set(frame)
        evaluated = material.evaluated_get(bpy.context.evaluated_depsgraph_get()).pivot
        seen.append([evaluated.use_ndf_image, evaluated.ndf_image.name])
    return {"told": any("cloth" in names for names in told), "seen": seen}
