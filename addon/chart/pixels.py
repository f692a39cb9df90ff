"""Pictures as a screen shows them, and PNG files."""

from __future__ import annotations

import struct
import zlib
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from ..srgb import Floats, srgb_from_linear


def to_bytes(linear_rgb: Floats) -> NDArray[np.uint8]:
    return np.round(255 * srgb_from_linear(linear_rgb)).astype(np.uint8)


def write_png(path: Path, image: NDArray[np.uint8]) -> None:
    """image: (height, width, 3), bottom row first."""
    height, width, _ = image.shape
    rows = b"".join(b"\0" + row.tobytes() for row in image[::-1])

    def chunk(kind: bytes, data: bytes) -> bytes:
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    header = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    data = chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(rows, 9)) + chunk(b"IEND", b"")
    path.write_bytes(b"\x89PNG\r\n\x1a\n" + data)
