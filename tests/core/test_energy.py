"""The light sampling modes give one energy, at the edge of what floats hold: every scene of the stability table."""

from __future__ import annotations

import functools
import itertools

import numpy as np
import pytest
from scipy.stats import ttest_ind

from tests.core.stability_scenes import SCENES, EdgeScene

MODES = ("SPTD", "MIS", "LIGHT", "BSDF")  # each against JOINT
SEEDS, SAMPLES = 12, 128
CANNOT = {
    ("light of 1e-5 m", "BSDF"): "one BSDF sample in 10^10 meets it",
    ("mirror, alpha 1e-3", "LIGHT"): "one light sample in 10^5 lies in the lobe",
}
CASES = [(scene, mode) for scene, mode in itertools.product(SCENES, MODES) if (scene.name, mode) not in CANNOT]
SIGNIFICANCE = 1 - (1 - 0.01) ** (1 / len(CASES))  # of one case, for 1 % over all [Sidak]


@functools.cache
def energies(scene: EdgeScene, mode: str) -> tuple[float, ...]:
    """The mean of the picture, of each seed."""
    first = 1000 * (1 + ("JOINT", *MODES).index(mode))
    seeds = range(first, first + SEEDS)
    return tuple(float(scene.render(light_sampling=mode, samples=SAMPLES, seed=s).mean()) for s in seeds)


@pytest.mark.parametrize(("scene", "mode"), CASES, ids=lambda value: getattr(value, "name", value).replace(" ", "-"))
def test_modes_have_one_energy(scene: EdgeScene, mode: str) -> None:
    joint, other = (np.array(energies(scene, name)) for name in ("JOINT", mode))
    assert joint.mean() > 0
    if abs(joint.mean() / other.mean() - 1) < 1e-5:  # where neither has noise, rounding is left
        return
    test = ttest_ind(joint, other, equal_var=False)
    described = f"JOINT {joint.mean():.6g} +- {joint.std():.1g}, {mode} {other.mean():.6g} +- {other.std():.1g}"
    assert test.pvalue > SIGNIFICANCE, f"{described}, p = {test.pvalue:.2g}"
