"""What passes tell of surfaces, and of the light that these reflect."""

from __future__ import annotations

import numpy as np
import pivot_core
import pytest
from scenes import Floats, add_plane, add_sphere, place, set_camera

LIGHT = {"DiffDir": "Diffuse Color", "DiffInd": "Diffuse Color", "GlossDir": "GlossCol", "GlossInd": "GlossCol"}
GLASS = {"TransDir": "TransCol", "TransInd": "TransCol"}


def room(is_foggy: bool = False) -> pivot_core.Scene:
    """A ground under a mixed and a glass ball, a veil before them, a lamp and a grey world."""
    scene = pivot_core.Scene()
    uv = np.array([[0, 0], [1, 0], [1, 1], [0, 1]], np.float32)
    corners = np.array([[-4, -4, 0], [4, -4, 0], [4, 4, 0], [-4, 4, 0]], np.float32)
    ground = scene.add_mesh(
        "ground", corners, np.arange(4), np.array([[0, 1, 2], [0, 2, 3]]), corner_attributes={"uv:": uv}
    )
    chalk = scene.add_material("chalk", pivot_core.Material(diffuse=(0.6, 0.5, 0.4)), pass_index=4)
    coat = {"dielectric_weight": 1.0, "alpha": 0.2, "multiscatter": True}
    shiny = scene.add_material("shiny", pivot_core.Material(diffuse=(0.2, 0.4, 0.6), **coat))
    veil = pivot_core.Material(diffuse=(0.3, 0.3, 0.3), transparency=(0.5, 0.5, 0.5), opacity=0.5)
    scene.add_instances("ground", ground, place(), [chalk], pass_index=7)
    scene.add_instances("ball", add_sphere(scene, 24), place(-1, 0, 1), [shiny])
    scene.add_instances("veil", add_plane(scene, 0.7), place(1, -1, 1), [scene.add_material("veil", veil)])
    scene.add_light("lamp", pivot_core.SphereLight((1, -2, 4), 0.3, (20, 20, 20)))
    scene.set_world((0.3, 0.3, 0.4))
    if is_foggy:
        scene.set_world_medium(pivot_core.Medium(scattering=[((0.05, 0.05, 0.05), 0.3, "HENYEY_GREENSTEIN")]))
    set_camera(scene, (0, -8, 4), (0, 0, 0.6), size=(24, 24), half_width=0.35)
    return scene


def passes(scene: pivot_core.Scene, *names: str, **settings: object) -> list[Floats]:
    made = pivot_core.RenderSettings(surface_passes=True, uv_attribute=scene.attribute_id("uv:"), **settings)
    session = pivot_core.Session(scene, made)
    session.start()
    while not session.wait(10.0):
        pass
    return [np.array(session.read(name)) for name in names]


@pytest.mark.parametrize(("adaptive", "is_foggy"), [(False, False), (True, False), (False, True)])
def test_light_passes_sum_to_combined(adaptive: bool, is_foggy: bool) -> None:
    names = ("Combined", "Emit", "Env", "VolumeDir", "VolumeInd", *LIGHT, *GLASS, *LIGHT.values(), *GLASS.values())
    settings = {"samples": 32, "max_bounces": 3, "adaptive": adaptive}
    combined, emit, environment, direct, indirect, *rest = passes(room(is_foggy), *names, **settings)
    count = len(LIGHT) + len(GLASS)
    total = (
        emit
        + environment
        + direct
        + indirect
        + sum(light * color for light, color in zip(rest[:count], rest[count:], strict=True))
    )
    np.testing.assert_allclose(total, combined[..., :3], rtol=1e-4, atol=1e-5)
    assert all(light.mean() > 0.001 for light in rest[:4])


def test_passes_change_no_picture_where_one_path_is_followed() -> None:
    scene = pivot_core.Scene()
    chalk = scene.add_material("chalk", pivot_core.Material(diffuse=(0.6, 0.5, 0.4)))
    scene.add_instances("ball", add_sphere(scene, 24), place(0, 0, 0), [chalk])
    scene.add_light("lamp", pivot_core.SphereLight((1, -2, 4), 0.3, (20, 20, 20)))
    set_camera(scene, (0, -8, 4), size=(16, 16))
    [told] = passes(scene, "Combined", samples=8)
    session = pivot_core.Session(scene, pivot_core.RenderSettings(samples=8))
    session.start()
    while not session.wait(10.0):
        pass
    assert np.array_equal(told, session.read("Combined"))


@pytest.mark.parametrize("integrator", ["MONTE_CARLO", "ANALYTIC"])
def test_surfaces_are_told(integrator: str) -> None:
    scene = room()
    settings = {"integrator": integrator, "samples": 4, "filter_width_px": 0.0, "mist": (6.0, 8.0, 1.0)}
    uv, mist, index, material, position = passes(scene, "UV", "Mist", "IndexOB", "IndexMA", "Position", **settings)
    ground = index[..., 0] == 7
    assert ground.any()
    assert (material[ground] == 4).all()
    np.testing.assert_allclose(uv[ground][:, :2], (position[ground][:, :2] + 4) / 8, atol=1e-4)
    distance = np.linalg.norm(position[ground] - (0, -8, 4), axis=-1)
    np.testing.assert_allclose(mist[ground][:, 0], np.clip((distance - 6) / 8, 0, 1), atol=1e-4)
    assert mist[0, 0, 0] <= 1


def test_passes_of_surfaces_are_to_be_asked_for() -> None:
    session = pivot_core.Session(room(), pivot_core.RenderSettings(samples=1))
    with pytest.raises(ValueError, match="'UV' is of surfaces: render with surface_passes"):
        session.read("UV")
    assert pivot_core.Session.bytes_per_pixel(False, False, True) > pivot_core.Session.bytes_per_pixel(False)
