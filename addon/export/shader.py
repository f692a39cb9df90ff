"""Shader nodes as surfaces the core can shade with.

A shader the core has no lobe for is reported once and becomes its nearest meaning. Principled follows Cycles 4.5,
also where the Blender in hand is older.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import bpy
import numpy as np

from .census import INPUTS
from .colour import Colour
from .nodes import MID_GREY, Owner, Socket, colour, is_constant, is_linked, number, output_surface, source
from .surface import Surface, added

GREY = Surface(diffuse=np.full(3, 0.8))  # Cycles' for objects without a material


def material_surface(tree: bpy.types.NodeTree, owner: Owner) -> Surface:
    """What a material's node tree stands for."""
    output = output_surface(tree)
    if output is None or not output.socket.is_linked:
        owner.reporter.warn(f"{owner.name}: nothing is linked to the Surface of its output, it is shown as grey")
        return GREY
    _leave_out(output, owner)
    try:
        surface = _shader(output, owner)
    except RecursionError:
        owner.reporter.warn(f"{owner.name}: its nodes form a loop, it is shown as grey")
        return GREY
    if surface is None:
        owner.reporter.warn(f"{owner.name}: transparency is not supported, it is shown as grey")
        return GREY
    return surface


def light_emission(tree: bpy.types.NodeTree, owner: Owner) -> Colour:
    """(3,): the colour and strength that a light's or world's node tree multiplies its light with."""
    output = output_surface(tree)
    if output is None:
        return np.zeros(3)
    _leave_out(output, owner)
    try:
        surface = _shader(output, owner)
    except RecursionError:
        owner.reporter.warn(f"{owner.name}: its nodes form a loop, it is black")
        return np.zeros(3)
    return np.zeros(3) if surface is None else surface.emission


def _shader(target: Socket, owner: Owner) -> Surface | None:
    """The surface a shader input stands for; None for one that lets light through."""
    feed = source(target)
    if feed is None or not feed.socket.is_output:
        return Surface()
    evaluate = _SHADERS.get(feed.node.type)
    if evaluate is not None:
        _leave_out(feed, owner)
        return evaluate(feed, owner)
    owner.warn(feed.node, f"{feed.node.bl_label} is not supported, it is shown as a diffuse surface of its colour")
    tint = feed.find_input("Color", "Base Color", "Diffuse Color")
    return Surface(diffuse=np.full(3, MID_GREY) if tint is None else colour(tint, owner))


def _mix(feed: Socket, owner: Owner) -> Surface | None:
    factor = min(max(number(feed.input(0), owner, unknown=0.5), 0.0), 1.0)
    return _sum(feed, owner, 1 - factor, factor, feed.input(1), feed.input(2))


def _add(feed: Socket, owner: Owner) -> Surface | None:
    return _sum(feed, owner, 1.0, 1.0, feed.input(0), feed.input(1))


def _sum(feed: Socket, owner: Owner, weight_a: float, weight_b: float, a: Socket, b: Socket) -> Surface | None:
    parts = [(weight, _shader(shader, owner)) for weight, shader in ((weight_a, a), (weight_b, b)) if weight > 0]
    opaque = [(weight, surface) for weight, surface in parts if surface is not None]
    if len(opaque) < len(parts):  # beside transparency the other shader is opaque
        return opaque[0][1] if opaque else None
    scaled = [surface.scaled(weight) for weight, surface in opaque]
    if len(scaled) == 1:
        return scaled[0]
    total, exact = added(*scaled)
    if not exact:
        owner.warn(feed.node, "highlights of different kinds cannot be mixed, all are shown as the strongest")
    return total


def _diffuse(feed: Socket, owner: Owner) -> Surface:
    return Surface(diffuse=colour(feed.input("Color"), owner))


def _glossy(feed: Socket, owner: Owner) -> Surface:
    tint = colour(feed.input("Color"), owner)
    return Surface(
        alpha=_alpha(feed, owner),
        conductor_f0=tint,
        conductor_f90=tint,
        conductor_weight=1.0,
        multiscatter=_multiscatter(feed, owner),
    )


def _metallic(feed: Socket, owner: Owner) -> Surface:
    if feed.node.fresnel_type != "F82":
        owner.warn(feed.node, "physical conductors are not supported, it is shown by its base colour and edge tint")
    base, edge_tint = (np.clip(colour(feed.input(name), owner), 0, 1) for name in ("Base Color", "Edge Tint"))
    return Surface(
        alpha=_alpha(feed, owner),
        conductor_f0=base,
        conductor_f90=_grazing_reflectance(base, edge_tint, feed, owner),
        conductor_weight=1.0,
        multiscatter=_multiscatter(feed, owner),
    )


def _grazing_reflectance(f0: Colour, edge_tint: Colour, feed: Socket, owner: Owner) -> Colour:
    """The F90 by which Schlick's curve has the F82-tint model's reflectance at 82 degrees: exact for a white tint."""
    if np.any(edge_tint != 1):
        owner.warn(feed.node, "the edge tint of metal is approximated")
    weight_82 = (1 - 1 / 7) ** 5
    reflectance_82 = edge_tint * (f0 + (1 - f0) * weight_82)
    return np.maximum(f0 + (reflectance_82 - f0) / weight_82, 0)


