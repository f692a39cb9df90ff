"""Shader nodes as fog: what is linked to the Volume of an output. [C] is Cycles 4.5 kernel/svm/closure.h."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import bpy

from .nodes import Owner, Socket, colour, is_linked, number, output_socket, source
from .phase import bounded, draine_mean_cosine, henyey_greenstein_of_backscatter, mie_lobes
from .program import Program, Value

_HasGrid = Callable[[str], bool]


@dataclass(frozen=True)
class Lobe:
    sigma_s: Value  # 1/m
    mean_cosine: float


@dataclass(frozen=True)
class Volume:
    """What a pivot_core.Medium is made of. Values are numbers, or what a program makes of grids and places."""

    lobes: tuple[Lobe, ...]
    absorption: Value  # 1/m
    emission: Value  # radiance per m

    @staticmethod
    def of(program: Program, *lobes: Lobe, absorption: Value | None = None, emission: Value | None = None) -> Volume:
        """A volume of what is given, black for the rest."""
        black = program.colour((0, 0, 0))
        return Volume(lobes, black if absorption is None else absorption, black if emission is None else emission)

    @property
    def program(self) -> Program:
        return self.absorption.program

    @property
    def is_constant(self) -> bool:
        """Whether it is the same everywhere, and in all objects."""
        values = (*(lobe.sigma_s for lobe in self.lobes), self.absorption, self.emission)
        return all(value.is_constant for value in values)

    @property
    def grid_names(self) -> frozenset[str]:
        """Of the grids that the program reads."""
        return frozenset(name.partition(":")[2] for name in self.program.attributes if name.startswith("attribute:"))

    def scaled(self, weight: Value) -> Volume:
        return Volume(
            tuple(replace(lobe, sigma_s=lobe.sigma_s * weight) for lobe in self.lobes),
            self.absorption * weight,
            self.emission * weight,
        )

    def __add__(self, other: Volume) -> Volume:
        """Lobes of one mean cosine are one."""
        lobes: dict[float, Lobe] = {}
        for lobe in self.lobes + other.lobes:
            same = lobes.get(lobe.mean_cosine)
            lobes[lobe.mean_cosine] = replace(lobe, sigma_s=same.sigma_s + lobe.sigma_s) if same else lobe
        return Volume(tuple(lobes.values()), self.absorption + other.absorption, self.emission + other.emission)


def output_volume(tree: bpy.types.NodeTree) -> Socket | None:
    """The Volume input of the tree's active output, None without one or where nothing is linked to it."""
    target = output_socket(tree, "Volume")
    return target if target is not None and is_linked(target) else None


def node_volume(target: Socket, owner: Owner, has_grid: _HasGrid = lambda _: False) -> Volume:
    """What the nodes at a Volume input stand for. has_grid: whether the object has a grid of this name."""
    try:
        return _volume(target, _Reader(owner, has_grid))
    except RecursionError:
        owner.reporter.warn(f"{owner.name}: the nodes of its volume form a loop, it has none")
        return Volume.of(owner.program)


def default_volume(program: Program) -> Volume:
    """Cycles' for Volume objects without a material: a Principled Volume as it is when added."""
    half = grid_value(program, "density")[4].at_least(0.0).widened() * 0.5
    return Volume.of(program, Lobe(half, 0.0), absorption=half)


def grid_value(program: Program, name: str) -> Value:
    """A grid's three numbers, alpha, and all as one."""
    return program.op("attribute", settings=[program.attribute_id(f"attribute:{name}"), 1.0])


@dataclass(frozen=True)
class _Reader:
    owner: Owner
    has_grid: _HasGrid

    @property
    def program(self) -> Program:
        return self.owner.program

    def number(self, feed: Socket, name: str | int) -> Value:
        target = feed.input(name)
        return self._settled(number(target, self.owner), feed, target)

    def colour(self, feed: Socket, name: str) -> Value:
        target = feed.input(name)
        return self._settled(colour(target, self.owner), feed, target)

    def constant(self, feed: Socket, name: str) -> float:
        target = feed.input(name)
        value = number(target, self.owner)
        return (value if value.is_constant else self._mean(value, feed, target)).numbers[0]

    def grid(self, feed: Socket, name: str) -> Value | None:
        """The grid that an input of Principled Volume names, None where the object has none of this name."""
        grid = feed.input(name).socket.default_value
        return grid_value(self.program, grid) if grid and self.has_grid(grid) else None

    def warn(self, feed: Socket, text: str) -> None:
        self.owner.warn(feed.node, text)

    def _settled(self, value: Value, feed: Socket, target: Socket) -> Value:
        """A world has no bounds within which to know what varies."""
        is_world = isinstance(self.owner.data, bpy.types.World)
        return self._mean(value, feed, target) if is_world and not value.is_constant else value

    def _mean(self, value: Value, feed: Socket, target: Socket) -> Value:
        self.warn(feed, f"{target.socket.name} varies over space, it is shown as its mean")
        return self.program.colour(value.typical())


def _volume(target: Socket, reader: _Reader) -> Volume:
    feed = source(target)
    if feed is None or not feed.socket.is_output:
        return Volume.of(reader.program)
    evaluate = _VOLUMES.get(feed.node.type)
    if evaluate is None:
        reader.warn(feed, f"{feed.node.bl_label} is not supported in a volume, it is left out")
        return Volume.of(reader.program)
    return evaluate(feed, reader)


