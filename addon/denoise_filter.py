"""What a denoiser made of pixels' own samples, as the pixel filter shows it.

Own samples fill a square of one pixel, and the filter reaches farther. A square's variance is 1/12 px^2 along each
axis; what the filter has more is added by steps over three pixels. Without them edges of what was denoised would be
sharper than those of the picture beside it.

[Harris78] On the Use of Windows for Harmonic Analysis with the Discrete Fourier Transform: Blackman-Harris, of which an
offset's variance over its squared width is 1/12 + (-a1 + a2 / 4 - a3 / 9) / (2 pi^2 a0).
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

Pixels = NDArray[np.float32]

_FILTER_VARIANCE = 1 / 12 + (-0.48829 + 0.14128 / 4 - 0.01168 / 9) / (2 * math.pi**2 * 0.35875)
_MOST_SIDE = 0.25  # of what a step takes from the pixel on each side; with more it would ring


def softened(picture: Pixels, filter_width_px: float) -> Pixels:
    """(height, width, channels) as a filter of that whole width shows what a square of a pixel showed."""
    variance_px2 = _FILTER_VARIANCE * filter_width_px**2 - 1 / 12
    steps = max(0, math.ceil(variance_px2 / (2 * _MOST_SIDE)))
    for _ in range(steps):
        for axis in (0, 1):
            picture = _step(picture, axis, variance_px2 / (2 * steps))
    return picture


def _step(picture: Pixels, axis: int, side: float) -> Pixels:
    """Each pixel takes so much from those on its two sides; at the picture's edges its own."""
    padding = [(0, 0)] * picture.ndim
    padding[axis] = (1, 1)
    wide = np.moveaxis(np.pad(picture, padding, mode="edge"), axis, 0)
    mixed = np.float32(side) * (wide[:-2] + wide[2:]) + np.float32(1 - 2 * side) * wide[1:-1]
    return np.ascontiguousarray(np.moveaxis(mixed, 0, axis))
