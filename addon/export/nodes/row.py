"""What a row of the tables of nodes is: a function from a node, of which an output is asked for, to a value."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Protocol

from ..program import Program, Value


class Node(Protocol):
    """A node of which an output is asked for."""

    @property
    def node(self) -> Any:
        """Blender's."""

    @property
    def output(self) -> str:
        """The identifier of the output that is asked for."""

    @property
    def output_index(self) -> int: ...

    @property
    def program(self) -> Program: ...

    @property
    def neighbour(self) -> int:
        """Where it is evaluated: 0, or beside."""

    def has(self, *identifiers: str | int) -> bool:
        """Whether it has an input of one of these identifiers."""

    def is_linked(self, *identifiers: str | int) -> bool: ...

    def number(self, *identifiers: str | int, unknown: float | None = None) -> Value:
        """The input of the first identifier it has, as one part.

        unknown: for an input that has no nearest constant; None: its own value.
        """

    def colour(self, *identifiers: str | int) -> Value:
        """The three parts of a colour."""

    def vector(self, *identifiers: str | int) -> Value:
        """The three parts of a vector."""

    def own_value(self, identifier: str) -> float:
        """The number that an input has where nothing is linked to it."""

    def normal(self) -> Value:
        """What the Normal input is turned to, or the surface's own; world space."""

    @property
    def is_world(self) -> bool:
        """Whether it is the world that is shaded, not a surface."""

    @property
    def lamp_axes(self) -> Any:
        """The axes of a lamp's own space in world space, (3, 3); None where no lamp is shaded."""

    @property
    def material_index(self) -> int:
        """The material's pass index, 0 without one."""

    def op(self, name: str, *inputs: Value, settings: Any = (), image: Any = None) -> Value:
        """What an op of the core gives here."""

    def beside(self, neighbour: int) -> Node:
        """The same node at a place beside, along one of two directions (1, 2), a footprint away; 0: at the
        place itself."""

    def bumped(self, filter_width: float) -> tuple[Node, Node]:
        """The same node at the two places that bump mapping looks at, so many footprints away."""

    def warn(self, text: str) -> None: ...


Row = Callable[[Any], Value]
