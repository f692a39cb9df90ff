"""What the core can shade with, as a value that shader nodes scale and add."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from .dielectric import Dielectric, as_few, at_most
from .highlight import Highlight, hue, share
from .lobe import Lobe, as_few_lobes
from .program import Program, Register, Value

_BASE = (
    "diffuse", "alpha", "conductor_f0", "conductor_f90", "conductor_weight", "dielectric_weight", "dielectric_ior",
    "dielectric_tint", "weight", "conductor_dip",
)  # fmt: skip


@dataclass(frozen=True)
class Surface:
    """A base, further lobes and emission: what a pivot_core.Shader is made of.

    The base is a Lambert lobe beneath one GGX lobe of two Fresnel parts; `weight` is the share of the surface that they
    are. further: surfaces of which the bases are mixed in. translucent: the colour of light that comes through.
    dielectrics: what of it is glass. highlights: those about axes of their own. lobes: what it has of other kinds.
    transparency: the colour of light that goes straight on; opacity: how much of a surface all else is.
    """

    diffuse: Value
    alpha: Value
    conductor_f0: Value
    conductor_f90: Value
    conductor_dip: Value
    conductor_weight: Value
    dielectric_weight: Value
    dielectric_ior: Value
    dielectric_tint: Value
    weight: Value
    emission: Value
    translucent: Value
    transparency: Value
    opacity: Value
    multiscatter: bool = False
    further: tuple[Surface, ...] = ()
    dielectrics: tuple[Dielectric, ...] = ()
    highlights: tuple[Highlight, ...] = ()
    lobes: tuple[Lobe, ...] = ()
    normal: Value | None = None  # of all lobes but highlights that have another, world space; None: the mesh's own
    normal_is_own: bool = False  # it is as displacement would turn the mesh's own
    is_holdout: bool = False  # a camera sees a hole in its place
    ndf: Any = None  # pivot_core.TabulatedNdf of all its bases; None: each has its own alpha
    tangent: Value | None = None  # which way x of the ndf and of highlights lies, world space

    @staticmethod
    def of(program: Program, **given: Any) -> Surface:
        """A surface of what is given, black for the rest."""
        black, zero, one = program.colour((0, 0, 0)), program.number(0.0), program.number(1.0)
        defaults = {
            "diffuse": black,
            "alpha": one,
            "conductor_f0": black,
            "conductor_f90": black,
            "conductor_dip": black,
            "conductor_weight": zero,
            "dielectric_weight": zero,
            "dielectric_ior": program.number(1.5),
            "dielectric_tint": program.colour((1, 1, 1)),
            "weight": one,
            "emission": black,
            "translucent": black,
            "transparency": black,
            "opacity": one,
        }
        return Surface(**(defaults | given))

    @property
    def program(self) -> Program:
        return self.diffuse.program

    def scaled(self, weight: Value) -> Surface:
        """weight: a number, or a colour, by which a dielectric is scaled at normal incidence, elsewhere by its mean."""
        part = share(weight)
        return replace(
            self,
            diffuse=self.diffuse * weight,
            conductor_f0=self.conductor_f0 * weight,
            conductor_f90=self.conductor_f90 * weight,
            conductor_dip=self.conductor_dip * weight,
            conductor_weight=self.conductor_weight * part,
            dielectric_weight=self.dielectric_weight * part,
            dielectric_tint=self.dielectric_tint * hue(weight),
            weight=self.weight * part,
            emission=self.emission * weight,
            translucent=self.translucent * weight,
            transparency=self.transparency * weight,
            opacity=self.opacity * part,
            further=tuple(surface.scaled(weight) for surface in self.further),
            dielectrics=tuple(dielectric.scaled(weight) for dielectric in self.dielectrics),
            highlights=tuple(highlight.scaled(weight) for highlight in self.highlights),
            lobes=tuple(lobe.scaled(weight) for lobe in self.lobes),
        )

    def gloss(self) -> float:
        """Roughly what the GGX lobe reflects: which of two lobes is the stronger."""
        f0 = ((_typical(self.dielectric_ior) - 1) / (_typical(self.dielectric_ior) + 1)) ** 2
        conductor = _typical(self.conductor_f0) + _typical(self.conductor_f90)
        return conductor / 2 + _typical(self.dielectric_weight) * f0

    def bases(self) -> Iterator[Surface]:
        """Those that reflect, each as a surface of nothing else."""
        if not self.diffuse.is_always(0) or self.gloss() > 0:
            black = self.program.colour((0, 0, 0))
            beside = {"further": (), "dielectrics": (), "highlights": (), "lobes": ()}
            yield replace(self, emission=black, translucent=black, transparency=black, **beside)
        yield from self.further

    def within(self, lobes: int) -> tuple[Surface, bool]:
        """The surface with so many lobes beside its base at most, and whether it is the same.

        The highlights of the weakest bases become those of the one before them, those about axes of their own first
        lobes of bases, lobes of other kinds Lambert's.
        """
        left = lobes - (not self.translucent.is_always(0))
        most = left - bool(self.dielectrics) - bool(self.highlights)
        if len(self.lobes) > most:
            diffuse = sum((lobe.as_diffuse() for lobe in self.lobes[most:]), self.diffuse)
            return replace(self, diffuse=diffuse, lobes=self.lobes[:most]).within(lobes)[0], False
        left -= len(self.lobes)
        if self.highlights and len(self.dielectrics) + len(self.highlights) > left:
            return self.without_axes(self.highlights[-1]).within(lobes)[0], False
        bases = sorted(self.bases(), key=Surface.gloss, reverse=True)
        left -= len(self.highlights)
        if len(self.dielectrics) > left:
            return replace(self, dielectrics=at_most(self.dielectrics, left)).within(lobes)[0], False
        most = 1 + left - len(self.dielectrics)
        if len(bases) <= most:
            return self, True
        last = bases[most - 1]
        for weaker in bases[most:]:
            last = _as_one(last, weaker)
        return _surface_of([*bases[: most - 1], last], self), False

    def without_axes(self, *highlights: Highlight) -> Surface:
        """The surface with some of its highlights as those of bases."""
        if not highlights:
            return self
        bases = [Surface.of(self.program, **highlight.base()) for highlight in highlights]
        rest = tuple(highlight for highlight in self.highlights if highlight not in highlights)
        return _surface_of([*self.bases(), *bases], replace(self, highlights=rest))

    def core_shader(self, core: Any) -> Any:
        """A pivot_core.Material, or a Shader where something varies over the surface."""
        first, beside, kind, table = self, self.further, "base", {}
        if self.ndf is not None:  # which the core's own base cannot have
            first, beside, kind, table = Surface.of(self.program), tuple(self.bases()), "tabulated", {"ndf": self.ndf}
        lobes = [(kind, surface._base_values(), surface._base_settings() | table) for surface in beside]
        if not self.translucent.is_always(0):
            lobes.append(("translucent", {"color": self.translucent}, {}))
        lobes += [part.lobe() for part in (*self.dielectrics, *self.highlights, *self.lobes)]
        own = first._base_values() | {"emission": self.emission}
        if not self.transparency.is_always(0):
            own |= {"transparency": self.transparency, "opacity": self.opacity}
        material = core.Material(
            **_numbers(own),
            **first._base_settings(),
            lobes=[(kind, _numbers(values) | settings) for kind, values, settings in lobes],
        )
        for place, (_, values, _) in enumerate(lobes):
            own |= {f"lobes.{place}.{name}": value for name, value in values.items()}
        varying = {name: _registers(value) for name, value in own.items() if not value.is_constant}
        if self.normal is not None:
            name = "own_normal" if self.normal_is_own else "normal"
            varying[name] = _registers(self.program.registers(self.normal))
        if self.tangent is not None and lobes:
            varying["tangent"] = _registers(self.program.registers(self.tangent))
        return core.Shader(material, self.program.program, varying) if varying else material

    def _is_light_alone(self) -> bool:
        """Whether nothing of it is turned by a normal."""
        beside = self.dielectrics or self.highlights or self.lobes
        return self.translucent.is_always(0) and not beside and not list(self.bases())

    def _base_values(self) -> dict[str, Value]:
        return {name: getattr(self, name) for name in _BASE}

    def _base_settings(self) -> dict[str, bool]:
        return {"multiscatter": self.multiscatter}


def _typical(value: Value) -> float:
    """The mean of a value's numbers, those that vary taken for 0.5."""
    return float(np.mean([0.5 if isinstance(part, Register) else part for part in value.parts]))


