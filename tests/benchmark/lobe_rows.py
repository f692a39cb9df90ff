"""The rows of lobe_table.py: shader nodes and one input after the other. A row that a Blender does not have is none."""

from __future__ import annotations

from typing import Any

Row = tuple[str, dict[str, Any], dict[str, Any]]  # the node, its settings, and its inputs by name

RED, GOLD = (0.7, 0.3, 0.15, 1.0), (0.9, 0.6, 0.3, 1.0)
BLUE = (0.2, 0.4, 0.9, 1.0)


def _principled() -> dict[str, Row]:
    """Each input by itself, beside what it needs to be seen; those of one name in several Blenders as each has it."""
    base = {"Base Color": RED}
    clear = {"Base Color": (1.0, 1.0, 1.0, 1.0), "Roughness": 0.1}
    rows: dict[str, dict[str, Any]] = {
        "default": {},
        "Base Color": base,
        "Metallic": base | {"Metallic": 1.0},
        "Metallic, half": base | {"Metallic": 0.5},
        "Roughness 0.1": base | {"Roughness": 0.1},
        "Roughness 1": base | {"Roughness": 1.0},
        "Diffuse Roughness": base | {"Diffuse Roughness": 1.0},
        "IOR": base | {"IOR": 2.2},
        "Specular IOR Level": base | {"Specular IOR Level": 1.0},
        "Specular": base | {"Specular": 1.0},
        "Specular Tint": base | {"Specular Tint": BLUE},
        "Specular Tint of metal": base | {"Metallic": 1.0, "Specular Tint": BLUE},
        "Specular Tint, an amount": base | {"Specular Tint": 1.0},
        "Alpha": base | {"Alpha": 0.4},
        "Anisotropic": base | {"Metallic": 1.0, "Anisotropic": 0.8},
        "Anisotropic Rotation": base | {"Metallic": 1.0, "Anisotropic": 0.8, "Anisotropic Rotation": 0.2},
        "Emission Color": base | {"Emission Color": BLUE, "Emission Strength": 0.3},
        "Emission": base | {"Emission": BLUE, "Emission Strength": 0.3},
    }
    for coat in ("Coat", "Clearcoat"):
        weight = base | {"Coat Weight" if coat == "Coat" else coat: 1.0}
        rows |= {
            f"{coat}": weight,
            f"{coat} Roughness": weight | {f"{coat} Roughness": 0.4},
            f"{coat} IOR": weight | {f"{coat} IOR": 2.0},
            f"{coat} Tint": weight | {f"{coat} Tint": BLUE},
        }
    for sheen in ("Sheen Weight", "Sheen"):
        rows |= {sheen: base | {sheen: 1.0}, f"{sheen}, Roughness": base | {sheen: 1.0, "Sheen Roughness": 0.3}}
        rows |= {f"{sheen}, Tint": base | {sheen: 1.0, "Sheen Tint": BLUE if sheen == "Sheen Weight" else 1.0}}
    for weight in ("Transmission Weight", "Transmission"):
        glass = clear | {weight: 1.0}
        rows |= {
            weight: glass,
            f"{weight}, half": glass | {weight: 0.5},
            f"{weight}, rough": glass | {"Roughness": 0.4},
            f"{weight}, IOR": glass | {"IOR": 1.1},
            f"{weight}, Thin Film": glass | {"Thin Film Thickness": 400.0},
            f"{weight}, Thin Wall": glass | {"Thin Wall": True},
        }
    for weight in ("Subsurface Weight", "Subsurface"):
        wax = base | {weight: 1.0, "Subsurface Radius": (0.3, 0.15, 0.1)}
        rows |= {
            weight: wax,
            f"{weight}, Scale": wax | {"Subsurface Scale": 0.3},
            f"{weight}, Anisotropy": wax | {"Subsurface Anisotropy": 0.7},
        }
    film = {"Thin Film Thickness": 400.0}
    rows |= {
        "Thin Film": base | film,
        "Thin Film IOR": base | film | {"Thin Film IOR": 1.8},
        "Thin Film on metal": base | film | {"Metallic": 1.0},
    }
    return {f"Principled: {name}": ("ShaderNodeBsdfPrincipled", {}, inputs) for name, inputs in rows.items()}


