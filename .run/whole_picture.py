"""Whether a picture that Blender wrote is whole: on a full disk it leaves a part of one and says nothing."""

import math
import struct
from pathlib import Path
from typing import Any

PNG_END = b"\0\0\0\0IEND\xaeB`\x82"
EXR_MAGIC = b"\x76\x2f\x31\x01"
MULTIPART = 0x1000
CHUNK_LINES = (
    1,
    1,
    1,
    16,
    32,
    16,
    32,
    32,
    32,
    256,
)  # by compression: none, RLE, ZIPS, ZIP, PIZ, PXR24, B44(A), DWAA, DWAB


def is_whole(path: Path) -> bool:
    """path: of a .png or a .exr."""
    try:
        data = path.read_bytes()
        return data.endswith(PNG_END) if path.suffix == ".png" else is_whole_exr(data)
    except (OSError, struct.error, ValueError, KeyError):
        return False


def is_whole_exr(data: bytes) -> bool:
    """Its table of chunks, which is written last, is complete, and so is the last chunk."""
    if not data.startswith(EXR_MAGIC):
        return False
    is_multipart = bool(struct.unpack_from("<i", data, 4)[0] & MULTIPART)
    chunks, at = 0, 8
    while not is_multipart or data[at]:  # the headers of many parts end with an empty one
        header, at = read_header(data, at)
        chunks += chunk_count(header)
        if not is_multipart:
            break
    at += is_multipart
    offsets = struct.unpack_from(f"<{chunks}Q", data, at)
    if not all(offsets):
        return False
    size_at = max(offsets) + (8 if is_multipart else 4)  # past the part's number and the chunk's first line
    return size_at + 4 + struct.unpack_from("<i", data, size_at)[0] <= len(data)


def read_header(data: bytes, at: int) -> tuple[dict[bytes, Any], int]:
    """The attributes of a header by name, and where it ends."""
    header = {}
    while data[at]:
        name_end = data.index(0, at)
        type_end = data.index(0, name_end + 1)
        (size,) = struct.unpack_from("<i", data, type_end + 1)
        header[data[at:name_end]] = data[type_end + 5 : type_end + 5 + size]
        at = type_end + 5 + size
    return header, at + 1


def chunk_count(header: dict[bytes, Any]) -> int:
    if b"chunkCount" in header:
        return struct.unpack("<i", header[b"chunkCount"])[0]
    _, y0, _, y1 = struct.unpack("<4i", header[b"dataWindow"])
    return math.ceil((y1 - y0 + 1) / CHUNK_LINES[header[b"compression"][0]])