def _numbers(values: dict[str, Value]) -> dict[str, Any]:
    """What stands for those parts that vary must only be valid: each is replaced at every place."""
    numbers = {
        name: [1.0 if isinstance(part, Register) else part for part in value.parts] for name, value in values.items()
    }
    return {name: parts[0] if len(parts) == 1 else tuple(parts) for name, parts in numbers.items()}


def _registers(value: Value) -> list[int]:
    return [part.index if isinstance(part, Register) else -1 for part in value.parts]


def added(a: Surface, b: Surface) -> tuple[Surface, bool]:
    """The sum of two, and whether it is exact: two normals become the first, and two tangents.

    Bases of which the GGX lobes differ stay beside each other.
    """
    bases = list(a.bases())
    for base in b.bases():
        place = next((i for i, other in enumerate(bases) if _is_one(other, base)), None)
        if place is None:
            bases.append(base)
        else:
            bases[place] = _as_one(bases[place], base)
    reflecting = [surface for surface in (a, b) if not surface._is_light_alone()]
    normals = [surface.normal for surface in reflecting]
    tangents = [surface.tangent for surface in (a, b) if surface.tangent is not None]
    beside = Surface.of(
        a.program,
        emission=a.emission + b.emission,
        translucent=a.translucent + b.translucent,
        dielectrics=as_few(a.dielectrics + b.dielectrics),
        highlights=a.highlights + b.highlights,
        lobes=as_few_lobes(a.lobes + b.lobes),
        transparency=a.transparency + b.transparency,
        opacity=a.opacity + b.opacity,
        normal=next((normal for normal in normals if normal is not None), None),
        tangent=next(iter(tangents), None),
    )
    exact = (len(normals) < 2 or normals[0] == normals[1]) and (len(tangents) < 2 or tangents[0] == tangents[1])
    return _surface_of(bases, beside), exact


