"""Pictures of microfacets' normals, drawn from formulas: (n, n), row 0 at y = -1, each pixel the mean over its part of
the unit disk."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def points(size: int, across: int) -> tuple[Array, Array, Array]:
    """x, y and z^2 of across * across points a pixel."""
    edges = (np.arange(size * across) + 0.5) / (size * across) * 2 - 1
    x, y = np.meshgrid(edges, edges)
    return x, y, 1 - x * x - y * y


def ggx(x: Array, y: Array, z2: Array, alpha: float, alpha_y: float | None = None, tilt: float = 0.0) -> Array:
    """D of GGX about a normal whose slope along x is tilt."""
    alpha_y = alpha_y or alpha
    z = np.sqrt(np.maximum(z2, 1e-12))
    return 1 / (np.pi * alpha * alpha_y * (((x - tilt * z) / alpha) ** 2 + (y / alpha_y) ** 2 + z * z) ** 2)


def draw(size: int, alpha: float, alpha_y: float | None = None, tilt: float = 0.0, across: int = 4) -> Array:
    """The same about slopes tilt and -tilt, as a picture."""
    x, y, z2 = points(size, across)
    inside = z2 > 0
    values = (ggx(x, y, z2, alpha, alpha_y, tilt) + ggx(x, y, z2, alpha, alpha_y, -tilt)) * inside / 2
    total, count = (a.reshape(size, across, size, across).sum((1, 3)) for a in (values, inside))
    return total / np.maximum(count, 1)


def sharp(kind: str, size: int = 256) -> Array:
    """Pictures that no sum of a few lobes is."""
    x, y, _ = points(size, 1)
    radius = np.hypot(x, y)
    picture = np.zeros((size, size))
    if kind == "pixel":
        picture[size // 2, size // 2] = 1
    elif kind == "tilted pixel":
        picture[size // 2, size * 3 // 4] = 1
    elif kind == "ring":
        picture[(radius > 0.4) & (radius < 0.42)] = 1
    elif kind == "grid":
        picture[::16, ::16] = 1
    elif kind == "rim":
        picture[radius > 0.99] = 1
    return picture
