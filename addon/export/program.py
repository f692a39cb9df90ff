"""Programs as they are written: values that are numbers, or registers of the core's program for a shader.

What an op makes of numbers alone is computed at once, by the core itself; the same op of the same inputs is one step.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from types import ModuleType
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from .colour_space import LUMINANCE
from .images import ImageTable


class UnknownOp(LookupError):
    """The core has no op of this name."""


class Register(NamedTuple):
    index: int


Part = float | Register


@dataclass(frozen=True)
class Value:
    """A number, or a colour or vector: one part or three, each a number or a register."""

    parts: tuple[Part, ...]
    program: Program = field(compare=False, repr=False)

    @property
    def is_constant(self) -> bool:
        return not any(isinstance(part, Register) for part in self.parts)

    def is_always(self, number: float) -> bool:
        """Whether every part surely has this value."""
        # A register is a tuple, which NumPy would compare by its index.
        return self.is_constant and all(part == np.float32(number) for part in self.parts)

    @property
    def numbers(self) -> list[float]:
        """Of a value that is constant."""
        return [float(part) for part in self.parts if not isinstance(part, Register)]

    def typical(self) -> NDArray[np.float64]:
        """The numbers of its parts: of those that vary, what they are nowhere in particular."""
        registers = self.program.program.run_nowhere()
        return np.array([registers[part.index] if isinstance(part, Register) else part for part in self.parts], float)

    def __getitem__(self, part: int | slice) -> Value:
        chosen = self.parts[part]
        return Value(chosen if isinstance(part, slice) else (chosen,), self.program)  # type: ignore[arg-type]

    def widened(self) -> Value:
        """Three parts of one."""
        return self if len(self.parts) == 3 else Value(self.parts * 3, self.program)

    def _with(self, op: str, other: Value | float) -> Value:
        return self.program.each(op, self, other)

    def __add__(self, other: Value | float) -> Value:
        if _is_always(other, 0) or self.is_always(0):
            return _as_wide(self if _is_always(other, 0) else other, self, other)
        return self._with("math_add", other)

    def __sub__(self, other: Value | float) -> Value:
        return self._with("math_subtract", other)

    def __mul__(self, other: Value | float) -> Value:
        """What is always 0 stays so, whatever it is multiplied with."""
        for part, rest in ((self, other), (other, self)):
            if _is_always(part, 0):
                return _as_wide(part, self, other)
            if _is_always(part, 1):
                return _as_wide(rest, self, other)
        return self._with("math_multiply", other)

    def __truediv__(self, other: Value | float) -> Value:
        return self._with("math_divide", other)

    __radd__ = __add__
    __rmul__ = __mul__

    def __rsub__(self, other: float) -> Value:
        return self.program.each("math_subtract", other, self)

    def __rtruediv__(self, other: float) -> Value:
        return self.program.each("math_divide", other, self)

    def at_least(self, bound: Value | float) -> Value:
        return self._with("math_maximum", bound)

    def at_most(self, bound: Value | float) -> Value:
        return self._with("math_minimum", bound)

    def clamped(self) -> Value:
        """Within 0..1."""
        return self.program.each("math_clamp01", self)

    def root(self) -> Value:
        return self.program.each("math_sqrt", self)

    def luminance(self) -> Value:
        return self.program.op("vector_dot_product", self, self.program.colour(LUMINANCE))

    def mean(self) -> Value:
        return self.program.op("mean", self)


def _is_always(value: Value | float, number: float) -> bool:
    return value.is_always(number) if isinstance(value, Value) else value == number


def _as_wide(value: Value | float, a: Value, b: Value | float) -> Value:
    """A value with as many parts as an operation of a and b has."""
    whole = value if isinstance(value, Value) else a.program.number(value)
    width = max(len(operand.parts) for operand in (a, b) if isinstance(operand, Value))
    return whole if len(whole.parts) == width else whole.widened()


class Program:
    """A core's program being written, for one material or world."""

    def __init__(self, core: ModuleType, scene: Any, images: ImageTable) -> None:
        self.core: Any = core
        self.scene = scene
        self.images = images
        self.program = core.Program()
        self.attributes: set[str] = set()  # that the meshes of this material must have
        self.ops: dict[str, tuple[int, int, bool]] = core.ops()
        self._results: dict[Any, tuple[Part, ...]] = {}  # of ops, by all that they depend on

    def number(self, number: float) -> Value:
        return Value((float(np.float32(number)),), self)

    def colour(self, colour: Sequence[float] | np.ndarray) -> Value:
        """A colour or a vector."""
        return Value(tuple(float(np.float32(part)) for part in colour), self)

    def joined(self, *parts: Value) -> Value:
        """The parts of several values as those of one."""
        return Value(tuple(part for value in parts for part in value.parts), self)

    def _signature(self, name: str) -> tuple[int, int, bool]:
        if name not in self.ops:
            raise UnknownOp(name)
        return self.ops[name]

    def input_count(self, name: str) -> int:
        """How many numbers an op takes. Raises UnknownOp."""
        return self._signature(name)[0]

    def op(
        self,
        name: str,
        *inputs: Value,
        settings: Sequence[float] = (),
        image: Any = None,
        neighbour: int = 0,
    ) -> Value:
        """What an op gives: as many parts as it has outputs. Raises UnknownOp."""
        input_count, output_count, reads_place = self._signature(name)
        parts = [part for value in inputs for part in value.parts]
        if len(parts) != input_count:
            raise ValueError(f"op {name} takes {input_count} numbers, not {len(parts)}")
        settings = tuple(float(setting) for setting in settings)
        neighbour = neighbour if reads_place else 0
        key = (name, tuple(parts), settings, id(image), neighbour)
        if key not in self._results:
            if image is None and not reads_place and not any(isinstance(part, Register) for part in parts):
                result = self.core.run_op(name, np.array([parts], np.float32), list(settings))[0]
                self._results[key] = tuple(float(part) for part in result)
            else:
                numbers = [(part.index, 0.0) if isinstance(part, Register) else (-1, part) for part in parts]
                extra = {} if image is None else {"image": image}
                first = self.program.add(name, numbers, list(settings), neighbour, **extra)
                self._results[key] = tuple(Register(first + i) for i in range(output_count))
        return Value(self._results[key], self)

    def each(self, name: str, *inputs: Value | float) -> Value:
        """An op of numbers on each part of its inputs; one part stands for three."""
        values = [self.number(value) if isinstance(value, int | float) else value for value in inputs]
        width = max(len(value.parts) for value in values)
        wide = [value.widened() if width == 3 else value for value in values]
        parts = [self.op(name, *(value[i] for value in wide)).parts[0] for i in range(width)]
        return Value(tuple(parts), self)

    def mixed(self, factor: Value | float, a: Value, b: Value) -> Value:
        return self.each("mix", factor, a, b)

    def registers(self, value: Value) -> Value:
        """The same with every part in a register: a number is 0 times what varies, plus itself."""
        somewhere, zero = self.op("position")[0], self.number(0)

        def in_register(part: Part) -> Part:
            if isinstance(part, Register):
                return part
            return self.op("math_multiply_add", somewhere, zero, self.number(part)).parts[0]

        return Value(tuple(map(in_register, value.parts)), self)

    def attribute_id(self, name: str) -> float:
        """The core's number for a mesh's attribute, which the meshes of this material must then have."""
        self.attributes.add(name)
        return float(self.scene.attribute_id(name))
