"""The ids of Cryptomatte, and the metadata by which compositors find names for them.

[Friedman15] Fully Automatic ID Mattes with Support for Motion Blur and Transparency; its specification, version 1.0.
"""

from __future__ import annotations

import json
import struct

import bpy

_WORD = 0xFFFFFFFF


def name_hash(name: str) -> int:
    """MurmurHash3, 32 bits, seed 0."""
    data = name.encode()
    result = 0
    for start in range(0, len(data) - 3, 4):
        result = _rotated(result ^ _mixed(int.from_bytes(data[start : start + 4], "little")), 13)
        result = (result * 5 + 0xE6546B64) & _WORD
    tail = data[len(data) & ~3 :]
    if tail:
        result ^= _mixed(int.from_bytes(tail, "little"))
    result ^= len(data)
    for shift, factor in ((16, 0x85EBCA6B), (13, 0xC2B2AE35), (16, 1)):
        result = ((result ^ (result >> shift)) * factor) & _WORD
    return result


def hash_id(word: int) -> float:
    """A hash as a float that is a number: its exponent is neither the least nor the greatest. [Friedman15]"""
    exponent = min(max((word >> 23) & 0xFF, 1), 254)
    [number] = struct.unpack("<f", struct.pack("<I", (word & 0x807FFFFF) | exponent << 23))
    return float(number)


def asset_name(blender_object: bpy.types.Object) -> str:
    """Of all that hangs together: its topmost parent's."""
    while blender_object.parent is not None:
        blender_object = blender_object.parent
    return blender_object.name


class Mattes:
    """The names that a scene's ids stand for, by the kind of pass."""

    def __init__(self) -> None:
        self._hashes: dict[str, dict[str, int]] = {"OBJECT": {}, "MATERIAL": {}, "ASSET": {}}

    def id_of(self, kind: str, name: str) -> float:
        hashes = self._hashes[kind]
        if name not in hashes:
            hashes[name] = name_hash(name)
        return hash_id(hashes[name])

    def metadata(self, kind: str, layer_name: str, pass_name: str) -> dict[str, str]:
        """What a file says of one kind's passes."""
        name = f"{layer_name}.{pass_name}"
        prefix = f"cryptomatte/{name_hash(name):08x}"[: len("cryptomatte/") + 7]
        manifest = {of: f"{word:08x}" for of, word in self._hashes[kind].items()}
        return {
            f"{prefix}/name": name,
            f"{prefix}/hash": "MurmurHash3_32",
            f"{prefix}/conversion": "uint32_to_float32",
            f"{prefix}/manifest": json.dumps(manifest, separators=(",", ":"), ensure_ascii=False),
        }


def _mixed(word: int) -> int:
    return (_rotated((word * 0xCC9E2D51) & _WORD, 15) * 0x1B873593) & _WORD


def _rotated(word: int, left: int) -> int:
    return ((word << left) | (word >> (32 - left))) & _WORD
