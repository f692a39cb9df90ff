"""Fog reaches the core as Cycles means it, and what is only approximated is said once."""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from blender_host import Host

COLOR, OTHER = np.array((0.8, 0.4, 0.2)), np.array((0.25, 0.09, 0.04))
HG = "HENYEY_GREENSTEIN"


@pytest.fixture(scope="module")
def cases(inside: Callable[[str], Any]) -> Any:
    return inside("fog_cases")


@pytest.fixture(scope="module")
def media(cases: Any) -> dict[str, Any]:
    return cases["media"]


def check(medium: dict[str, Any], *lobes: tuple[Any, float, str], absorption: Any = 0, emission: Any = 0) -> None:
    """lobes: sigma_s, anisotropy and phase."""
    assert [(g, phase) for _, g, phase in medium["scattering"]] == [(pytest.approx(g), phase) for _, g, phase in lobes]
    for (found, _, _), (expected, _, _) in zip(medium["scattering"], lobes, strict=True):
        np.testing.assert_allclose(found, np.broadcast_to(expected, 3), rtol=1e-5)
    np.testing.assert_allclose(medium["absorption"], np.broadcast_to(absorption, 3), rtol=1e-5, atol=1e-6)
    np.testing.assert_allclose(medium["emission"], np.broadcast_to(emission, 3), rtol=1e-5)
    assert medium["density"] is None
    assert medium["emission_grid"] is None


def test_scatter_and_absorption(media: dict[str, Any]) -> None:
    check(media["scatter"], (3 * COLOR, 0.5, HG))
    check(media["mirror"], (COLOR, 0.999, HG))
    check(media["absorption"], absorption=2 * (1 - COLOR))
    check(media["bright"], absorption=(0, 0.5, 0.5))
    check(media["folded"], (12 * COLOR, 0, HG))
    assert media["empty"] is None
    assert media["negative"] is None


def test_emission(media: dict[str, Any]) -> None:
    check(media["emission"], emission=5 * COLOR)


def test_principled(media: dict[str, Any]) -> None:
    absorption = 2 * (1 - COLOR) * (1 - np.sqrt(OTHER))
    check(media["principled"], (2 * COLOR, -0.25, HG), absorption=absorption)
    check(media["glow"], emission=4 * COLOR)
    fire = media["fire"]
    stefan_boltzmann = 5.670373e-8 * 1e-6 / math.pi
    body = np.array(fire["emission"]) / COLOR / (stefan_boltzmann * (0.5 + 0.5 * 2000**4))
    assert body[0] > body[1] > body[2] > 0  # what Blackbody gives at 2000 K, of luminance 1
    assert body @ (0.2126, 0.7152, 0.0722) == pytest.approx(1, rel=0.01)


def test_mixes_keep_every_lobe(media: dict[str, Any]) -> None:
    absorption = 2 * (1 - OTHER)
    check(media["mixed"], (0.75 * COLOR, 0.8, HG), (0.5 * OTHER, 0, HG), absorption=absorption / 4)
    check(media["added"], (COLOR, 0.8, HG), (2 * OTHER, 0, HG), absorption=absorption)
    check(media["same_lobe"], (2 * COLOR, 0, HG))


def test_phase_functions(host: Host, media: dict[str, Any]) -> None:
    """The material's choice has the node's mean cosine; others of Blender's are shown as Henyey-Greenstein."""
    [(_, g_p, phase)] = media["own_phase"]["scattering"]
    assert phase == "PIVOT"
    mean = (1 + g_p**2) / (2 * g_p) - (1 - g_p**2) ** 2 / (2 * g_p**2) * math.atanh(g_p)
    assert mean == pytest.approx(0.5, rel=1e-4)
    if host.version < (4, 3):
        return
    draine = 0.5 * (1 + 2 * 3.5 / 5) / (1 + 2 * 1.5 / 3)
    check(media["DRAINE"], (2 * COLOR, draine, HG))
    check(media["RAYLEIGH"], (2 * COLOR, 0, HG))
    [(_, g, _)] = media["FOURNIER_FORAND"]["scattering"]
    assert (1 - g) / (2 * g) * ((1 + g) / math.sqrt(1 + g * g) - 1) == pytest.approx(0.125, rel=1e-3)
    narrow, wide = media["MIE"]["scattering"]
    np.testing.assert_allclose(np.add(narrow[0], wide[0]), 2 * COLOR, rtol=1e-5)
    assert 0.97 < narrow[1] < 0.999
    assert 0 < wide[1] < narrow[1]
    check(media["coefficients"], ((1, 2, 3), 0.5, HG), absorption=(4, 5, 6), emission=(7, 8, 9))


def test_the_numbers_of_phase_functions(cases: Any) -> None:
    for ours, summed in cases["cosines"]["means"]:
        assert ours == pytest.approx(summed, abs=1e-5)
    for share, summed in cases["cosines"]["backwards"]:
        assert summed == pytest.approx(share, rel=1e-2)


def test_what_has_a_surface(media: dict[str, Any], cases: Any) -> None:
    assert set(cases["without_surface"]) == set(media) - {"milky"}
    check(media["milky"], (COLOR, 0, HG))


def test_faces_without_a_surface_are_apart_from_those_with_one(cases: Any) -> None:
    """An instance is passed by rays only if none of its materials has a surface."""
    mixed, alone, beyond = cases["slots"]
    seen, passed = mixed
    assert seen == {"materials": ["grey", "milky", "clear"], "slots": [0, 0, 1, 1], "triangles": 4}
    assert passed == {"materials": ["clear"] * 3, "slots": [2, 2], "triangles": 2}
    assert [part["materials"] for part in alone] == [["clear"] * 3]
    assert [(part["materials"][-1], part["triangles"]) for part in beyond] == [("clear", 4), ("clear", 2)]


def test_each_approximation_is_said_once_and_nothing_else(host: Host, cases: Any) -> None:
    said: dict[str, list[str]] = {}
    for report in cases["reports"]:
        found = re.fullmatch(r"Pivot: object '(.+) quad', material '(.+?)', node '.+?': (.+)", report)
        assert found, report
        assert found[1] == found[2]
        said.setdefault(found[2], []).append(found[3])
    expected = {
        "bright": ["a Color above 1 is not supported, it absorbs nothing"],
        "noisy": ["Anisotropy varies over space, it is shown as its mean"],
        "surface": ["Diffuse BSDF is not supported in a volume, it is left out"],
    }
    if host.version >= (4, 3):
        for phase in ("Fournier-Forand", "Draine", "Rayleigh", "Mie"):
            said_of = [f"Phase {phase} is not supported, it is shown as Henyey-Greenstein"]
            expected[phase.upper().replace("-", "_")] = said_of
    assert said == expected


def test_the_world_lights_no_fog_in_the_analytic_integrator_which_is_said(cases: Any) -> None:
    dark, lit = cases["analytic"]
    assert dark == []
    assert lit == [
        "Pivot: object 'scatter quad', material 'scatter': in the analytic integrator its volume scatters none of the "
        "world's light. Fix: use Monte Carlo"
    ]


def test_worlds(cases: Any) -> None:
    """A world of fog alone is black around."""
    lit, dark = cases["worlds"]
    for world in (lit, dark):
        check(world["medium"], (0.5 * COLOR, 0, HG))
        assert world["reports"] == []
    np.testing.assert_allclose(lit["radiance"], (0.5, 0.25, 1))
    np.testing.assert_allclose(dark["radiance"], 0)
