"""Grids of numbers that objects keep for the shaders of their volumes: where they lie, and what they are between."""

from __future__ import annotations

from collections.abc import Callable, Hashable
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float32]
Matrix = NDArray[np.float64]  # (4, 4)


@dataclass(frozen=True)
class Lattice:
    """Points in space, at whole numbers from 0 on of its own space."""

    size: tuple[int, int, int]  # x, y, z
    grid_from_object: Matrix

    @property
    def count(self) -> int:
        return int(np.prod(self.size))

    def is_at(self, other: Lattice) -> bool:
        """Whether the points are the same."""
        return self.size == other.size and np.array_equal(self.grid_from_object, other.grid_from_object)

    def points(self, part: slice) -> Matrix:
        """(N, 3) in object space, of a part of them; x changes fastest."""
        z, y, x = np.unravel_index(np.arange(part.start, part.stop), self.size[::-1])
        object_from_grid = np.linalg.inv(self.grid_from_object)
        return np.stack([x, y, z], axis=1) @ object_from_grid[:3, :3].T + object_from_grid[:3, 3]

    def corners(self, beyond: int) -> Matrix:
        """(8, 4) in object space, so many steps beyond the outermost points; x changes fastest."""
        ends = [(-beyond, n - 1 + beyond) for n in self.size]
        points = [(x, y, z, 1) for z in ends[2] for y in ends[1] for x in ends[0]]
        return np.array(points) @ np.linalg.inv(self.grid_from_object).T


@dataclass(frozen=True)
class Grid:
    values: Array  # (z, y, x, channels)
    grid_from_object: Matrix  # the value at [k, j, i] is at (i, j, k)

    @property
    def lattice(self) -> Lattice:
        z, y, x, _ = self.values.shape
        return Lattice((x, y, z), self.grid_from_object)

    def at(self, lattice: Lattice) -> Array:
        """(N, channels) at a lattice's points, x fastest; 0 outside."""
        if lattice.is_at(self.lattice):
            return self.values.reshape(-1, self.values.shape[3])
        to_own = self.grid_from_object @ np.linalg.inv(lattice.grid_from_object)
        x, y = (np.arange(n) for n in lattice.size[:2])
        slices = [
            self._between(np.stack(np.broadcast_arrays(x, y[:, None], z, 1), axis=-1).reshape(-1, 4) @ to_own.T)
            for z in range(lattice.size[2])
        ]
        return np.concatenate(slices)

    def _between(self, points: Matrix) -> Array:
        """Interpolated linearly at (N, 4) points of its own space."""
        low = np.floor(points[:, :3]).astype(np.int64)
        share = points[:, :3] - low
        sizes = np.array(self.lattice.size)
        result = np.zeros((len(points), self.values.shape[3]), np.float32)
        for corner in np.ndindex(2, 2, 2):
            place = low + corner
            weight = np.where(corner, share, 1 - share).prod(axis=1) * ((place >= 0) & (place < sizes)).all(axis=1)
            i, j, k = np.clip(place, 0, sizes - 1).T
            result += weight[:, None].astype(np.float32) * self.values[k, j, i]
        return result


@dataclass(eq=False)
class Grids:
    """Those of one object, read when asked for. read: None where there is none of the name."""

    read: Callable[[str], Grid | None]
    key: Hashable  # tells the object and what it is now from others
    density_scale: float = 1.0  # what all coefficients are multiplied with
    found: dict[str, Grid] = field(default_factory=dict)

    def has(self, name: str) -> bool:
        if name not in self.found:
            grid = self.read(name)
            if grid is None:
                return False
            self.found[name] = grid
        return True

    def lattice(self, names: frozenset[str]) -> Lattice | None:
        """The points of the finest of the grids of these names, over all of them; None without any."""
        lattices = [self.found[name].lattice for name in sorted(names) if self.has(name)]
        if not lattices:
            return None
        finest = max(lattices, key=lambda lattice: abs(np.linalg.det(lattice.grid_from_object[:3, :3])))
        if all(lattice.is_at(finest) for lattice in lattices):
            return finest
        return _enclosing(finest, lattices)


NO_GRIDS = Grids(lambda _: None, key=None)


def _enclosing(finest: Lattice, lattices: list[Lattice]) -> Lattice:
    """The finest one's points, and as many more as it takes to where they all have fallen to 0."""
    places = np.concatenate([lattice.corners(1) for lattice in lattices]) @ finest.grid_from_object.T
    low = np.floor(places[:, :3].min(axis=0) + 1e-3).astype(int)
    high = np.ceil(places[:, :3].max(axis=0) - 1e-3).astype(int)
    shift = np.eye(4)
    shift[:3, 3] = -low
    x, y, z = (int(n) for n in high - low + 1)
    return Lattice((x, y, z), shift @ finest.grid_from_object)
