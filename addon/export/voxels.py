"""Programs over voxels: what shader nodes make of the grids that they read, and of nothing else of a place."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from .program import Part, Program, Register, Value

Array = NDArray[np.float32]


def evaluate(program: Program, values: Sequence[Value], grids: Mapping[str, Array], count: int) -> list[Array | None]:
    """(count, parts) of each value at so many voxels, None for one that depends on more than grids.

    grids: (count, channels) by name; a grid that is not there is 0, as in Cycles.
    """
    names = {float(program.scene.attribute_id(name)): name for name in program.attributes}
    known: dict[Register, Array] = {}

    def column(part: Part) -> Array | None:
        return known.get(part) if isinstance(part, Register) else np.full(count, part, np.float32)

    for step in program.steps:
        if step.op == "attribute":
            kind, _, name = names[step.settings[0]].partition(":")
            if kind == "attribute":
                known.update(zip(step.outputs, _read(grids.get(name), count), strict=True))
        elif not step.reads_image and not program.ops[step.op][2]:
            inputs = [column(part) for part in step.inputs]
            if all(each is not None for each in inputs):
                outputs = program.core.run_op(step.op, np.stack(inputs, axis=1), list(step.settings))
                known.update(zip(step.outputs, outputs.T, strict=True))

    def together(value: Value) -> Array | None:
        columns = [column(part) for part in value.parts]
        return None if any(each is None for each in columns) else np.stack(columns, axis=1)  # type: ignore[arg-type]

    return [together(value) for value in values]


def is_of_grids(value: Value) -> bool:
    """Whether grids and numbers alone tell what it is."""
    [made] = evaluate(value.program, [value], {}, 1)
    return made is not None


def _read(grid: Array | None, count: int) -> list[Array]:
    """The five outputs of the core's op: three numbers, a fourth, and all as one. [Cycles 4.5 geom/volume.h]

    Colours with an alpha are kept multiplied by it.
    """
    zeros, ones = np.zeros(count, np.float32), np.ones(count, np.float32)
    if grid is None:
        return [zeros, zeros, zeros, zeros, zeros]
    if grid.shape[1] == 1:
        return [grid[:, 0]] * 3 + [ones, grid[:, 0]]
    rgb, alpha = grid[:, :3], grid[:, 3] if grid.shape[1] == 4 else ones
    is_scaled = (alpha > 1e-6) & (alpha != 1)
    straight = np.where(is_scaled[:, None], rgb / np.where(is_scaled, alpha, 1)[:, None], rgb)
    return [*straight.T, alpha, rgb.mean(axis=1, dtype=np.float32)]
