"""Materials reach the core as Cycles means them, and what is only approximated is said once."""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from blender_host import Host

RED, GREEN = np.array((0.8, 0.1, 0.05)), np.array((0.1, 0.6, 0.2))


@pytest.fixture(scope="module")
def cases(inside: Callable[[str], Any]) -> Any:
    return inside("material_cases")


@pytest.fixture(scope="module")
def materials(cases: Any) -> dict[str, Any]:
    return cases["materials"]


def check(material: dict[str, Any], **expected: Any) -> None:
    """Compare every property of an exported material, those not named with black or none."""
    black = (0, 0, 0)
    full = {"diffuse": black, "conductor_f0": black, "conductor_f90": black, "emission": black}
    full |= {"conductor_weight": 0, "dielectric_weight": 0, "conductor_dip": black}
    assert lobes(material) == expected.pop("lobes", [])
    for name, value in (full | expected).items():
        np.testing.assert_allclose(material[name], value, rtol=1e-5, atol=1e-6, err_msg=name)


def lobes(material: dict[str, Any]) -> list[Any]:
    """Kinds beside the base, with what of their parameters is told apart here."""
    told = ("color", "diffuse", "alpha", "conductor_f0", "weight", "reflection", "transmission", "ior", "fresnel")
    return [
        (kind, {name: pytest.approx(values[name]) for name in told if name in values})
        for kind, values in material["lobes"]
    ]


def principled(host: Host, color: Any) -> dict[str, Any]:
    """Where an opaque Principled keeps its diffuse part: before Blender 4.0 that is Disney's."""
    if host.version >= (4, 0):
        return {"diffuse": color}
    return {"lobes": [("disney_diffuse", {"color": color})]}


def ior(f0: float) -> float:
    """The index of refraction of a reflectance at normal incidence."""
    return (1 + f0**0.5) / (1 - f0**0.5)


def test_principled(host: Host, materials: dict[str, Any]) -> None:
    new = host.version >= (4, 0)
    f0 = 0.04  # of the node's IOR 1.5, and of Specular 0.5
    check(materials["default"], **principled(host, (0.8,) * 3), dielectric_weight=1, dielectric_ior=ior(f0), alpha=0.25)
    assert materials["default"]["multiscatter"] is False

    check(materials["plastic"], **principled(host, RED), alpha=0.09, dielectric_weight=1, dielectric_ior=ior(f0 / 2))
    assert materials["plastic"]["multiscatter"] is True
    check(materials["metal"], alpha=0.04, conductor_f0=RED, conductor_f90=(1, 1, 1), conductor_weight=1)
    check(
        materials["half_metal"],
        **principled(host, RED / 2),
        alpha=0.04,
        conductor_f0=RED / 2,
        conductor_f90=(0.5,) * 3,
        conductor_weight=0.5,
        dielectric_weight=0.5,
    )
    check(materials["matte"], **principled(host, RED))
    check(materials["dense"], **principled(host, (0.8,) * 3), dielectric_weight=1, dielectric_ior=2 if new else 1.5)
    luminance = RED @ (0.3, 0.6, 0.1)
    tint = (0.5, 1, 0.25) if new else 0.5 + 0.5 * RED / luminance
    check(materials["tinted"], **principled(host, RED), dielectric_weight=1, dielectric_tint=tint)
    check(materials["lamp"], **principled(host, (0.8,) * 3), dielectric_weight=1, emission=(2, 1, 4))


def test_edge_tint(host: Host, materials: dict[str, Any]) -> None:
    """From Blender 4.0 metal is the F82-tint model: 6/7 of the way to grazing, Schlick's reflectance times the tint."""
    if host.version < (4, 0):
        assert "edged_metal" not in materials
        return
    names = ["edged_metal"] + (["metallic_node"] if host.version >= (4, 3) else [])
    for name in names:
        schlick = RED + (1 - RED) * (6 / 7) ** 5
        dip = 0.1 * schlick / (1 / 7 * (6 / 7) ** 6)
        check(
            materials[name],
            alpha=0.25,
            conductor_f0=RED,
            conductor_f90=(1, 1, 1),
            conductor_dip=dip,
            conductor_weight=1,
        )


