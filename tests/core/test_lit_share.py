"""Lights light what their rules say, and rays meet what is there for them."""

from __future__ import annotations

import numpy as np
import pivot_core
import pytest
from scenes import add_plane, place, render, set_camera

HALF = {"diffuse": (0.5, 0.5, 0.5)}
MIRROR = {"conductor_f0": (0.8, 0.8, 0.8), "conductor_f90": (0.8, 0.8, 0.8), "alpha": 0.5}
ABOVE = pivot_core.SphereLight((0, 0, 2), 0.1, (10, 10, 10))


def brightness(
    light: pivot_core.SphereLight, material: dict, *, lid: list[str] | None = None, **settings: object
) -> float:
    """Of the ground's middle below the light, a lid between them if told from what that is hidden."""
    rules = {name: settings.pop(name) for name in ("hidden_from", "light_bounces") if name in settings}
    scene = pivot_core.Scene()
    ground = scene.add_material("ground", pivot_core.Material(**material))
    scene.add_instances("ground", add_plane(scene), place(), [ground])
    if lid is not None:
        chalk = scene.add_material("chalk", pivot_core.Material(**HALF))
        scene.add_instances("lid", add_plane(scene, 0.5), place(z=1), [chalk], hidden_from=["CAMERA", *lid])
    scene.add_light(
        "light", light, hidden_from=rules.get("hidden_from", []), max_bounces=rules.get("light_bounces", 1024)
    )
    set_camera(scene, (0, 0.01, 8), size=(8, 8), half_width=0.01)
    return float(render(scene, samples=16, **{"max_bounces": 0} | settings)[..., :3].mean())


@pytest.mark.parametrize("integrator", ["MONTE_CARLO", "ANALYTIC"])
def test_a_light_leaves_reflections_out(integrator: str) -> None:
    def lit(material: dict, *hidden_from: str) -> float:
        return brightness(ABOVE, material, hidden_from=list(hidden_from), integrator=integrator)

    whole = lit(HALF | MIRROR)
    diffuse, glossy = lit(HALF | MIRROR, "GLOSSY"), lit(HALF | MIRROR, "DIFFUSE")
    assert diffuse == pytest.approx(lit(HALF), rel=0.01)
    assert glossy == pytest.approx(lit(MIRROR), rel=0.02)
    assert diffuse + glossy == pytest.approx(whole, rel=0.01)
    assert lit(HALF | MIRROR, "GLOSSY", "DIFFUSE") == 0
    assert lit(HALF | MIRROR, "TRANSMISSION", "VOLUME_SCATTER") == whole


@pytest.mark.parametrize("integrator", ["MONTE_CARLO", "ANALYTIC"])
def test_shadows(integrator: str) -> None:
    """What casts none, and what is lit through what casts them."""
    lit = brightness(ABOVE, HALF, integrator=integrator)
    assert brightness(ABOVE, HALF, lid=[], integrator=integrator) == 0
    assert brightness(ABOVE, HALF, lid=["SHADOW"], integrator=integrator) == lit
    assert brightness(ABOVE, HALF, lid=[], hidden_from=["SHADOW"], integrator=integrator) == lit


def test_a_light_lights_so_many_bounces() -> None:
    """The lid's underside lights the ground by what bounced twice."""
    bounced = {"max_bounces": 2, "lid": ["SHADOW"]}
    assert brightness(ABOVE, HALF, **bounced, light_bounces=0) == brightness(ABOVE, HALF)
    assert brightness(ABOVE, HALF, **bounced, light_bounces=2) == brightness(ABOVE, HALF, **bounced)
    assert brightness(ABOVE, HALF, **bounced) > 1.01 * brightness(ABOVE, HALF, **bounced, light_bounces=0)


def test_rays_meet_what_is_there_for_them() -> None:
    """Light that bounced comes by way of a lid that its rays meet."""
    bounced = {"max_bounces": 2}
    direct = brightness(ABOVE, HALF)
    met = brightness(ABOVE, HALF, lid=["SHADOW", "GLOSSY", "TRANSMISSION"], **bounced)
    assert met > 1.01 * direct
    assert brightness(ABOVE, HALF, lid=["SHADOW", "DIFFUSE"], **bounced) == direct


@pytest.mark.parametrize("ellipse", [False, True])
@pytest.mark.parametrize(
    ("degrees", "integrator"),
    [
        *((degrees, "MONTE_CARLO") for degrees in (0, 1, 10, 60, 150)),
        *((degrees, "ANALYTIC") for degrees in (10, 60, 150)),
    ],
)
def test_a_spread_keeps_the_power(degrees: float, integrator: str, ellipse: bool) -> None:
    """All of it arrives on the ground, within a light's width and what the spread opens to."""
    scene = pivot_core.Scene()
    ground = scene.add_material("ground", pivot_core.Material(**HALF))
    scene.add_instances("ground", add_plane(scene), place(), [ground])
    spread_rad = np.radians(degrees)
    shape = {"half_u": (0, 0.5, 0), "half_v": (0.5, 0, 0), "ellipse": ellipse}
    scene.add_light("light", pivot_core.AreaLight((0, 0, 1), radiance=(1, 1, 1), spread_rad=spread_rad, **shape))
    distance_m, pixels, half_width_m = 200, 64, 0.6 + np.tan(spread_rad / 2)
    set_camera(scene, (0, 0.01, distance_m), size=(pixels, pixels), half_width=half_width_m / distance_m)
    radiance = render(scene, samples=64, max_bounces=0, integrator=integrator)[..., 0]
    pixel_m2 = (2 * half_width_m / pixels) ** 2
    power_w = float(radiance.sum()) * pixel_m2 * np.pi / HALF["diffuse"][0]
    area_m2 = np.pi / 4 if ellipse else 1
    assert power_w == pytest.approx(np.pi * 1 * area_m2, rel=0.01)  # of radiance 1


@pytest.mark.parametrize("integrator", ["MONTE_CARLO", "ANALYTIC"])
def test_a_holdout_is_a_hole(integrator: str) -> None:
    scene = pivot_core.Scene()
    chalk = scene.add_material("chalk", pivot_core.Material(**HALF))
    scene.add_instances("ground", add_plane(scene), place(), [chalk])
    scene.add_instances("hole", add_plane(scene, 0.5), place(z=1), [chalk], holdout=True)
    scene.add_light("light", ABOVE)
    set_camera(scene, (0, 0.01, 8), size=(16, 16), half_width=0.2)
    picture = render(scene, samples=4, transparent_film=True, integrator=integrator)
    np.testing.assert_allclose(picture[8, 8], 0, atol=1e-6)
    assert picture[0, 0, 3] == 1
    assert render(scene, samples=4, integrator=integrator)[8, 8].tolist() == [0, 0, 0, 1]
