"""Where a picture is better as it is and where denoised: what lies between the two, noise aside, the denoiser did.

With v the variance of the noisy picture and r the squared difference of the two, both as means over pixels close by,
the denoised one is off by r - v, and the mix with the least squared error takes (r - v) / r of the noisy one, as
[James61] shrinks estimates by their own spread. All of it is over squared light, by which eyes see it. Where a picture
is all detail the denoised one has much of the same noise, r is less by that, and r - v would tell of too little: only
a part of v is subtracted, for which 0.3 of the noisy picture stays where the denoised one is right.

[James61] James and Stein, "Estimation with Quadratic Loss".
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Pixels = NDArray[np.float32]

_DARK = 0.1  # where light is less, noise is seen as there
_REACH_PX = 2
_TOLD = 0.6  # of the noise: so much of it lies between the noisy and the denoised picture, at the least


def relative_noise(variance: Pixels, picture: Pixels) -> Pixels:
    """Variance over squared light, as pixels close by have it: (height, width).

    variance: (height, width, 1). picture: (height, width, 3) or more, whose noise is seen.
    """
    return _around(variance[..., 0] * _per_squared_light(picture))


def share_kept(
    noisy: Pixels, clean: Pixels, noise: Pixels, unseen: float, picture: Pixels, averaged: int = 1
) -> Pixels:
    """How much of each pixel is to be of the noisy light, the rest of the clean one: (height, width, 1).

    noisy, clean: (height, width, 3), light of the picture. noise: that of the noisy one, as relative_noise() has it.
    unseen: noise up to that is no harm. averaged: of how many pixels noisy and clean are means, whose noise is told.
    """
    difference = _around(np.mean((noisy - clean) ** 2, axis=-1) * _per_squared_light(picture))
    off, harm = np.maximum(difference - _TOLD * noise / averaged, 0), np.maximum(noise - unseen, 0)
    off = np.maximum(off, 1e-12)  # without any harm all is kept
    share: Pixels = (off / (off + harm))[..., None].astype(np.float32)
    return share


def _per_squared_light(picture: Pixels) -> Pixels:
    return 1 / (_around(picture[..., :3].mean(axis=-1)) ** 2 + _DARK**2)


def _around(values: Pixels) -> Pixels:
    """Means over the pixels close by, which weigh less the farther they are: (height, width)."""
    for axis in (0, 1, 0, 1):
        values = _means_along(values, axis)
    return values


def _means_along(values: Pixels, axis: int) -> Pixels:
    """Means over 2 _REACH_PX + 1 numbers, those at the ends over as many as there are."""
    count = values.shape[axis]
    sums = np.cumsum(values, axis=axis, dtype=np.float64)
    sums = np.concatenate([np.zeros_like(np.take(sums, [0], axis)), sums], axis=axis)
    first = np.maximum(np.arange(count) - _REACH_PX, 0)
    end = np.minimum(np.arange(count) + _REACH_PX + 1, count)
    across = (end - first).reshape((-1, 1) if axis == 0 else (1, -1))
    means: Pixels = ((np.take(sums, end, axis) - np.take(sums, first, axis)) / across).astype(np.float32)
    return means
