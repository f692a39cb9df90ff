"""Colours of a space that Blender knows by name, made scene linear by Blender itself.

Blender converts what it reads from a file that is not of bytes: it is given one, an OpenEXR file in memory.
"""

from __future__ import annotations

import struct

import bpy
import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float32]


def scene_linear(colours: Floats, space: str) -> Floats:
    """colours (H, W, 3), as they are encoded."""
    data = _open_exr(colours)
    with bpy.data.temp_data() as aside:
        image = aside.images.new("colours", 1, 1, float_buffer=True)
        image.pack(data=data, data_len=len(data))
        image.source = "FILE"
        image.colorspace_settings.name = space
        height, width = colours.shape[:2]
        values = np.empty((height, width, image.channels), np.float32)
        image.pixels.foreach_get(values.ravel())
    return values[..., :3]


def _open_exr(colours: Floats) -> bytes:
    """A file of 32-bit floats, not compressed. [OpenEXR, Technical Introduction and File Layout]"""
    height, width = colours.shape[:2]
    window = struct.pack("<4i", 0, 0, width - 1, height - 1)
    channels = b"".join(name + b"\0" + struct.pack("<4i", 2, 0, 1, 1) for name in (b"B", b"G", b"R")) + b"\0"
    header = struct.pack("<2i", 20000630, 2)
    for name, kind, value in (
        (b"channels", b"chlist", channels),
        (b"compression", b"compression", b"\0"),
        (b"dataWindow", b"box2i", window),
        (b"displayWindow", b"box2i", window),
        (b"lineOrder", b"lineOrder", b"\0"),
        (b"pixelAspectRatio", b"float", struct.pack("<f", 1)),
        (b"screenWindowCenter", b"v2f", struct.pack("<2f", 0, 0)),
        (b"screenWindowWidth", b"float", struct.pack("<f", 1)),
    ):
        header += name + b"\0" + kind + b"\0" + struct.pack("<i", len(value)) + value
    header += b"\0"
    row_bytes = 12 * width
    first = len(header) + 8 * height
    offsets = (first + np.arange(height, dtype="<u8") * (8 + row_bytes)).astype("<u8").tobytes()
    rows = np.empty(height, [("y", "<i4"), ("bytes", "<i4"), ("bgr", "<f4", (3, width))])
    rows["y"], rows["bytes"] = np.arange(height), row_bytes
    rows["bgr"] = colours[::-1, :, ::-1].transpose(0, 2, 1)  # the file's first row is the top one
    return header + offsets + rows.tobytes()
