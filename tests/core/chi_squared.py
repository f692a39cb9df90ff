"""Do samples follow their density? Pearson's chi^2 over cells of the sphere, for the tests of every sampler."""

from collections.abc import Callable

import numpy as np
import numpy.typing as npt
from scipy.stats import chi2

Array = npt.NDArray[np.float64]
QUADRATURE = 12  # Gauss points across a cell, either way


def random_squares(count: int, seed: int = 1) -> Array:
    """Random numbers (count, 2) in [0, 1)."""
    return np.random.default_rng(seed).random((count, 2))


def frame_around(axis: Array) -> Array:
    """An orthonormal frame, its columns x, y and the axis."""
    helper = np.eye(3)[np.argmin(np.abs(axis))]
    x = np.cross(helper, axis)
    x /= np.linalg.norm(x)
    return np.stack([x, np.cross(axis, x), axis], -1)


def expected_share(pdf: Callable[[Array], Array], axis: Array, versine_edges: Array, azimuths: int) -> Array:
    """The integral of the density over each cell (rings, azimuths), by Gauss-Legendre."""
    x, w = np.polynomial.legendre.leggauss(QUADRATURE)
    x, w = (1 + x) / 2, w / 2
    low, width = versine_edges[:-1, None], np.diff(versine_edges)[:, None]
    versine, ring_weight = (low + width * x).ravel(), (width * w).ravel()
    phi = ((np.arange(azimuths)[:, None] + x) * 2 * np.pi / azimuths).ravel()
    phi_weight = np.tile(w * 2 * np.pi / azimuths, azimuths)
    radius = np.sqrt(versine * (2 - versine))[:, None]
    local = np.stack(np.broadcast_arrays(radius * np.cos(phi), radius * np.sin(phi), 1 - versine[:, None]), -1)
    density = pdf(local @ frame_around(axis).T) * ring_weight[:, None] * phi_weight
    return density.reshape(len(low), QUADRATURE, azimuths, QUADRATURE).sum((1, 3))


def chi_squared_p(
    samples: Array, pdf: Callable[[Array], Array], axis: Array, versine_edges: Array, azimuths: int = 24
) -> float:
    """The probability of a misfit at least as large, were the samples drawn from the density; its integral must be 1.

    Cells are rings around the axis between `versine_edges` (1 - cos, from 0 to 2), cut into equal azimuths. Those that
    expect fewer than five samples count as one.
    """
    share = expected_share(pdf, axis, versine_edges, azimuths)
    assert abs(share.sum() - 1) < 1e-3, f"the density integrates to {share.sum()}"
    local = samples @ frame_around(axis)
    versine = np.clip(1 - local[:, 2], 0, 2)
    phi = np.arctan2(local[:, 1], local[:, 0]) % (2 * np.pi)
    edges = (versine_edges, np.linspace(0, 2 * np.pi, azimuths + 1))
    observed = np.histogram2d(versine, phi, edges)[0].ravel()
    expected = share.ravel() * len(samples)
    rare = expected < 5
    observed = np.append(observed[~rare], observed[rare].sum())
    expected = np.append(expected[~rare], expected[rare].sum())
    keep = expected > 0
    assert observed[~keep].sum() == 0, "samples where the density is 0"
    statistic = ((observed[keep] - expected[keep]) ** 2 / expected[keep]).sum()
    return float(chi2.sf(statistic, keep.sum() - 1))
