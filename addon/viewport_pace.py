"""How coarse the pictures are that are shown while something moves, so that they keep up with the hand."""

from __future__ import annotations

import math
import time

_LONGEST_S = 0.05  # of a picture: with what drawing takes, some 15 a second
_SHORTEST_S = 0.02
_DRAWS = 1.5  # a picture is ready by the second draw after the one that it is of
_MOST_PX = 16.0  # edge of a pixel
_STEP = 2**0.25  # edges differ by: a little more or less time changes none
_STILL_S = 0.3  # draws further apart are of no movement


class Pace:
    """It learns what a pixel takes from the pictures that were made, and how soon the next is wanted from the draws."""

    def __init__(self) -> None:
        self._pixel_s: float | None = None
        self._draw_s = 1.0
        self._drawn_s = 0.0

    def drew(self) -> None:
        """A draw begins."""
        now_s = time.monotonic()
        since_s, self._drawn_s = now_s - self._drawn_s, now_s
        if since_s < _STILL_S:
            self._draw_s += 0.3 * (since_s - self._draw_s)
        else:
            self._draw_s = since_s

    def took(self, elapsed_s: float, pixel_count: int) -> None:
        """A picture of so many pixels with a sample in each was made; in so long."""
        pixel_s = elapsed_s / pixel_count
        self._pixel_s = pixel_s if self._pixel_s is None else self._pixel_s + 0.3 * (pixel_s - self._pixel_s)

    def pixel_px(self, pixel_count: int, finest_px: float) -> float:
        """The edge of the pixels of a picture that would have so many if it were as fine as the region."""
        if self._pixel_s is None:
            return max(4.0, finest_px)
        budget_s = min(max(_DRAWS * self._draw_s, _SHORTEST_S), _LONGEST_S)
        edge_px = math.sqrt(max(1.0, self._pixel_s * pixel_count / budget_s))
        step = math.ceil(math.log(edge_px, _STEP) - 0.5)
        return min(max(_STEP**step, finest_px), _MOST_PX)
