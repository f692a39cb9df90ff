"""Pivot and Cycles, in one Blender, agree on thin films: on plastic by both integrators, on glass by rays."""

from __future__ import annotations

import numpy as np
import pytest
from blender_host import Host
from test_cloth import FLIP, TOLERANCE, compare


def test_pictures_are_cycles(host: Host, tmp_path_factory: pytest.TempPathFactory) -> None:
    folder = tmp_path_factory.mktemp("film")
    for name in host.run("film_cases", folder):
        for integrator in ("MONTE_CARLO", "direct_ANALYTIC")[: 1 if name == "glass" else 2]:
            found = compare(folder, name, integrator)
            assert np.abs(found["mean"] - 1).max() < TOLERANCE, (name, integrator)
            assert found["flip"] < FLIP, (name, integrator)
