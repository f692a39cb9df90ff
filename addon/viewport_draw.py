"""Pictures on the screen. What draws is not there in a Blender without windows."""

from __future__ import annotations

from typing import Any

import bpy
import numpy as np
from numpy.typing import NDArray

from .viewport_view import Corners, View

_LARGEST_HALF = 65504.0


class Picture:
    """Its texture is made when it is first drawn: elsewhere there may be nothing to make it with."""

    def __init__(self, pixels: NDArray[np.float32], view: View, covers_px: Corners) -> None:
        """pixels: (height, width, 4), the bottom row first. covers_px: where they are in the region of the view."""
        self.view = view
        self.covers_px = covers_px
        self._pixels: NDArray[np.float32] | None = pixels
        self._texture: Any = None

    @property
    def texture(self) -> Any:
        import gpu

        if self._pixels is not None:
            height, width = self._pixels.shape[:2]
            values = np.clip(self._pixels, -_LARGEST_HALF, _LARGEST_HALF).ravel()
            buffer = gpu.types.Buffer("FLOAT", values.size, values)
            self._texture = gpu.types.GPUTexture((width, height), format="RGBA16F", data=buffer)
            self._pixels = None
        return self._texture


def draw_picture(engine: bpy.types.RenderEngine, scene: bpy.types.Scene, shown: Picture, view: View) -> None:
    """Draw a picture where it lies in a view, but no further than it was to be rendered."""
    import gpu
    from gpu_extras.batch import batch_for_shader

    window = tuple(map(float, shown.view.window_px))
    left, bottom, right, top = view.place_of(window, shown.view)
    x0, y0, x1, y1 = shown.covers_px
    u0, u1 = ((side - x0) / (x1 - x0) for side in (window[0], window[2]))
    v0, v1 = ((side - y0) / (y1 - y0) for side in (window[1], window[3]))
    shader = gpu.shader.from_builtin("IMAGE" if bpy.app.version >= (3, 4) else "2D_IMAGE")
    corners = {
        "pos": ((left, bottom), (right, bottom), (right, top), (left, top)),
        "texCoord": ((u0, v0), (u1, v0), (u1, v1), (u0, v1)),
    }
    gpu.state.blend_set("ALPHA_PREMULT")
    engine.bind_display_space_shader(scene)
    shader.uniform_sampler("image", shown.texture)
    batch_for_shader(shader, "TRI_FAN", corners).draw(shader)
    engine.unbind_display_space_shader()
    gpu.state.blend_set("NONE")
