"""Boundaries between two media as values: the core's lobes of glass, that shaders scale and add."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from typing import Any

from .highlight import share
from .program import Program, Value

_COLOURS = ("reflection", "transmission")
_VALUES = (*_COLOURS, "weight", "f0_tint", "alpha", "ior", "fresnel", "film_ior", "film_nm")


@dataclass(frozen=True)
class Dielectric:
    """Numbers of the core's lobe: core/bsdf/lobes/dielectric.h says what they are."""

    reflection: Value
    transmission: Value
    f0_tint: Value
    alpha: Value
    ior: Value
    fresnel: Value
    weight: Value
    film_ior: Value
    film_nm: Value
    multiscatter: bool = False
    beckmann: bool = False

    @staticmethod
    def of(program: Program, **given: Any) -> Dielectric:
        """A smooth one of what is given: white where nothing is, and mirroring what Fresnel says."""
        white, one = program.colour((1, 1, 1)), program.number(1.0)
        defaults = {
            "reflection": white,
            "transmission": white,
            "f0_tint": white,
            "alpha": program.number(0.0),
            "ior": program.number(1.5),
            "fresnel": one,
            "weight": one,
            "film_ior": one,
            "film_nm": program.number(0.0),
        }
        return Dielectric(**(defaults | given))

    def scaled(self, weight: Value) -> Dielectric:
        colours = {name: getattr(self, name) * weight for name in _COLOURS}
        return replace(self, **colours, weight=self.weight * share(weight))

    def lobe(self) -> tuple[str, dict[str, Value], dict[str, float]]:
        """As Surface.core_shader gives lobes to the core."""
        values = {name: getattr(self, name) for name in _VALUES}
        return "dielectric", values, {"multiscatter": float(self.multiscatter), "beckmann": float(self.beckmann)}

    def _shape(self) -> tuple[Value | bool, ...]:
        facets = (self.alpha, self.multiscatter, self.beckmann)
        return self.f0_tint, self.ior, self.fresnel, self.film_ior, self.film_nm, *facets


def as_few(dielectrics: Iterable[Dielectric]) -> tuple[Dielectric, ...]:
    """Those of one shape as one."""
    found: list[Dielectric] = []
    for each in dielectrics:
        place = next((i for i, other in enumerate(found) if other._shape() == each._shape()), None)
        if place is None:
            found.append(each)
        else:
            found[place] = _sum(found[place], each)
    return tuple(found)


def at_most(dielectrics: tuple[Dielectric, ...], most: int) -> tuple[Dielectric, ...]:
    """So many of them: the later ones take the shape of the last that stays."""
    kept = list(dielectrics[:most])
    for each in dielectrics[most:]:
        kept[-1] = _sum(kept[-1], each)
    return tuple(kept)


def _sum(a: Dielectric, b: Dielectric) -> Dielectric:
    return replace(a, **{name: getattr(a, name) + getattr(b, name) for name in (*_COLOURS, "weight")})
