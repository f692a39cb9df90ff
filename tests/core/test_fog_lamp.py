"""Do samples of lamps from places in fog follow the density that they state, and the phase function?"""

from __future__ import annotations

import numpy as np
import pivot_core
import pytest
from light_cells import Array, SeenLight, count_grid, density_grid, equal_cells, flat, sphere
from scipy.stats import chi2

LIGHTS: dict[str, SeenLight] = {
    "sphere": sphere((1.0, 0.5, 2.0), 0.8),
    "rectangle": flat((-1.0, 0.8, 1.5), (0.9, 0.2, 0.0), (-0.1, 0.45, -0.3)),
    "near rectangle": flat((0.5, 0.3, 0.2), (1.0, 0.0, 0.0), (0.0, 1.0, 0.0)),
    "strip": flat((0.5, -0.3, -1.0), (-1.0, 0.2, 0.0), (0.0, 0.03, 0.01)),
    "disk": flat((0.5, -1.0, 1.8), (0.6, 0.0, 0.0), (0.0, 0.6, 0.0), ellipse=True),
    "near ellipse": flat((0.5, 0.3, 0.15), (1.0, 0.0, 0.0), (0.0, 0.7, 0.0), ellipse=True),
}
PHASES = (-0.6, 0.0, 0.5, 0.9)
TOWARDS = ("the light", "beside it")
HERE = (0.0, 0.0, 0.0)
SAMPLES, PIXELS, CELL_DEPTH = 20_000, 384, 6
SIGNIFICANCE = 1 - (1 - 0.01) ** (1 / (len(LIGHTS) * len(PHASES) * len(TOWARDS)))  # of a case, for 1 % [Sidak]


def direction_of(light: SeenLight, towards: str) -> tuple[float, float, float]:
    middle = light.directions(np.array([[0.4, 0.6]]))[0][0]
    away = np.array([0.6, -0.5, 0.3]) if towards == "beside it" else 0.0
    return tuple(middle + away)


def squares(count: int) -> Array:
    """Evenly spread, but not in rows."""
    return np.random.default_rng(5).random((count, 2))


@pytest.mark.parametrize("towards", TOWARDS)
@pytest.mark.parametrize("g", PHASES)
@pytest.mark.parametrize("name", LIGHTS)
def test_samples_follow_their_density(name: str, g: float, towards: str) -> None:
    """The batches' samples and the density that single places state: Pearson's chi^2."""
    seen = LIGHTS[name]
    vertex = (seen.light, g, HERE, direction_of(seen, towards))
    wi, pdf = pivot_core.fog_lamp_samples(*vertex, squares(SAMPLES))
    stated = pivot_core.fog_lamp_pdf(*vertex, wi)
    # At a light's rim, where an ellipse ends steeply, a direction in float says little of the place.
    assert (np.abs(pdf - stated) > 2e-3 * pdf).mean() < 1e-3
    share = density_grid(lambda w: pivot_core.fog_lamp_pdf(*vertex, w.astype(np.float32)).astype(float), seen, PIXELS)
    assert share.sum() == pytest.approx(1, abs=3e-3)
    count = count_grid(seen.places(wi.astype(float)), PIXELS)
    cells = equal_cells(share, CELL_DEPTH)
    expected = np.array([SAMPLES * share[cell].sum() for cell in cells])
    observed = np.array([count[cell].sum() for cell in cells])
    statistic = ((observed - expected) ** 2 / expected).sum()
    p = float(chi2.sf(statistic, len(cells) - 1))
    assert p > SIGNIFICANCE, f"chi^2 {statistic:.1f} over {len(cells)} cells, p = {p:.2g}"


@pytest.mark.parametrize("name", ["rectangle", "near rectangle", "strip", "disk", "near ellipse"])
def test_samples_of_area_lamps_follow_the_phase_function(name: str) -> None:
    """Relative variance of a sample: up to a fifth, where samples even by area have up to 30."""
    seen = LIGHTS[name]
    for g in (0.0, 0.5, 0.8):
        for towards in TOWARDS:
            direction = direction_of(seen, towards)
            forward = np.array(direction) / np.linalg.norm(direction)
            wi, pdf = pivot_core.fog_lamp_samples(seen.light, g, HERE, direction, squares(4096))
            mu = wi.astype(float) @ forward
            weight = (1 - g * g) / (4 * np.pi * (1 + g * g - 2 * g * mu) ** 1.5) / pdf
            assert weight.std() / weight.mean() < np.sqrt(0.2), (g, towards)
