"""How coarse the pictures are that are shown while something moves, so that they keep up with the hand."""

from __future__ import annotations

import math
import time

_BETWEEN_S = 1 / 15  # pictures: what Blender's drawing leaves of it is theirs
_LONGEST_S = 0.05  # of a picture
_SHORTEST_S = 0.006
_DRAWS = 1.5  # a picture that no draw waits for is ready by the second draw after the one that it is of
_MOST_PX = 16.0  # edge of a pixel
_STEP = 2**0.25  # edges differ by: a little more or less time changes none
_STILL_S = 0.3  # draws further apart are of no movement
_LEAST_WAIT_S = 0.004
_REDRAW_S = 0.1
_SHOWING = 0.25  # of the time
_MOST_WAIT_S = 0.1


class Pace:
    """It learns what a pixel takes from the pictures that were made, and from the draws how soon the next is wanted.

    Blender puts a draw on the screen after it, which takes as long as it takes: much without a graphics card.
    """

    def __init__(self) -> None:
        self._pixel_s: float | None = None
        self._draw_s = 1.0
        self._began_s = 0.0
        self._ended_s: float | None = None  # of a draw that is not yet known to be on the screen
        self._onto_screen_s = 0.0

    def draw_begins(self) -> None:
        now_s = time.monotonic()
        since_s, self._began_s = now_s - self._began_s, now_s
        if since_s < _STILL_S:
            self._draw_s += 0.3 * (since_s - self._draw_s)
        else:
            self._draw_s = since_s

    def draw_ends(self) -> None:
        self._ended_s = time.monotonic()

    def is_on_screen(self) -> None:
        """Whatever was drawn is: Blender's loop goes on."""
        if self._ended_s is not None:
            self._onto_screen_s += 0.3 * (time.monotonic() - self._ended_s - self._onto_screen_s)
            self._ended_s = None

    @property
    def wait_s(self) -> float:
        """How long a draw waits for a picture of what it shows: as long as it would take to draw once more for it."""
        return min(max(self._onto_screen_s, _LEAST_WAIT_S), _MOST_WAIT_S)

    @property
    def redraw_s(self) -> float:
        """Between pictures of samples that add up: rendering is to have most of the time."""
        return max(_REDRAW_S, self._onto_screen_s / _SHOWING)

    def took(self, elapsed_s: float, pixel_count: int) -> None:
        """A picture of so many pixels with a sample in each was made; in so long."""
        pixel_s = elapsed_s / pixel_count
        self._pixel_s = pixel_s if self._pixel_s is None else self._pixel_s + 0.3 * (pixel_s - self._pixel_s)

    def pixel_px(self, pixel_count: int, finest_px: float) -> float:
        """The edge of the pixels of a picture that would have so many if it were as fine as the region."""
        if self._pixel_s is None:
            return max(4.0, finest_px)
        wanted_s = min(_DRAWS * self._draw_s, _BETWEEN_S - self._onto_screen_s)
        budget_s = min(max(wanted_s, _SHORTEST_S), _LONGEST_S)
        edge_px = math.sqrt(max(1.0, self._pixel_s * pixel_count / budget_s))
        step = math.ceil(math.log(edge_px, _STEP) - 0.5)
        return min(max(_STEP**step, finest_px), _MOST_PX)
