"""Inside Blender: the picture that a render makes."""

from __future__ import annotations

from pathlib import Path

import bpy

# isort: split
import numpy as np
from numpy.typing import NDArray


def render_picture() -> NDArray[np.float32]:
    """(height, width, 3) radiance of the scene by its engine, bottom row first. Raises RuntimeError if it fails."""
    render = bpy.context.scene.render
    image = render.image_settings
    if bpy.app.version >= (5, 0):
        image.media_type = "IMAGE"
    image.file_format, image.color_mode, image.color_depth = "OPEN_EXR", "RGB", "32"
    path = Path(bpy.app.tempdir) / "picture.exr"
    path.unlink(missing_ok=True)
    render.filepath = str(path)
    bpy.ops.render.render(write_still=True)
    picture = bpy.data.images.load(str(path))
    width, height = picture.size
    pixels = np.empty(height * width * 4, np.float32)
    picture.pixels.foreach_get(pixels)
    bpy.data.images.remove(picture)
    return pixels.reshape(height, width, 4)[..., :3]