def _mix(feed: Socket, reader: _Reader) -> Volume:
    factor = reader.number(feed, 0).clamped()
    parts = [(1.0 - factor, feed.input(1)), (factor, feed.input(2))]
    shares = [_volume(target, reader).scaled(weight) for weight, target in parts if not weight.is_always(0)]
    return sum(shares[1:], start=shares[0])


def _add(feed: Socket, reader: _Reader) -> Volume:
    return _volume(feed.input(0), reader) + _volume(feed.input(1), reader)


def _scatter(feed: Socket, reader: _Reader) -> Volume:
    sigma_s = reader.colour(feed, "Color") * reader.number(feed, "Density").at_least(0.0)
    return Volume.of(reader.program, *_lobes(feed, reader, sigma_s))


def _absorption(feed: Socket, reader: _Reader) -> Volume:
    share = 1.0 - reader.colour(feed, "Color")
    if share.is_constant and min(share.numbers) < 0:
        reader.warn(feed, "a Color above 1 is not supported, it absorbs nothing")
    density = reader.number(feed, "Density").at_least(0.0)
    return Volume.of(reader.program, absorption=share.at_least(0.0) * density)


def _coefficients(feed: Socket, reader: _Reader) -> Volume:
    scattered, absorbed, emitted = (
        reader.colour(feed, f"{name} Coefficients") for name in ("Scatter", "Absorption", "Emission")
    )
    return Volume.of(
        reader.program, *_lobes(feed, reader, scattered), absorption=absorbed.at_least(0.0), emission=emitted
    )


def _emission(feed: Socket, reader: _Reader) -> Volume:
    return Volume.of(reader.program, emission=reader.colour(feed, "Color") * reader.number(feed, "Strength"))


def _principled(feed: Socket, reader: _Reader) -> Volume:
    """[C] svm_node_principled_volume"""
    density = reader.number(feed, "Density").at_least(0.0)
    density_grid = reader.grid(feed, "Density Attribute")
    if density_grid is not None:
        density = (density * density_grid[4]).at_least(0.0)
    color = reader.colour(feed, "Color")
    color_grid = reader.grid(feed, "Color Attribute")
    if color_grid is not None:
        color = color * color_grid[:3]
    transmitted = reader.colour(feed, "Absorption Color").at_least(0.0).root()
    absorbed = (1.0 - color).at_least(0.0) * (1.0 - transmitted).at_least(0.0)
    lobe = Lobe((color * density).at_least(0.0), bounded(reader.constant(feed, "Anisotropy")))
    strength = reader.number(feed, "Emission Strength").at_least(0.0)
    glow = reader.colour(feed, "Emission Color") * strength
    return Volume.of(reader.program, lobe, absorption=absorbed * density, emission=glow + _blackbody(feed, reader))


def _blackbody(feed: Socket, reader: _Reader) -> Value:
    """What glows by its temperature, by Stefan and Boltzmann's law in part. [C]"""
    program = reader.program
    share = reader.number(feed, "Blackbody Intensity")
    if share.is_constant and share.numbers[0] <= 0:
        return program.colour((0, 0, 0))
    temperature = reader.number(feed, "Temperature")
    grid = reader.grid(feed, "Temperature Attribute")
    if grid is not None:
        temperature = temperature * grid[4].at_least(0.0)
    temperature = temperature.at_least(0.0)
    squared = temperature * temperature
    law = program.mixed(share, program.number(1.0), squared * squared) * (5.670373e-14 / math.pi)
    is_on = program.each("math_greater_than", share, 0.0)
    return reader.colour(feed, "Blackbody Tint") * program.op("blackbody", temperature) * (law * is_on)


def _lobes(feed: Socket, reader: _Reader, sigma_s: Value) -> list[Lobe]:
    """How a node scatters by its phase function, which Blender before 4.3 has no choice of."""
    sigma_s = sigma_s.at_least(0.0)
    phase = getattr(feed.node, "phase", "HENYEY_GREENSTEIN")
    if phase != "HENYEY_GREENSTEIN":
        name = feed.node.bl_rna.properties["phase"].enum_items[phase].name
        reader.warn(feed, f"Phase {name} is not supported, it is shown as Henyey-Greenstein")
    if phase == "MIE":
        return [Lobe(sigma_s * share, bounded(g)) for share, g in mie_lobes(reader.constant(feed, "Diameter"))]
    return [Lobe(sigma_s, bounded(_mean_cosine(phase, feed, reader)))]


def _mean_cosine(phase: str, feed: Socket, reader: _Reader) -> float:
    if phase == "RAYLEIGH":
        return 0.0
    if phase == "FOURNIER_FORAND":
        return henyey_greenstein_of_backscatter(abs(reader.constant(feed, "Backscatter")))
    g = reader.constant(feed, "Anisotropy")
    return draine_mean_cosine(g, reader.constant(feed, "Alpha")) if phase == "DRAINE" else g


_VOLUMES: dict[str, Callable[[Socket, _Reader], Volume]] = {
    "VOLUME_SCATTER": _scatter,
    "VOLUME_ABSORPTION": _absorption,
    "VOLUME_COEFFICIENTS": _coefficients,
    "PRINCIPLED_VOLUME": _principled,
    "EMISSION": _emission,
    "MIX_SHADER": _mix,
    "ADD_SHADER": _add,
}
