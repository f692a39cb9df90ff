"""What is seen in a 3D view, without noise: cleaned beside the interface, while samples go on adding up."""

from __future__ import annotations

import math
import threading
from typing import Any

from . import denoise

_FINE_SAMPLES = 4
_FIRST_PIXELS = 60_000  # of a picture of few samples: it is to be there within 40 ms
_PASSES = (
    "Combined",
    "Indirect",
    "Noisy Image",
    "Noisy Indirect",
    "Direct Variance",
    "Indirect Variance",
    "Denoising Albedo",
    "Denoising Normal",
)


class ViewportDenoiser:
    """One picture at a time. A session's is cleaned whenever it has twice the samples, and at its end.

    That of its first samples is filtered by large pixels, to be there soon: the larger, the larger the view is.
    """

    def __init__(self) -> None:
        self._denoiser = denoise.Denoiser(is_quick=True)
        self._thread: threading.Thread | None = None
        self._is_broken = False
        self._session_number = 0
        self._samples_begun = 0  # of the session, in the last that was begun
        self._result: tuple[int, Any] | None = None  # the session's number, and (height, width, 4); None: it failed

    def forget(self) -> None:
        """The pictures to come are of another session."""
        self._session_number += 1
        self._samples_begun = 0

    def offer(self, mode: str, session: Any, filter_width_px: float, samples: int, finished: bool) -> None:
        """Begin with a session's picture if it is better than the last and there is nothing else to do.

        mode: as scene.pivot.denoise. session: with denoising_passes. filter_width_px: of its pixel filter.
        """
        is_better = samples >= 2 * self._samples_begun or (finished and samples > self._samples_begun)
        if samples == 0 or not is_better or self._is_broken or self._is_busy():
            return
        passes = {name: session.read(name) for name in _PASSES}
        self._samples_begun, self._denoiser.filter_width_px = samples, filter_width_px
        is_first = samples < _FINE_SAMPLES and not finished
        edge_px = max(2, math.ceil(math.sqrt(session.width * session.height / _FIRST_PIXELS))) if is_first else 1
        arguments = mode, passes, edge_px, self._session_number
        self._thread = threading.Thread(target=self._clean, args=arguments, daemon=True)
        self._thread.start()

    def take(self) -> Any:
        """A picture of the session, (height, width, 4), that was not there before; else None."""
        result, self._result = self._result, None
        return None if result is None or result[0] != self._session_number else result[1]

    @property
    def has_result(self) -> bool:
        return self._result is not None

    @property
    def is_at_rest(self) -> bool:
        return not self._is_busy() and not self.has_result

    def _is_busy(self) -> bool:
        return self._thread is not None and self._thread.is_alive()

    def _clean(self, mode: str, passes: dict[str, Any], edge_px: int, session_number: int) -> None:
        cleaned = None
        try:
            guides = self._denoiser.guides(passes.__getitem__, edge_px)
            cleaned = self._denoiser.denoised(mode, passes.__getitem__, guides).combined
        except denoise.DenoiserError as error:
            self._is_broken = True
            print(f"Warning: Pivot: {error}", flush=True)
        self._result = session_number, cleaned
