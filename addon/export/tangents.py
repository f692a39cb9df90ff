"""Tangents of UV maps, as normal maps are baked for them.

[Mikkelsen08] Simulation of Wrinkled Surfaces Revisited, and its reference, MikkTSpace. A corner's tangent is the mean
of those of the triangles around its vertex that have its normal, UV and handedness, by their angles there. Triangles
that only meet at a vertex count as around it too.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from .mesh import MeshArrays

Array = NDArray[np.float32]


def corner_tangents(arrays: MeshArrays, corner_normals: Array, uv: Array) -> Array:
    """(C, 4) of normals (C, 3) and UVs (C, 2): unit tangents along u in object space, and the bitangent's sign."""
    corners = arrays.triangle_corners
    positions = arrays.positions[arrays.corner_vertices]
    p, t = positions[corners], uv[corners]  # (T, 3, 3) and (T, 3, 2)
    (e1, e2), (s1, s2) = (p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]), (t[:, 1] - t[:, 0], t[:, 2] - t[:, 0])
    area = s1[:, 0] * s2[:, 1] - s1[:, 1] * s2[:, 0]
    sign = np.where(area < 0, np.float32(-1), np.float32(1))
    along = _unit(sign[:, None] * (s2[:, 1, None] * e1 - s1[:, 1, None] * e2))

    normals = corner_normals[corners]
    sums = _flat(along[:, None], normals) * (_angles(p, normals) * (area != 0)[:, None])[..., None]
    group = _groups(np.concatenate([positions, corner_normals, uv], axis=1), corners, sign)
    total = np.stack([np.bincount(group.ravel(), sums[..., i].ravel()) for i in range(3)], axis=-1)
    result = np.zeros((len(uv), 4), np.float32)
    result[corners, :3] = _unit(total)[group]
    result[corners, 3] = sign[:, None]
    return result


def _angles(p: Array, normals: Array) -> Array:
    """(T, 3): the triangles' angles at their corners, seen along the normals there."""
    there = [_flat(p[:, [(i + step) % 3 for i in range(3)]] - p, normals) for step in (1, 2)]
    return np.arccos(np.clip((there[0] * there[1]).sum(-1), -1, 1))


def _groups(corner_data: Array, corners: NDArray[np.int32], sign: Array) -> NDArray[np.int64]:
    """(T, 3): the same number where the corners' data and the signs are the same."""
    words = np.ascontiguousarray(corner_data + np.float32(0)).view(np.uint32).astype(np.uint64)  # -0 becomes 0
    mixed = np.zeros(len(words), np.uint64)
    for column in range(words.shape[1]):
        mixed = (mixed ^ words[:, column]) * np.uint64(0x9E3779B97F4A7C15)
        mixed ^= mixed >> np.uint64(29)
    keys = mixed[corners] * np.uint64(2) + (sign > 0)[:, None].astype(np.uint64)
    return np.unique(keys.ravel(), return_inverse=True)[1].reshape(corners.shape)


def _flat(v: Array, normals: Array) -> Array:
    """Unit, across the normals."""
    return _unit(v - (v * normals).sum(-1, keepdims=True) * normals)


def _unit(v: Array) -> Array:
    """0 of 0."""
    size = np.sqrt((v * v).sum(-1, keepdims=True))
    return np.divide(v, size, out=np.zeros_like(v), where=size > 0)