def test_coats(host: Host, materials: dict[str, Any]) -> None:
    """What lies beneath varies with the view; before Blender 4.0 a clearcoat takes nothing from it."""
    is_new = host.version >= (4, 0)
    beneath = ["dielectric_weight", "diffuse", "weight"] if is_new else []
    for name in ("lacquered", "bumpy_beneath"):
        is_bumpy = name == "bumpy_beneath"
        assert materials[name]["varying"] == sorted([*beneath, *(["lobes.0.normal", "normal"] if is_bumpy else [])])
        (kind, coat), *rest = materials[name]["lobes"]
        if not is_new:
            assert kind == "clearcoat"
            assert (coat["weight"], coat["alpha"]) == pytest.approx((0.125, 0.25))
            assert [other for other, _ in rest] == ["disney_diffuse"]
            continue
        assert rest == []
        assert coat["dielectric_weight"] == pytest.approx(0.5)
        assert coat["dielectric_ior"] == pytest.approx(1.5)
        assert coat["multiscatter"] == 1
        assert kind == ("anisotropic" if is_bumpy else "base")
        alphas = (coat["alpha_x"], coat["alpha_y"]) if is_bumpy else (coat["alpha"],)
        assert alphas == pytest.approx((0.25,) * len(alphas))


def test_anisotropic_highlights(host: Host, materials: dict[str, Any]) -> None:
    """By each node's own formula; Glossy BSDF's are long across the tangent where its anisotropy is above 0."""
    aspect = (1 - 0.9 * 0.8) ** 0.5
    alphas = {"brushed": (0.25 / aspect, 0.25 * aspect), "across": (0.0625, 1), "along": (1, 0.0625)}
    for name, expected in alphas.items():
        [(kind, lobe)] = materials[name]["lobes"]
        assert kind == "anisotropic"
        assert (lobe["alpha_x"], lobe["alpha_y"]) == pytest.approx(expected)
        assert lobe["rotation"] == pytest.approx(0.25)
        assert lobe["conductor_f0"] == pytest.approx(RED)
        assert materials[name]["varying"] == ["tangent"]
        check(materials[name] | {"lobes": []}, alpha=1)
    if host.version >= (4, 3):
        [(kind, lobe)] = materials["silver"]["lobes"]
        assert kind == "conductor"
        assert (lobe["alpha_x"], lobe["alpha_y"]) == pytest.approx(alphas["brushed"])
        assert lobe["n"] == pytest.approx((0.05, 0.06, 0.05))


def test_diffuse_glossy_and_emission(materials: dict[str, Any]) -> None:
    check(materials["diffuse"], diffuse=RED)
    check(materials["glossy"], alpha=0.16, conductor_f0=RED, conductor_f90=RED, conductor_weight=1)
    assert materials["glossy"]["multiscatter"] is False
    assert materials["glossy_multi"]["multiscatter"] is True
    check(materials["emission"], emission=(6, 3, 1.5))


def test_mix_and_add(materials: dict[str, Any]) -> None:
    check(
        materials["mixed"],
        diffuse=0.75 * RED,
        conductor_f0=0.25 * GREEN,
        conductor_f90=0.25 * GREEN,
        conductor_weight=0.25,
        emission=(2, 2, 2),
    )


def test_lobes_beside_the_base(materials: dict[str, Any]) -> None:
    """Light that comes through; and highlights of different shapes, each with its own diffuse lobe beneath."""
    check(materials["translucent"], lobes=[("translucent", {"color": GREEN})])
    black, quarter = (0, 0, 0), (0.25,) * 3
    check(
        materials["lacquer"],
        conductor_f0=(0.5,) * 3,
        conductor_f90=(0.5,) * 3,
        conductor_weight=0.5,
        weight=0.5,
        alpha=0.25,
        lobes=[("base", {"diffuse": black, "alpha": 0.01, "conductor_f0": quarter, "weight": 0.5})],
    )
    check(materials["paper"], diffuse=RED / 2, weight=0.5, lobes=[("translucent", {"color": GREEN / 2})])
    many = materials["many_highlights"]
    assert [kind for kind, _ in many["lobes"]] == ["base"] * 3
    assert many["weight"] + sum(values["weight"] for _, values in many["lobes"]) == pytest.approx(5)


