"""Pictures and figures for virtual_lights.py."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float32]


def relmse(picture: Floats, reference: Floats) -> float:
    """Mean of squared errors over squared radiance, or over a hundredth of the mean square where it is darker."""
    a, r = picture[..., :3], reference[..., :3]
    return float(np.mean((a - r) ** 2 / (r**2 + 0.01 * np.mean(r**2))))


def flicker(frames: list[Floats]) -> float:
    """What a frame's radiance is off by from the mean of those before and after it, on average: half the second
    difference, which motion leaves nearly none of."""
    stack = np.stack(frames)
    return float(np.abs(stack[2:] - 2 * stack[1:-1] + stack[:-2]).mean() / 2)
