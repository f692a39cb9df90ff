"""How pointed a mesh is at each vertex, as Cycles has it: the angle between its normal and the mean of its edges.

0.5 where it is flat, more where it stands out, less in a hollow.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float32]


def pointiness(positions: Array, normals: Array, edges: NDArray[np.int32]) -> Array:
    """(V,) in [0, 1], of positions (V, 3), vertex normals (V, 3) and edges (E, 2).

    Vertices at one place are one; each value is the mean of its own and of those that an edge leads to.
    """
    places, place_of = np.unique(positions, axis=0, return_inverse=True)
    place_of = place_of.reshape(-1)
    count = len(places)
    edges = np.unique(np.sort(place_of[edges], axis=1), axis=0)
    edges = edges[edges[:, 0] != edges[:, 1]]
    ends = np.concatenate([edges, edges[:, ::-1]])  # each edge both ways
    along = places[ends[:, 1]] - places[ends[:, 0]]
    along /= np.linalg.norm(along, axis=1, keepdims=True)
    edge_count = np.bincount(ends[:, 0], minlength=count)
    mean_edge = _sums(ends[:, 0], along, count) / np.maximum(edge_count, 1)[:, None]
    normal = _sums(place_of, normals, count)
    normal /= np.maximum(np.linalg.norm(normal, axis=1, keepdims=True), np.float32(1e-20))
    angle = np.arccos(np.clip((normal * mean_edge).sum(axis=1), -1, 1)) / np.pi
    raw = np.where(edge_count > 0, angle, 0.0)
    smooth = (raw + np.bincount(ends[:, 0], raw[ends[:, 1]], count)) / (edge_count + 1)
    return smooth[place_of].astype(np.float32)


def _sums(indices: NDArray[np.int64], vectors: Array, count: int) -> Array:
    """(count, 3): of the vectors (N, 3) of each index (N,)."""
    return np.stack([np.bincount(indices, vectors[:, axis], count) for axis in range(3)], axis=1)