def dielectric(**values: Any) -> tuple[str, dict[str, Any]]:
    """As `lobes` tells of one; white and mirroring by Fresnel where nothing else is given."""
    white = {"reflection": (1, 1, 1), "transmission": (1, 1, 1), "fresnel": 1, "weight": 1}
    return "dielectric", white | values


def test_glass(host: Host, materials: dict[str, Any]) -> None:
    """Nodes that refract, and what of Principled does: each of the two boundaries takes the root of its colour."""
    black = (0, 0, 0)
    green = {"reflection": GREEN, "transmission": GREEN}
    check(materials["glass"], lobes=[dielectric(**green, alpha=0.25, ior=1.5)])
    check(materials["glass_bubble"], lobes=[dielectric(**green, alpha=0.25, ior=0.5)])
    refraction = dielectric(reflection=black, transmission=RED, fresnel=0, alpha=0.25, ior=1.2)
    check(materials["refraction"], lobes=[refraction])
    check(materials["window"], weight=0, lobes=[dielectric(transmission=RED**0.5, alpha=0.25, ior=1.6)])
    half = {"diffuse": GREEN / 2, "weight": 0.5}
    frosted = {name: color / 2 for name, color in green.items()}
    check(materials["frosted_mix"], **half, lobes=[dielectric(**frosted, weight=0.5, alpha=0, ior=materials_ior(host))])
    parts = materials["half_glass"]
    assert parts["weight"] == pytest.approx(0.6)
    assert parts["dielectric_weight"] == pytest.approx(0.4)
    (kind, values), *others = parts["lobes"]
    diffuse = parts["diffuse"] if host.version >= (4, 0) else others[-1][1]["color"]
    np.testing.assert_allclose(diffuse, 0.4 * RED, rtol=1e-5)
    assert kind == "dielectric"
    np.testing.assert_allclose(values["transmission"], 0.4 * RED**0.5, rtol=1e-5)
    np.testing.assert_allclose(values["reflection"], [0.4] * 3, rtol=1e-5)
    if host.version < (4, 0):  # where what comes through may be rougher
        mirrored, refracted = (values for _, values in materials["frosted"]["lobes"])
        assert mirrored["alpha"] == pytest.approx(0.04)
        assert refracted["alpha"] == pytest.approx((1 - 0.8 * 0.5) ** 2)
        assert max(mirrored["transmission"]) == max(refracted["reflection"]) == 0


def materials_ior(host: Host) -> float:
    """Blender's default of a Glass BSDF."""
    return 1.5 if host.version >= (4, 2) else 1.45


def test_what_lets_light_through(materials: dict[str, Any]) -> None:
    """By a shader of its own or mixed with others, also by a picture's alpha; in shadows only."""
    check(materials["see_through"], transparency=(1, 1, 1), opacity=0)
    check(materials["leaf"], diffuse=GREEN / 2, weight=0.5, transparency=(0.5,) * 3, opacity=0.5)
    check(materials["shining_glass"], transparency=GREEN, emission=(1, 1, 1), opacity=1)


def test_links_are_followed(materials: dict[str, Any]) -> None:
    check(materials["routed"], alpha=0.25, conductor_f0=GREEN, conductor_f90=GREEN, conductor_weight=1)
    check(materials["grouped"], diffuse=GREEN)
    check(materials["outputs"], diffuse=GREEN)