def _glass(feed: Socket, owner: Owner) -> Surface:
    owner.warn(feed.node, f"{feed.node.bl_label} is not supported, it is shown as an opaque, glossy surface")
    return Surface(
        diffuse=colour(feed.input("Color"), owner),
        alpha=_alpha(feed, owner),
        dielectric_weight=1.0,
        dielectric_ior=_ior(feed, owner),
        multiscatter=_multiscatter(feed, owner),
    )


def _transparent(feed: Socket, owner: Owner) -> None:
    owner.warn(feed.node, "transparency is not supported, what it is mixed with is shown opaque")


def _emission(feed: Socket, owner: Owner) -> Surface:
    return Surface(emission=_emitted(feed.input("Color"), feed.input("Strength"), owner))


def _emitted(tint: Socket, strength: Socket, owner: Owner) -> Colour:
    factor = number(strength, owner)
    return factor * colour(tint, owner, unknown=1.0) if factor else np.zeros(3)


def _principled(feed: Socket, owner: Owner) -> Surface:
    base = np.maximum(colour(feed.input("Base Color"), owner), 0)
    metallic = min(max(number(feed.input("Metallic"), owner), 0.0), 1.0)
    ior, tint = _dielectric(feed, owner, base)
    f0 = np.minimum(base, 1)
    f82_tinted = metallic > 0 and feed.find_input("Specular IOR Level") is not None
    edge_tint = np.minimum(tint, 1) if f82_tinted else np.ones(3)
    return Surface(
        diffuse=base * (1 - metallic),
        alpha=_alpha(feed, owner),
        conductor_f0=f0 * metallic,
        conductor_f90=_grazing_reflectance(f0, edge_tint, feed, owner) * metallic,
        conductor_weight=metallic,
        dielectric_weight=(1 - metallic) if ior != 1 else 0.0,
        dielectric_ior=ior,
        dielectric_tint=tint,
        multiscatter=_multiscatter(feed, owner),
        emission=_emitted(feed.input("Emission Color", "Emission"), feed.input("Emission Strength"), owner),
    )


def _dielectric(feed: Socket, owner: Owner, base: Colour) -> tuple[float, Colour]:
    """IOR and tint at normal incidence of Principled's specular layer. [Cycles 4.5 svm/closure.h]

    From Blender 4.0, Specular IOR Level scales the reflectance of IOR by twice its value. Before, Specular was 1 / 0.08
    of the reflectance at normal incidence, IOR meant for transmission alone, and the tint was an amount of base colour.
    """
    level = feed.find_input("Specular IOR Level")
    if level is not None:
        ior = _ior(feed, owner)
        f0 = ((ior - 1) / (ior + 1)) ** 2 * 2 * max(number(level, owner), 0.0)
        return _ior_from_f0(f0), np.maximum(colour(feed.input("Specular Tint"), owner), 0)
    f0 = 0.08 * max(number(feed.input("Specular"), owner), 0.0)
    luminance = float(base @ (0.3, 0.6, 0.1))
    hue = base / luminance if luminance > 0 else np.ones(3)
    amount = number(feed.input("Specular Tint"), owner)
    return _ior_from_f0(f0), (1 - amount) + amount * hue


def _ior(feed: Socket, owner: Owner) -> float:
    """The index of refraction, at least 1.

    One below reflects all light past some angle, which the core does not know; its inverse reflects as much at normal
    incidence.
    """
    ior = max(number(feed.input("IOR"), owner), 1e-5)
    if ior >= 1:
        return ior
    owner.warn(feed.node, "an IOR below 1 is not supported, it is shown as 1 / IOR")
    return 1 / ior


def _ior_from_f0(f0: float) -> float:
    root = math.sqrt(min(f0, 0.99))
    return (1 + root) / (1 - root)


def _alpha(feed: Socket, owner: Owner) -> float:
    """GGX alpha of a shader with a Roughness."""
    if getattr(feed.node, "distribution", "") == "SHARP":
        return 0.0
    return min(max(number(feed.input("Roughness"), owner), 0.0), 1.0) ** 2


def _multiscatter(feed: Socket, owner: Owner) -> bool:
    distribution = feed.node.distribution
    if distribution not in {"GGX", "MULTI_GGX", "SHARP"}:
        name = feed.node.bl_rna.properties["distribution"].enum_items[distribution].name
        owner.warn(feed.node, f"{name} is not supported, it is shown as GGX")
    return distribution == "MULTI_GGX"


def _leave_out(feed: Socket, owner: Owner) -> None:
    """Say which inputs of a node are left out."""
    for identifier, neutral in INPUTS[feed.node.bl_idname].neutral_values():
        target = feed.find_input(identifier)
        if target is not None and (is_linked(target) if neutral is None else not is_constant(target, neutral)):
            owner.warn(feed.node, f"{target.socket.name} is not supported, it is left out")


_SHADERS: dict[str, Callable[[Socket, Owner], Surface | None]] = {
    "BSDF_PRINCIPLED": _principled,
    "BSDF_DIFFUSE": _diffuse,
    "BSDF_GLOSSY": _glossy,
    "BSDF_ANISOTROPIC": _glossy,
    "BSDF_METALLIC": _metallic,
    "BSDF_GLASS": _glass,
    "BSDF_TRANSPARENT": _transparent,
    "EMISSION": _emission,
    "BACKGROUND": _emission,
    "MIX_SHADER": _mix,
    "ADD_SHADER": _add,
}
