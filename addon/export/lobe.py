"""Further lobes of the core as values, that shaders scale and add: core/bsdf/lobes/ says what their numbers are."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from typing import Any

from .program import Value

Named = tuple[tuple[str, Value], ...]


@dataclass(frozen=True)
class Lobe:
    """One kind of lobe; `shares` are those of its numbers that say how much of the surface it is."""

    kind: str
    shares: Named
    shape: Named
    settings: tuple[tuple[str, float], ...] = ()

    def scaled(self, weight: Value) -> Lobe:
        return replace(self, shares=tuple((name, value * weight) for name, value in self.shares))

    def as_diffuse(self) -> Value:
        """The colour of a Lambert lobe that stands for it."""
        return self.shares[0][1]

    def lobe(self) -> tuple[str, dict[str, Value], dict[str, Any]]:
        """As Surface.core_shader gives lobes to the core."""
        return self.kind, dict(self.shares + self.shape), dict(self.settings)

    def _is_like(self, other: Lobe) -> bool:
        return (self.kind, self.shape, self.settings) == (other.kind, other.shape, other.settings)

    def _plus(self, other: Lobe) -> Lobe:
        pairs = zip(self.shares, other.shares, strict=True)
        return replace(self, shares=tuple((name, value + more) for (name, value), (_, more) in pairs))


def as_few_lobes(lobes: Iterable[Lobe]) -> tuple[Lobe, ...]:
    """Those of one shape as one."""
    found: list[Lobe] = []
    for each in lobes:
        place = next((i for i, other in enumerate(found) if other._is_like(each)), None)
        if place is None:
            found.append(each)
        else:
            found[place] = found[place]._plus(each)
    return tuple(found)
