"""A random number for each part of a mesh whose vertices hang together, as Cycles has it.

It is that of the part's root in a forest of disjoint sets, joined by rank, edge by edge.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

_ROTATIONS = (14, 11, 25, 16, 4, 14, 24)


def random_of_islands(vertex_count: int, edges: NDArray[np.int32]) -> NDArray[np.float32]:
    """(V,) in [0, 1]; edges (E, 2)."""
    parents, ranks = list(range(vertex_count)), [0] * vertex_count

    def root(vertex: int) -> int:
        while parents[vertex] != vertex:
            parents[vertex] = parents[parents[vertex]]
            vertex = parents[vertex]
        return vertex

    for start, end in edges.tolist():
        high, low = root(start), root(end)
        if high == low:
            continue
        if ranks[high] < ranks[low]:
            high, low = low, high
        parents[low] = high
        ranks[high] += ranks[high] == ranks[low]
    return random_of_numbers(np.array([root(vertex) for vertex in range(vertex_count)], np.uint32))


def random_of_numbers(whole: NDArray[np.uint32], words: int = 1) -> NDArray[np.float32]:
    """[0, 1] of whole numbers, or of each and so many words less one that are 0.

    [Jenkins06, lookup3's final mixing, seeded as in Cycles 4.5 util/hash.h, hash_uint and hash_uint2]
    """
    seed = np.uint32(0xDEADBEEF + (words << 2) + 13)
    numbers = [whole + seed, np.full_like(whole, seed), np.full_like(whole, seed)]
    for step, turn in enumerate(_ROTATIONS):
        mixed, by = (2, 0, 1)[step % 3], (1, 2, 0)[step % 3]
        other = numbers[by]
        rotated = (other << np.uint32(turn)) | (other >> np.uint32(32 - turn))
        numbers[mixed] = (numbers[mixed] ^ other) - rotated
    return (numbers[2] / np.float32(0xFFFFFFFF)).astype(np.float32)
