"""OpenEXR files of several layers as files of one, which Blender's API gives the pixels of.

Cycles reads the first four channels of the first part, layers in alphabetical order. The same file with these channels
named as those of one picture is read by Blender. [OpenEXR, File Layout; OpenImageIO, openexrinput.cpp]
"""

from __future__ import annotations

import struct
from collections.abc import Iterator
from mmap import mmap

import numpy as np

_TILED, _DEEP, _PARTS = 0x200, 0x800, 0x1000  # flags of the version
_KEPT = (  # attributes that say how pixels lie in the file
    b"compression dataWindow displayWindow lineOrder pixelAspectRatio screenWindowCenter screenWindowWidth tiles"
).split()

Data = bytes | mmap
Attributes = dict[bytes, tuple[bytes, bytes]]  # type and value, by name


def first_layer(data: Data) -> bytes | None:
    """An OpenEXR file of what Cycles reads of another; None where that has no layers.

    Raises ValueError where the first layer is not of R, G, B and A, and IndexError, KeyError or struct.error where
    the file is broken.
    """
    version = struct.unpack_from("<I", data, 4)[0]
    headers, at = _headers(data, bool(version & _PARTS))
    channels = list(_channels(headers[0][b"channels"][1]))
    if not any(b"." in name for name, _ in channels):
        return None
    layer = min(name.rpartition(b".")[0] for name, _ in channels)
    ours = {b".".join(filter(None, (layer, letter))): letter for letter in (b"A", b"B", b"G", b"R")}
    of_layer = [name for name, _ in channels if name.rpartition(b".")[0] == layer]
    if of_layer != list(ours) or version & _DEEP:
        raise ValueError("a multilayer image is supported where its first layer is of R, G, B and A")
    header = _header(headers[0], _named(channels, ours))
    if not version & _PARTS:
        table = np.frombuffer(data, "<u8", (struct.unpack_from("<Q", data, at)[0] - at) // 8, at)
        return _file(version, header, table.astype(np.int64) - at - table.nbytes, data[at + table.nbytes :])
    table = np.frombuffer(data, "<u8", struct.unpack("<i", headers[0][b"chunkCount"][1])[0], at)
    is_tiled = b"tiles" in headers[0]
    chunks = [_chunk(data, int(offset), 20 if is_tiled else 8) for offset in table]
    starts = np.cumsum([0, *map(len, chunks[:-1])])
    return _file(version & ~_PARTS | (_TILED if is_tiled else 0), header, starts, b"".join(chunks))


def _file(version: int, header: bytes, starts: np.ndarray, chunks: bytes) -> bytes:
    """starts: of the chunks, from where they begin in the file."""
    begin = 8 + len(header) + 8 * len(starts)
    return struct.pack("<2I", 20000630, version) + header + (starts + begin).astype("<u8").tobytes() + chunks


def _chunk(data: Data, at: int, head_bytes: int) -> bytes:
    """Without the number of its part. head_bytes: from there to its pixels."""
    begin = at + 4
    size = struct.unpack_from("<i", data, begin + head_bytes - 4)[0]
    return data[begin : begin + head_bytes + size]


def _headers(data: Data, has_parts: bool) -> tuple[list[Attributes], int]:
    """The headers, and where they end."""
    headers, at = [], 8
    while True:
        header: Attributes = {}
        while data[at]:
            name, at = _text(data, at)
            kind, at = _text(data, at)
            size = struct.unpack_from("<i", data, at)[0]
            header[name] = (kind, data[at + 4 : at + 4 + size])
            at += 4 + size
        at += 1
        headers.append(header)
        if not has_parts or not data[at]:
            return headers, at + has_parts


def _header(attributes: Attributes, channels: bytes) -> bytes:
    kept = {b"channels": (b"chlist", channels)} | {name: attributes[name] for name in _KEPT if name in attributes}
    parts = [
        name + b"\0" + kind + b"\0" + struct.pack("<i", len(value)) + value for name, (kind, value) in kept.items()
    ]
    return b"".join(parts) + b"\0"


def _channels(value: bytes) -> Iterator[tuple[bytes, bytes]]:
    """Names, and what follows them."""
    at = 0
    while value[at]:
        name, at = _text(value, at)
        yield name, value[at : at + 16]
        at += 16


def _named(channels: list[tuple[bytes, bytes]], names: dict[bytes, bytes]) -> bytes:
    """With other names, of those that none is given for such that they stay in the alphabet's order."""
    value, before = b"", b"0"
    for index, (name, rest) in enumerate(channels):
        before = names.get(name, before)
        value += (before if name in names else b"%s_%05d" % (before[:1], index)) + b"\0" + rest
    return value + b"\0"


def _text(data: Data, at: int) -> tuple[bytes, int]:
    """Up to a zero, and where the next thing begins. Raises IndexError where the data ends before."""
    end = data.find(b"\0", at)
    if end < 0:
        raise IndexError("a name without an end")
    return data[at:end], end + 1
