"""Images in the Rendered viewport: viewport_image_case.py -- FOLDER writes FOLDER/result.json and quits."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import bpy

# isort: split
import addon_utils
import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parent))
import parts
import window
from window import FOLDER

SPACE = "Filmic sRGB"


class Watch:
    """What was exported, and of images what was read."""

    def __init__(self) -> None:
        self.exports = 0
        self.read: list[list[float]] = []  # the first texel of each
        viewport: Any = sys.modules["pivot.viewport"]
        images: Any = sys.modules["pivot.export.images"]
        export, stored_pixels = viewport.export_scene, images.stored_pixels

        def watched_export(*arguments: Any) -> Any:
            context = export(*arguments)
            self.exports += 1
            return context

        def watched_pixels(image: Any) -> Any:
            pixels = stored_pixels(image)
            self.read.append(pixels.texels[0, 0].astype(float).tolist())
            return pixels

        viewport.export_scene, images.stored_pixels = watched_export, watched_pixels


def image(name: str, value: float, path: Path | None = None) -> Any:
    made = bpy.data.images.new(name, 4, 4)
    made.generated_color = (value, value, value, 1)
    if path is not None:
        made.filepath_raw, made.file_format = str(path), "PNG"
        made.save()
        made = bpy.data.images.load(str(path))
    made.colorspace_settings.name = SPACE
    return made


def steps() -> Iterator[Callable[[], bool]]:
    addon_utils.enable("pivot")
    parts.clear()
    watch, result = Watch(), {}

    def exported(name: str, edit: Callable[[], Any]) -> Callable[[], bool]:
        """Of an edit: what it makes read."""
        before, read = watch.exports, len(watch.read)
        edit()

        def done() -> bool:
            result[name] = watch.read[read:]
            return watch.exports > before

        return done

    import pivot.export.image_pixels as pixels

    for frame in (1, 2):
        image("frame", frame / 4, FOLDER / f"frame_{frame}.png")
    sequence = bpy.data.images.load(str(FOLDER / "frame_1.png"))
    sequence.source, sequence.colorspace_settings.name = "SEQUENCE", SPACE
    still = image("still", 0.75, FOLDER / "still.png")
    expected = [
        pixels.stored_pixels(image("expected", value, FOLDER / "expected.png")).texels[0, 0]
        for value in (0.75, 0.25, 0.5)
    ]
    result["expected"] = np.array(expected, float).tolist()

    material, _ = parts.shaded("picture", "ShaderNodeEmission")
    tree = material.node_tree
    emission = next(node for node in tree.nodes if node.type == "EMISSION")
    for name, shown in (("Color", still), ("Strength", sequence)):
        node = tree.nodes.new("ShaderNodeTexImage")
        node.image = shown
        node.image_user.frame_duration = 2
        node.image_user.use_auto_refresh = True
        tree.links.new(node.outputs["Color"], emission.inputs[name])
    square = parts.quad("square", material=material)
    scene = bpy.context.scene
    area = window.view()[1]

    def open_view() -> None:
        scene.render.engine = "PIVOT"
        area.spaces.active.shading.type = "RENDERED"

    yield exported("opened", open_view)
    yield exported("moved", lambda: setattr(square, "location", (0, 0, 0.5)))
    yield exported("alpha mode", lambda: setattr(still, "alpha_mode", "CHANNEL_PACKED"))
    yield exported("frame", lambda: scene.frame_set(2))
    window.write(result)


window.follow(steps(), deadline_s=60.0)
