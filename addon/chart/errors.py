"""What a picture's error is, which settings no other beats, and which is the cheapest that is good enough."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .ladder import Rung

Floats = NDArray[np.floating]


@dataclass(frozen=True)
class Reference:
    """A converged picture (height, width, 3) and the variance it still has."""

    mean: Floats
    variance: Floats

    @classmethod
    def of_parts(cls, parts: Sequence[Floats]) -> Reference:
        return cls(np.mean(parts, 0, dtype=float), np.var(parts, 0, ddof=1, dtype=float) / len(parts))

    @property
    def noise(self) -> float:
        """relMSE of the reference itself."""
        return float((self.variance / (self.mean**2 + 0.01)).mean())

    def rel_mse(self, image: Floats) -> float:
        """mean((I - R)^2 / (R^2 + 0.01)), the reference's noise subtracted; no less than that noise, below which a
        difference says nothing."""
        errors = ((image - self.mean) ** 2 - self.variance) / (self.mean**2 + 0.01)
        return max(float(errors.mean()), self.noise)


@dataclass(frozen=True)
class Row:
    """A picture that was made: CPU seconds of its render at the chart's size, and its error."""

    rung: Rung
    cpu_s: float
    rel_mse: float
    file: str  # .npz of the picture

    @property
    def error_percent(self) -> float:
        """The root of relMSE: what is held against the error budget."""
        return 100 * math.sqrt(self.rel_mse)


def pareto_front(rows: Sequence[Row]) -> list[Row]:
    """Those that nothing cheaper is as accurate as, by cost."""
    front: list[Row] = []
    for row in sorted(rows, key=lambda row: (row.cpu_s, row.rel_mse)):
        if not front or row.rel_mse < front[-1].rel_mse:
            front.append(row)
    return front


def cheapest_within(rows: Sequence[Row], budget_percent: float) -> Row | None:
    """Of Pivot's settings; None where none is accurate enough."""
    good = [row for row in rows if row.rung.renderer == "PIVOT" and row.error_percent <= budget_percent]
    return min(good, key=lambda row: row.cpu_s, default=None)
