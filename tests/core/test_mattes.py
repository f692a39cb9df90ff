"""Mattes rank what a pixel sees by the share that it has."""

from __future__ import annotations

import numpy as np
import pivot_core
import pytest
from scenes import add_plane, place, set_camera

GROUND, LID = (1.5, 3.5), (2.5, 3.5)  # ids of objects and their common asset
CHALK = 7.0


def mattes(kind: str, rank: int = 0, **settings: object) -> np.ndarray:
    """From above: a ground, and half before it a lid of which two thirds are to be seen."""
    scene = pivot_core.Scene()
    chalk = scene.add_material("chalk", pivot_core.Material(diffuse=(0.5, 0.5, 0.5)), matte=CHALK)
    veil = pivot_core.Material(diffuse=(0.3, 0.3, 0.3), transparency=(1 / 3, 1 / 3, 1 / 3))
    scene.add_instances("ground", add_plane(scene, 1), place(), [chalk], matte=GROUND)
    scene.add_instances("lid", add_plane(scene, 1), place(x=1, z=1), [scene.add_material("veil", veil)], matte=LID)
    set_camera(scene, (0, 0.001, 100), size=(16, 16), half_width=0.018)
    session = pivot_core.Session(scene, pivot_core.RenderSettings(mattes=True, **settings))
    session.start()
    while not session.wait(10.0):
        pass
    return np.array(session.read_mattes(kind, rank))


@pytest.mark.parametrize("settings", [{}, {"integrator": "ANALYTIC"}, {"adaptive": True, "samples": 128}])
def test_ids_and_shares(settings: dict) -> None:
    objects = mattes("OBJECT", **{"samples": 4} | settings)
    np.testing.assert_allclose(objects[8, 5], (GROUND[0], 1, 0, 0), atol=1e-4)
    np.testing.assert_allclose(objects[8, 10], (LID[0], 2 / 3, GROUND[0], 1 / 3), atol=1e-4)
    assert not mattes("OBJECT", rank=2, **{"samples": 4} | settings)[8, 10].any()


def test_what_has_an_id_in_common_adds_up() -> None:
    np.testing.assert_allclose(mattes("ASSET", samples=4)[8, 10], (GROUND[1], 1, 0, 0), atol=1e-4)
    np.testing.assert_allclose(mattes("MATERIAL", samples=4)[8, 5], (CHALK, 1, 0, 0), atol=1e-4)


def test_mattes_are_to_be_asked_for() -> None:
    scene = pivot_core.Scene()
    set_camera(scene, (0, 0, 5))
    session = pivot_core.Session(scene, pivot_core.RenderSettings(samples=1))
    with pytest.raises(ValueError, match="render with mattes"):
        session.read_mattes("OBJECT", 0)
