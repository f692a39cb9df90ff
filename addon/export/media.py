"""Volumes as the core's media: constants, and the grids that multiply them."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..report import naming
from .baked import Interior, bake
from .context import Context
from .grids import Lattice
from .phase import pivot_of_mean_cosine
from .volume import Volume

Array = NDArray[np.float32]
_ONE_COLOUR = 1e-3  # how far apart colours may be, relative to the strongest, to be one


def core_medium(
    context: Context, volume: Volume, owner: str, interior: Interior | None = None, phase: str = "HENYEY_GREENSTEIN"
) -> Any:
    """A pivot_core.Medium, or None for a volume in which there is nothing.

    owner: how reports name it. interior: of the object that it fills, where it is not constant. phase: as the Medium
    names it.
    """
    core = context.core
    lattice = interior.lattice(volume.grid_names) if interior else None
    with naming(owner, "give the colours and numbers of its volume finite values"):
        *extinction, glow = _coefficients(context, volume, owner, interior, lattice)
        density, colours, is_one = _factored(extinction)
        if not is_one:
            context.reporter.warn(f"{owner}: the colors of its volume vary over space, they are shown as their mean")
        if not np.any(colours) and not glow.any():
            return None
        glows, is_pivot = len(glow) > 1, phase == "PIVOT"
        return core.Medium(
            scattering=[
                (tuple(colour), pivot_of_mean_cosine(lobe.mean_cosine) if is_pivot else lobe.mean_cosine, phase)
                for lobe, colour in zip(volume.lobes, colours[:-1].tolist(), strict=True)
                if any(colour)
            ],
            absorption=tuple(colours[-1].tolist()),
            emission=(1.0, 1.0, 1.0) if glows else tuple(glow[0].tolist()),
            density=None if density is None else _voxel_grid(core, density, lattice),
            emission_grid=_voxel_grid(core, glow, lattice) if glows else None,
        )


def report_analytic(context: Context, volume: Volume, owner: str) -> None:
    """Say what the analytic integrator leaves out of a volume in a world that shines."""
    is_analytic = context.depsgraph.scene_eval.pivot.integrator == "ANALYTIC"
    if is_analytic and not all(lobe.sigma_s.is_always(0) for lobe in volume.lobes):
        context.reporter.warn(
            f"{owner}: in the analytic integrator its volume scatters none of the world's light. Fix: use Monte Carlo"
        )


def _coefficients(
    context: Context, volume: Volume, owner: str, interior: Interior | None, lattice: Lattice | None
) -> list[Array]:
    """(1, 3), or (N, 3) where it varies over a lattice: sigma_s of each lobe, absorption and emission."""
    values = [*(lobe.sigma_s for lobe in volume.lobes), volume.absorption, volume.emission]
    if interior is None or lattice is None:
        scale, made = 1.0, [np.array([value.typical()], np.float32) for value in values]
    else:
        scale, made = interior.grids.density_scale, bake(context, volume.program, values, lattice, interior, owner)
        if interior.mesh is not None:  # which bounds what turns out to be the same everywhere
            made = [each[:1] if (each == each[0]).all() else each for each in made]
    return [each * np.float32(scale) for each in made]


def _factored(parts: list[Array]) -> tuple[NDArray[np.float64] | None, NDArray[np.float64], bool]:
    """What multiplies constant colours at each voxel, at most 1, and the colours (P, 3); and whether that is exact.

    Without anything that varies there is no multiplier.
    """
    if all(len(part) == 1 for part in parts):
        return None, np.concatenate(parts).astype(np.float64), True
    totals = sum(part.sum(axis=1, dtype=np.float64) for part in parts)
    most = totals.max()
    if most <= 0:
        return None, np.zeros((len(parts), 3)), True
    density = totals / most
    colours = (
        np.stack([np.broadcast_to(part, (len(density), 3)).mean(axis=0, dtype=np.float64) for part in parts])
        / density.mean()
    )
    apart = max(np.abs(part - density[:, None] * colour).max() for part, colour in zip(parts, colours, strict=True))
    return density, colours, bool(apart <= _ONE_COLOUR * most)


def _voxel_grid(core: Any, values: NDArray[Any], lattice: Lattice) -> Any:
    """values: (N,) or (N, 3), x fastest."""
    x, y, z = lattice.size
    shaped = np.ascontiguousarray(values.reshape(z, y, x, *values.shape[1:]), np.float32)
    return core.VoxelGrid(shaped, lattice.grid_from_object.astype(np.float32))
