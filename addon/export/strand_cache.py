"""The strands of a hair particle system where Blender keeps them, instead of by a call for each point.

Blender has no call that tells many points. Its memory is read only if it looks as it does in every Blender that was
tried (3.4 to 5.2), and some points are as Blender tells them.
"""

from __future__ import annotations

import ctypes
from typing import Any

import numpy as np
from numpy.typing import NDArray

# Pointers at the beginning of DNA_particle_types.h's ParticleSystem, by their places.
_SETTINGS, _PARTICLES, _CHILDREN, _PARENT_PATHS, _CHILD_PATHS, _POINTERS = 2, 3, 4, 7, 8, 9
# BKE_particle.h's ParticleCacheKey: a position, and last how many segments the strand has.
_KEY = np.dtype({"names": ["position", "segments"], "formats": ["3f4", "i4"], "offsets": [0, 56], "itemsize": 60})
_ROUNDING = 1e-5

Array = NDArray[np.float32]


def cached_positions(blender_object: Any, system: Any, first: int, count: int, steps: int) -> Array | None:
    """(count, steps, 3) as `co_hair` of an evaluated object tells them: world space. None: ask that."""
    strands = _addresses(system, first, count)
    positions = None if strands is None else _read(strands, steps)
    return positions if positions is not None and _is_told(blender_object, system, first, positions) else None


def _addresses(system: Any, first: int, count: int) -> NDArray[np.uint64] | None:
    """(count,), of each strand's _KEYs."""
    parents, children = system.particles, system.child_particles
    fields = _at(system.as_pointer(), np.dtype(np.uint64), _POINTERS)
    expected = {_SETTINGS: [system.settings], _PARTICLES: parents[:1], _CHILDREN: children[:1]}
    if not parents or any(owner and fields[at] != owner[0].as_pointer() for at, owner in expected.items()):
        return None
    paths = fields[_CHILD_PATHS if first else _PARENT_PATHS]
    if not paths or not 0 < count <= (len(children) if first else len(parents) + len(children)):
        return None
    of_parents = 0 if first else min(count, len(parents))
    strands = _at(int(paths), np.dtype(np.uint64), of_parents or count)
    if count > len(strands):
        if not fields[_CHILD_PATHS]:
            return None
        strands = np.concatenate([strands, _at(int(fields[_CHILD_PATHS]), np.dtype(np.uint64), count - of_parents)])
    return strands if strands.all() else None


def _read(strands: NDArray[np.uint64], steps: int) -> Array | None:
    """(count, steps, 3); points that a strand lacks are 0."""
    count = len(strands)
    positions, segments = np.empty((count, steps, 3), np.float32), np.empty(count, np.int32)
    # Those of about a thousand strands lie behind each other.
    apart = np.diff(strands.astype(np.int64))
    ends = [*(np.flatnonzero(apart != apart[0]) + 1 if count > 1 else []), count]
    begin = 0
    for end in ends:
        number, stride = end - begin, int(apart[begin]) if end - begin > 1 else steps * _KEY.itemsize
        if stride < steps * _KEY.itemsize:
            return None
        block = (ctypes.c_char * ((number - 1) * stride + steps * _KEY.itemsize)).from_address(int(strands[begin]))
        keys = np.ndarray((number, steps), _KEY, block, 0, (stride, _KEY.itemsize))
        positions[begin:end], segments[begin:end] = keys["position"], keys["segments"][:, 0]
        begin = end
    positions[segments[:, None] < np.arange(steps)] = 0
    return positions


def _at(address: int, kind: np.dtype[Any], count: int) -> NDArray[Any]:
    return np.frombuffer((ctypes.c_char * (count * kind.itemsize)).from_address(address), kind)


def _is_told(blender_object: Any, system: Any, first: int, positions: Array) -> bool:
    """Whether Blender tells about the same of some strands: not of what moved since it made them."""
    count, steps = positions.shape[:2]
    rounding = _ROUNDING * float(np.abs(positions).max())
    for strand in {0, count // 3, count // 2, count - 1}:
        told = [system.co_hair(object=blender_object, particle_no=first + strand, step=step) for step in range(steps)]
        if not np.allclose(positions[strand], told, rtol=0, atol=rounding):
            return False
    return True
