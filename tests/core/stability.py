"""float32 against float64 on the way to a limit: rows of the stability table, tests and print-out alike.

A sweep evaluates one function at points that walk to a limit, twice at the very same inputs: rounded to float32 they
are given as float32, and as float64. What differs is the arithmetic alone.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

RELATIVE = 1e-4  # what the project promises


@dataclass(frozen=True)
class Sweep:
    """`inputs(t)` are the function's arguments at a point t of the walk. The bound is on the relative error, `why` if
    it is looser than RELATIVE. `scale` replaces the value that the error is relative to."""

    name: str
    function: Callable[..., Any]
    limit: str
    walk: Sequence[float]
    inputs: Callable[[float], tuple[Any, ...]]
    bound: float = RELATIVE
    why: str = ""
    scale: Callable[[float], float] | None = None

    def error(self, t: float) -> float:
        """Relative error of float32 at t; infinite if either result is not finite."""
        single = [x if isinstance(x, str) else np.asarray(x, np.float32) for x in self.inputs(t)]
        double = [x if isinstance(x, str) else x.astype(np.float64) for x in single]
        actual, expected = as_vector(self.function(*single)), as_vector(self.function(*double))
        if not (np.isfinite(actual).all() and np.isfinite(expected).all()):
            return np.inf
        size = np.linalg.norm(expected) if self.scale is None else self.scale(t)
        difference = float(np.linalg.norm(actual - expected))
        return difference / size if size > 0 else difference

    def worst(self) -> tuple[float, float]:
        """(error, t) where it is worst."""
        return max((self.error(t), t) for t in self.walk)


def as_vector(value: Any) -> np.ndarray:
    """One result or a tuple of them, end to end in float64."""
    parts = value if isinstance(value, tuple) else (value,)
    return np.concatenate([np.atleast_1d(np.asarray(part, np.float64)).ravel() for part in parts])


def print_table(sweeps: Sequence[Sweep]) -> None:
    print(f"{'function':34s} {'limit':34s} {'worst':>8s} {'bound':>8s}  at")
    for sweep in sweeps:
        error, t = sweep.worst()
        print(f"{sweep.name:34s} {sweep.limit:34s} {error:8.1e} {sweep.bound:8.1e}  {t:.3g}  {sweep.why}")