def _surface_of(bases: list[Surface], beside: Surface) -> Surface:
    """Bases, with all else of another surface."""
    first, *further = bases or [Surface.of(beside.program)]
    return replace(
        first,
        emission=beside.emission,
        translucent=beside.translucent,
        transparency=beside.transparency,
        opacity=beside.opacity,
        normal=beside.normal,
        normal_is_own=beside.normal_is_own,
        tangent=beside.tangent,
        further=tuple(further),
        dielectrics=beside.dielectrics,
        highlights=beside.highlights,
        lobes=beside.lobes,
    )


def _is_one(a: Surface, b: Surface) -> bool:
    """Whether the sum of two bases is a base."""
    strong, weak = (a, b) if a.gloss() >= b.gloss() else (b, a)
    same_lobe = weak.gloss() == 0 or (strong.alpha, strong.multiscatter) == (weak.alpha, weak.multiscatter)
    dense, thin = _by_dielectric(a, b)
    return same_lobe and (
        thin.dielectric_weight.is_always(0)
        or (dense.dielectric_ior, dense.dielectric_tint) == (thin.dielectric_ior, thin.dielectric_tint)
    )


def _by_dielectric(a: Surface, b: Surface) -> tuple[Surface, Surface]:
    """The one with more of a dielectric first."""
    return (a, b) if _typical(a.dielectric_weight) >= _typical(b.dielectric_weight) else (b, a)


def _as_one(a: Surface, b: Surface) -> Surface:
    """The sum of two bases as a base: where their GGX lobes differ in shape, both take the stronger one's."""
    strong = a if a.gloss() >= b.gloss() else b
    dense, _ = _by_dielectric(a, b)
    return Surface.of(
        a.program,
        diffuse=a.diffuse + b.diffuse,
        alpha=strong.alpha,
        conductor_f0=a.conductor_f0 + b.conductor_f0,
        conductor_f90=a.conductor_f90 + b.conductor_f90,
        conductor_dip=a.conductor_dip + b.conductor_dip,
        conductor_weight=a.conductor_weight + b.conductor_weight,
        dielectric_weight=a.dielectric_weight + b.dielectric_weight,
        dielectric_ior=dense.dielectric_ior,
        dielectric_tint=dense.dielectric_tint,
        multiscatter=strong.multiscatter,
        weight=a.weight + b.weight,
    )
