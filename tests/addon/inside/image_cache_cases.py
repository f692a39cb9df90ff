"""How often images are read: exports of one cache, with an edit before each, and the frames of an animation."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any
from unittest.mock import patch

import bpy
import numpy as np
import parts

LARGE_PX = 4096
Edit = Callable[[Any, Path], Any]
EDITS: dict[str, Edit] = {
    "nothing": lambda image, _: None,
    "pixels": lambda image, _: image.pixels.foreach_set(np.full(image.size[0] * image.size[1] * 4, 0.7, np.float32)),
    "generated color": lambda image, _: setattr(image, "generated_color", (0.7, 0.7, 0.7, 1)),
    "alpha mode": lambda image, _: setattr(image, "alpha_mode", "CHANNEL_PACKED"),
    "color space": lambda image, _: setattr(image.colorspace_settings, "name", "Non-Color"),
    "path": lambda image, folder: setattr(image, "filepath", _saved(folder / "other.png", 0.7)),
    "file": lambda image, folder: _saved(folder / "picture.png", 0.7),
    "loaded, file, reload": lambda image, folder: _reloaded(image, folder),
    "frame": lambda image, _: bpy.context.scene.frame_set(2),
}
OF_A_FILE = {"path", "file", "loaded, file, reload"}


def main(folder: Path) -> Any:
    """By edit, the mean of what was read in each of three exports, the edit before the last; None: nothing was."""
    return {
        "edits": {name: _edited(name, edit, folder) for name, edit in EDITS.items()},
        "animation": _animation(folder),
        "memory": _memory(),
    }


def _saved(path: Path, value: float) -> str:
    image = bpy.data.images.new("saved", 4, 4)
    image.generated_color = (value, value, value, 1)
    image.filepath_raw, image.file_format = str(path), "PNG"
    image.save()
    bpy.data.images.remove(image)
    later_ns = (path.stat().st_mtime_ns if path.exists() else 0) + 10**9
    os.utime(path, ns=(later_ns, later_ns))  # however coarse the file system's clock
    return str(path)


def _reloaded(image: Any, folder: Path) -> None:
    """The file changes, is exported while Blender has what it was, and then reloaded."""
    assert image.size[0] == 4  # Blender reads it
    _saved(folder / "picture.png", 0.7)
    image.reload()


def _sequence(folder: Path) -> Any:
    for frame in (1, 2, 3):
        _saved(folder / f"frame_{frame}.png", frame / 4)
    image = bpy.data.images.load(str(folder / "frame_1.png"))
    image.source = "SEQUENCE"
    return image


def _shown(image: Any) -> Any:
    """A square that shows it and nothing else in the scene; its node."""
    parts.size(4, 4)
    material, _ = parts.shaded("picture", "ShaderNodeEmission")
    tree = material.node_tree
    node = tree.nodes.new("ShaderNodeTexImage")
    node.image = image
    node.image_user.frame_duration = 3
    tree.links.new(node.outputs["Color"], next(n for n in tree.nodes if n.type == "EMISSION").inputs["Color"])
    parts.quad("square", material=material)
    parts.camera()
    bpy.context.scene.frame_set(1)
    return node


@contextmanager
def _reading() -> Iterator[list[float]]:
    """The mean of each picture that is read meanwhile."""
    from pivot.export import images

    read: list[float] = []
    stored_pixels = images.stored_pixels

    def watched(image: Any) -> Any:
        pixels = stored_pixels(image)
        read.append(float(pixels.texels[..., 0].mean()))
        return pixels

    with patch.object(images, "stored_pixels", watched):
        yield read


def _exported(cache: Any) -> float | None:
    from pivot import core
    from pivot.export.scene import export_scene
    from pivot.report import Reporter

    depsgraph = bpy.context.evaluated_depsgraph_get()
    with _reading() as read:
        export_scene(core.load(), depsgraph, Reporter(lambda *_: None, set()), lambda: None, cache)
    cache.sweep()
    assert len(read) < 2
    return read[0] if read else None


def _edited(name: str, edit: Edit, folder: Path) -> Any:
    from pivot.export.images import ImageCache

    parts.clear()
    if name in OF_A_FILE:
        image = bpy.data.images.load(_saved(folder / "picture.png", 0.3))
    elif name == "frame":
        image = _sequence(folder)
    else:
        image = bpy.data.images.new("generated", 4, 4)
        image.generated_color = (0.3, 0.3, 0.3, 1)
    _shown(image)
    cache = ImageCache()
    means = [_exported(cache), _exported(cache)]
    edit(image, folder)
    means.append(_exported(cache))
    return means


def _animation(folder: Path) -> Any:
    """What is read in the three frames of an animation, and after it again."""
    read = {}
    for name, make in {
        "file": lambda: bpy.data.images.load(_saved(folder / "picture.png", 0.3)),
        "sequence": lambda: _sequence(folder),
    }.items():
        parts.clear()
        _shown(make())
        scene = bpy.context.scene
        scene.render.engine, scene.pivot.samples = "PIVOT", 1
        scene.frame_start, scene.frame_end = 1, 3
        scene.render.image_settings.file_format = "PNG"
        scene.render.filepath = str(folder / "animation")
        with _reading() as means:
            bpy.ops.render.render(animation=True)
            read[name] = list(means)
            bpy.ops.render.render()
            read[f"{name} again"] = means[len(read[name]) :]
    return read


def _memory() -> Any:
    """MiB of the process: before a large image is read, with it, and when it is shown no more."""
    from pivot.export.images import ImageCache

    parts.clear()
    node = _shown(bpy.data.images.new("large", LARGE_PX, LARGE_PX))
    assert node.image.channels == 4  # Blender makes it
    cache = ImageCache()
    sizes = [_resident_mib()]
    _exported(cache)
    sizes.append(_resident_mib())
    node.mute = True
    _exported(cache)
    sizes.append(_resident_mib())
    return sizes


def _resident_mib() -> float:
    return int(Path("/proc/self/statm").read_text().split()[1]) * os.sysconf("SC_PAGE_SIZE") / 2**20
