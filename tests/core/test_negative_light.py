"""Negative light is subtracted: two lamps' worth less one is one lamp's, whatever way light is found."""

from __future__ import annotations

import numpy as np
import pivot_core
import pytest

from tests.core.scenes import Floats, add_plane, add_sphere, place, render, set_camera


def make(kind: str, strengths: tuple[float, ...]) -> pivot_core.Scene:
    """A ball on a floor under lights of one place and kind."""
    scene = pivot_core.Scene()
    emission = strengths if kind == "emission" else (0.0,)
    surface = pivot_core.Material(
        diffuse=(0.5, 0.5, 0.5), alpha=0.3, dielectric_weight=1.0, emission=(sum(emission),) * 3
    )
    material = scene.add_material("m", surface)
    scene.add_instances("floor", add_plane(scene), place(), [material])
    scene.add_instances("ball", add_sphere(scene), place(0, 0, 0.5, 0.5), [material])
    for strength in strengths:
        values = (strength,) * 3
        if kind == "sphere":
            scene.add_light("sphere", pivot_core.SphereLight((1, -1, 2), 0.3, values))
        elif kind == "spot":
            scene.add_light("spot", pivot_core.SpotLight((0, 0, 3), 0.3, values, (0, 0, -1), 0.8, 0.5))
        elif kind == "sun":
            scene.add_light("sun", pivot_core.SunLight((0, 0.6, 0.8), 0.2, values))
        elif kind == "area":
            scene.add_light("area", pivot_core.AreaLight((0, 0, 2), (0, 0.5, 0), (0.5, 0, 0), values))
    if kind in ("world", "emission"):
        scene.set_world((sum(strengths) if kind == "world" else 1.0,) * 3)
    set_camera(scene, (0, -5, 3), size=(24, 18))
    return scene


def mean(picture: Floats) -> float:
    return float(np.mean(picture[..., :3], dtype=float))


@pytest.mark.parametrize("settings", [{"light_sampling": m} for m in ("JOINT", "SPTD", "MIS", "LIGHT")], ids=str)
@pytest.mark.parametrize("kind", ["sphere", "spot", "sun", "area"])
def test_two_lamps_less_one_are_one(kind: str, settings: dict[str, str]) -> None:
    one = mean(render(make(kind, (3.0,)), samples=64, **settings))
    assert one > 0.01
    np.testing.assert_allclose(mean(render(make(kind, (6.0, -3.0)), samples=64, **settings)), one, rtol=0.02)


@pytest.mark.parametrize("kind", ["sphere", "spot", "sun", "area"])
def test_the_analytic_integrator_subtracts_too(kind: str) -> None:
    settings = {"integrator": "ANALYTIC", "samples": 4}
    one = mean(render(make(kind, (3.0,)), **settings))
    np.testing.assert_allclose(mean(render(make(kind, (6.0, -3.0)), **settings)), one, rtol=0.01)


@pytest.mark.parametrize("integrator", ["MONTE_CARLO", "ANALYTIC"])
@pytest.mark.parametrize("kind", ["world", "emission"])
def test_a_negative_world_or_surface_darkens(kind: str, integrator: str) -> None:
    settings = {"integrator": integrator, "samples": 16}
    negative, none, positive = (mean(render(make(kind, (s,)), **settings)) for s in (-0.5, 0.0, 0.5))
    np.testing.assert_allclose(none - negative, positive - none, rtol=0.01)
    assert positive - none > 0.1


def test_twenty_lights_of_both_signs_chosen_from() -> None:
    """Where lights are drawn from many, a negative one counts by its size."""

    def scene(strengths: list[float]) -> pivot_core.Scene:
        made = make("sphere", ())
        for i, strength in enumerate(strengths):
            made.add_light(f"{i}", pivot_core.SphereLight((np.cos(i), np.sin(i), 2), 0.2, (strength,) * 3))
        return made

    half = [1.0 + 0.1 * i for i in range(20)]
    of_both_signs = mean(render(scene([(-s if i % 3 == 0 else s) for i, s in enumerate(half)]), samples=256))
    apart = [
        mean(render(scene([s if keep(i) else 0.0 for i, s in enumerate(half)]), samples=256))
        for keep in (lambda i: i % 3 != 0, lambda i: i % 3 == 0)
    ]
    np.testing.assert_allclose(of_both_signs, apart[0] - apart[1], rtol=0.02)