def _by_distribution() -> dict[str, Row]:
    rows: dict[str, Row] = {}
    for kind, inputs in {
        "Glossy": {"Color": GOLD, "Roughness": 0.5},
        "Anisotropic": {"Color": GOLD, "Roughness": 0.5, "Anisotropy": 0.7},
        "Glass": {"Roughness": 0.4},
        "Refraction": {"Roughness": 0.4},
        "Metallic": {"Roughness": 0.5},
    }.items():
        for distribution in ("GGX", "MULTI_GGX", "BECKMANN", "ASHIKHMIN_SHIRLEY", "SHARP"):
            rows[f"{kind}: {distribution}"] = (f"ShaderNodeBsdf{kind}", {"distribution": distribution}, inputs)
    for model in ("F82", "PHYSICAL_CONDUCTOR"):
        settings = {"fresnel_type": model, "distribution": "GGX"}
        film = {"Thin Film Thickness": 400.0, "Roughness": 0.3}
        rows[f"Metallic: {model}"] = ("ShaderNodeBsdfMetallic", settings, {"Roughness": 0.3})
        rows[f"Metallic: {model}, Thin Film"] = ("ShaderNodeBsdfMetallic", settings, film)
    return rows


ROWS: dict[str, Row] = {
    "Diffuse": ("ShaderNodeBsdfDiffuse", {}, {"Color": RED}),
    "Diffuse: Roughness": ("ShaderNodeBsdfDiffuse", {}, {"Color": RED, "Roughness": 1.0}),
    "Translucent": ("ShaderNodeBsdfTranslucent", {}, {"Color": RED}),
    "Transparent": ("ShaderNodeBsdfTransparent", {}, {"Color": GOLD}),
    "Emission": ("ShaderNodeEmission", {}, {"Color": RED, "Strength": 0.5}),
    "Velvet": ("ShaderNodeBsdfVelvet", {}, {"Color": RED, "Sigma": 0.5}),
    "Sheen: MICROFIBER": ("ShaderNodeBsdfSheen", {"distribution": "MICROFIBER"}, {"Color": RED}),
    "Sheen: ASHIKHMIN": ("ShaderNodeBsdfSheen", {"distribution": "ASHIKHMIN"}, {"Color": RED}),
    "Toon: DIFFUSE": ("ShaderNodeBsdfToon", {"component": "DIFFUSE"}, {"Color": RED}),
    "Toon: GLOSSY": ("ShaderNodeBsdfToon", {"component": "GLOSSY"}, {"Color": RED}),
    **{
        f"Subsurface: {falloff}": (
            "ShaderNodeSubsurfaceScattering",
            {"falloff": falloff},
            {"Color": RED, "Scale": 0.2, "Radius": (1.0, 0.5, 0.3)},
        )
        for falloff in ("RANDOM_WALK", "RANDOM_WALK_SKIN", "RANDOM_WALK_FIXED_RADIUS", "BURLEY")
    },
    "Hair: Reflection": ("ShaderNodeBsdfHair", {"component": "Reflection"}, {"Color": RED, "RoughnessU": 0.3}),
    "Hair: Reflection, Offset": (
        "ShaderNodeBsdfHair",
        {"component": "Reflection"},
        {"Color": RED, "RoughnessU": 0.3, "Offset": 0.5},
    ),
    "Hair: Transmission": ("ShaderNodeBsdfHair", {"component": "Transmission"}, {"Color": RED, "RoughnessU": 0.3}),
    **_by_distribution(),
    **_principled(),
}