def test_rough_and_fibrous_surfaces(host: Host, materials: dict[str, Any]) -> None:
    fibres = ("velvet", {"color": GREEN})
    check(materials["velvet"], lobes=[fibres])
    fuzzy = dict(materials["fuzzy"]["lobes"])
    if host.version < (4, 0):
        luminance = RED @ (0.3, 0.6, 0.1)
        np.testing.assert_allclose(fuzzy["disney_diffuse"]["sheen"], 0.5 * RED / luminance, rtol=1e-5)
        assert fuzzy["disney_diffuse"]["roughness"] == pytest.approx(0.4)
        return
    check(materials["microfiber"], lobes=[("sheen", {"color": GREEN})])
    np.testing.assert_allclose(fuzzy["sheen"]["color"], GREEN / 2, rtol=1e-5)
    assert fuzzy["sheen"]["roughness"] == pytest.approx(0.3)
    darkened = ["dielectric_weight", "diffuse", "weight"]
    assert materials["fuzzy"]["varying"] == darkened  # by what the fibres reflect to where they are seen from
    if host.version >= (4, 3):
        assert materials["rough_plastic"]["varying"] == ["lobes.0.weight"]  # of what the highlight leaves


def test_what_varies_over_a_surface(host: Host, materials: dict[str, Any]) -> None:
    diffuse = "diffuse" if host.version >= (4, 0) else "lobes.0.color"
    turned = ("brushed", "across", "along", "silver", "lacquered", "bumpy_beneath", "coated")  # and coats: told above
    layered = (*turned, "fuzzy", "rough_plastic")
    varying = {n: material["varying"] for n, material in materials.items() if material["varying"] and n not in layered}
    assert varying == {name: ["diffuse"] for name in ("image", "noise", "checker", "ramp", "fog")} | {
        "rough_noise": ["alpha"],
        "bump": ["normal"],
        "smoke": ["own_normal"],
        "unknown_factor": ["diffuse", "weight"],
        "cut_out": sorted(["dielectric_weight", diffuse, "opacity", "transparency", "weight"]),
        "shadowless": ["diffuse", "opacity", "transparency", "weight"],
    }


def test_nearest_meanings(host: Host, materials: dict[str, Any]) -> None:
    check(materials["no_image"], diffuse=(1, 0, 1))
    principled_ior = 2 if host.version >= (4, 0) else 1.5
    check(materials["bubble"], **principled(host, (0.8,) * 3), dielectric_weight=1, dielectric_ior=principled_ior)
    check(materials["oren_nayar"], lobes=[("oren_nayar", {"color": RED, "weight": RED})])
    check(materials["beckmann"], lobes=[("anisotropic", {"color": (1, 1, 1), "conductor_f0": RED})])
    assert materials["beckmann"]["lobes"][0][1]["beckmann"] == 1
    assert materials["coated"]["transparency"] == pytest.approx((0.5,) * 3)
    assert materials["coated"]["opacity"] == pytest.approx(0.5)
    check(materials["smoke"], diffuse=RED)
    check(materials["no_surface"])  # black, as in Cycles
    check(materials["painted"], emission=GREEN)
    check(materials["none"], diffuse=(0.8,) * 3)
    if host.version < (5, 0):
        check(materials["plain"], diffuse=RED)


def test_each_approximation_is_said_once_and_nothing_else(host: Host, cases: Any) -> None:
    said: dict[str, list[str]] = {}
    for report in cases["reports"]:
        found = re.fullmatch(r"Pivot: object '(.+) quad', material '(.+?)'(?:, node '(.+?)')?: .+", report)
        assert found, report
        assert found[1] == found[2]
        said.setdefault(found[2], []).append(found[3])
    expected: dict[str, list[str | None]] = {
        "no_image": ["Image Texture"],
        "fog": ["Principled Volume"],
        "many_highlights": [None],
    }
    if host.version >= (4, 0):
        expected["bubble"] = ["Principled BSDF"]  # before, its IOR is of transmission alone
        expected["loop"] = [None]  # before, Blender itself cuts a loop open
    assert said == expected


def test_an_operation_of_a_newer_blender_is_said(cases: Any) -> None:
    """And the input that it feeds keeps its own value."""
    node = "object 'wave quad', material 'wave', node 'Vector Math'"
    assert cases["newer"] == {
        "emission": [1, 1, 1],
        "reports": [f"Pivot: {node}: math_sine of Vector Math nodes is not supported, it stands for a constant"],
    }


def test_view_layer_override(cases: Any) -> None:
    assert cases["override"] == [["clay"], ["clay"]]
