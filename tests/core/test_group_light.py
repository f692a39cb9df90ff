"""What light groups hold sums to what a picture shows, whatever shines, and changes nothing of it."""

from __future__ import annotations

import numpy as np
import pivot_core
import pytest
from scenes import Floats, add_plane, add_sphere, place, set_camera

GROUPS = 5


def room(is_foggy: bool, has_veil: bool) -> pivot_core.Scene:
    """Lamps, a panel, a panel by a program, fog that glows and a world, each of a group."""
    scene = pivot_core.Scene()
    chalk = scene.add_material("chalk", pivot_core.Material(diffuse=(0.6, 0.5, 0.4)))
    shiny = scene.add_material("shiny", pivot_core.Material(dielectric_weight=1.0, alpha=0.1, diffuse=(0.2, 0.4, 0.6)))
    glow = scene.add_material("glow", pivot_core.Material(emission=(3, 2, 1)))
    program = pivot_core.Program()
    first = program.add("position", [], [])
    varying = pivot_core.Shader(pivot_core.Material(), program, {"emission": [first, first, first]})
    uneven = scene.add_material("uneven", varying)
    scene.add_instances("ground", add_plane(scene, 4), place(), [chalk])
    scene.add_instances("ball", add_sphere(scene, 24), place(-1, 0, 1), [shiny])
    scene.add_instances("panel", add_plane(scene, 0.5), place(1, 1, 0.8), [glow], light_group=1)
    scene.add_instances("uneven panel", add_plane(scene, 0.5), place(2, 0, 1.5), [uneven], light_group=2)
    if has_veil:
        veil = pivot_core.Material(diffuse=(0.3, 0.3, 0.3), transparency=(0.5, 0.5, 0.5), opacity=0.5)
        scene.add_instances("veil", add_plane(scene, 0.7), place(1, -1, 1), [scene.add_material("veil", veil)])
    scene.add_light("lamp", pivot_core.SphereLight((1, -2, 4), 0.3, (20, 20, 20)), light_group=0)
    scene.add_light("second", pivot_core.SphereLight((-2, -2, 3), 0.3, (9, 3, 3)), light_group=4)
    scene.set_world((0.3, 0.3, 0.4))
    scene.set_world_light_group(3)
    if is_foggy:
        medium = pivot_core.Medium(
            scattering=[((0.05, 0.05, 0.05), 0.3, "HENYEY_GREENSTEIN")], emission=(0.01, 0.02, 0.01)
        )
        scene.set_world_medium(medium)
    set_camera(scene, (0, -8, 4), (0, 0, 0.6), size=(24, 24), half_width=0.35)
    return scene


def rendered(scene: pivot_core.Scene, **settings: object) -> pivot_core.Session:
    session = pivot_core.Session(scene, pivot_core.RenderSettings(max_bounces=3, **settings))
    session.start()
    while not session.wait(10.0):
        pass
    return session


def sum_of_groups(session: pivot_core.Session) -> Floats:
    """Combined, which they are to sum to, each of them with light."""
    groups: list[Floats] = [np.array(session.read_named(group)) for group in range(GROUPS)]
    combined = np.array(session.read("Combined"))[..., :3]
    np.testing.assert_allclose(sum(groups), combined, rtol=1e-3, atol=1e-4)
    assert all(group.mean() > 0.0005 for group in groups)
    return combined


@pytest.mark.parametrize(
    ("adaptive", "is_foggy", "has_veil", "clamp_indirect"),
    [(False, False, False, 0.0), (True, False, True, 0.0), (False, True, True, 0.0), (False, True, False, 0.05)],
)
def test_groups_sum_to_combined(adaptive: bool, is_foggy: bool, has_veil: bool, clamp_indirect: float) -> None:
    settings = {"samples": 32, "adaptive": adaptive, "clamp_indirect": clamp_indirect}
    combined = sum_of_groups(rendered(room(is_foggy, has_veil), light_groups=GROUPS, **settings))
    plain = np.array(rendered(room(is_foggy, has_veil), **settings).read("Combined"))[..., :3]
    np.testing.assert_array_equal(combined, plain)


@pytest.mark.parametrize(("is_foggy", "has_veil", "indirect"), [(False, True, "VSGL"), (True, False, "NONE")])
def test_groups_of_the_analytic_integrator_sum_to_combined(is_foggy: bool, has_veil: bool, indirect: str) -> None:
    settings = {"samples": 4, "integrator": "ANALYTIC", "indirect": indirect, "virtual_lights": 256}
    combined = sum_of_groups(rendered(room(is_foggy, has_veil), light_groups=GROUPS, **settings))
    # Virtual lights are cells of each group's own light, a little other than those of all light.
    plain = np.array(rendered(room(is_foggy, has_veil), **settings).read("Combined"))[..., :3]
    assert np.abs(combined - plain).mean() < (0.01 if indirect == "VSGL" else 1e-6) * plain.mean()


def test_each_group_is_the_light_of_its_own() -> None:
    """As rendered without all else."""
    session = rendered(room(False, False), light_groups=GROUPS, samples=256)
    alone = room(False, False)
    alone.remove_light(1)
    alone.set_world((0, 0, 0))
    for number in (2, 3):
        alone.remove_instance(number)
    lamp = np.array(rendered(alone, samples=256).read("Combined"))[..., :3]
    # What is removed also hid and reflected light.
    assert np.median(np.abs(lamp - session.read_named(0))) < 0.01


def test_an_aov_is_told_of_the_first_surface() -> None:
    scene = room(False, False)
    value = scene.add_material("value", pivot_core.Material(emission=(-1.0, 2.0, 0.5)))
    scene.set_aov(0, 0, value)
    scene.set_world_aov(1, pivot_core.Material(emission=(4.0, 5.0, 6.0)))
    session = rendered(scene, samples=4, aovs=2, light_groups=1)
    ground, share, sky = (np.array(session.read_named(place)) for place in (1, 2, 3))
    shares = ground / np.array((-1.0, 2.0, 0.5))
    assert np.allclose(shares, shares[..., :1], atol=1e-5)
    assert 0.2 < shares.mean() < 0.9
    assert shares.max() == pytest.approx(1.0, abs=1e-5)
    np.testing.assert_allclose(share[..., 0], shares[..., 0], atol=1e-5)
    assert sky[-1].mean() > 1.0
    assert sky[0].max() < 1e-5
