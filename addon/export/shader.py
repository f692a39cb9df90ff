"""Shader nodes as surfaces the core can shade with.

A shader the core has no lobe for is reported once and becomes its nearest meaning. Principled follows Cycles 4.5,
also where the Blender in hand is older.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import bpy

from . import cloth, subsurface
from .census import INPUTS
from .dielectric import Dielectric
from .film import Film
from .hair import principled_hair
from .highlight import Highlight, f82, sides, sides_of_glossy
from .layers import beneath_dielectric, brushed, coated, rotation
from .lobe import Lobe
from .nodes import (
    MID_GREY,
    Owner,
    Socket,
    colour,
    displaced,
    is_constant,
    is_linked,
    normal,
    number,
    output_socket,
    source,
    tangent,
)
from .program import Program, Value
from .surface import Surface, added

MAX_LOBES = 3  # of the core, beside a base


def grey(program: Program) -> Surface:
    """Cycles' for objects without a material."""
    return Surface.of(program, diffuse=program.colour((0.8, 0.8, 0.8)))


def material_surface(tree: bpy.types.NodeTree, owner: Owner) -> Surface:
    """What a material's node tree stands for."""
    output = output_socket(tree, "Surface")
    if output is None or not output.socket.is_linked:
        owner.reporter.warn(f"{owner.name}: nothing is linked to the Surface of its output, it is shown as grey")
        return grey(owner.program)
    _leave_out(output, owner)
    try:
        displacement = output.input("Displacement")
        if is_linked(displacement):
            owner = displaced(displacement, owner)
            _report_displacement(owner)
        surface = _shader(output, owner)
        if surface.normal is not None and surface.normal == owner.displaced_normal:
            surface = replace(surface, normal_is_own=True)
    except RecursionError:
        owner.reporter.warn(f"{owner.name}: its nodes form a loop, it is shown as grey")
        return grey(owner.program)
    surface, exact = surface.within(MAX_LOBES)
    if not exact:
        owner.reporter.warn(
            f"{owner.name}: more than {MAX_LOBES} lobes beside the first are not supported, the weakest highlights are "
            "shown as one"
        )
    return surface


def _report_displacement(owner: Owner) -> None:
    material = owner.data
    settings = material if hasattr(material, "displacement_method") else material.cycles  # from Blender 4.1
    if settings.displacement_method != "BUMP":
        owner.reporter.warn(f"{owner.name}: displacement of the surface is not supported, it is shown as bump")


def light_emission(tree: bpy.types.NodeTree, owner: Owner) -> Value:
    """The colour and strength that a light's or world's node tree multiplies its light with."""
    black = owner.program.colour((0, 0, 0))
    output = output_socket(tree, "Surface")
    if output is None:
        return black
    _leave_out(output, owner)
    try:
        return _shader(output, owner).emission
    except RecursionError:
        owner.reporter.warn(f"{owner.name}: its nodes form a loop, it is black")
        return black


def _shader(target: Socket, owner: Owner) -> Surface:
    """The surface a shader input stands for."""
    feed = source(target)
    if feed is None or not feed.socket.is_output:
        return Surface.of(owner.program, opacity=owner.program.number(0.0))
    evaluate = _SHADERS.get(feed.node.type)
    if evaluate is not None:
        _leave_out(feed, owner)
        return evaluate(feed, owner)
    owner.warn(feed.node, f"{feed.node.bl_label} is not supported, it is shown as a diffuse surface of its colour")
    tint = feed.find_input("Color", "Base Color", "Diffuse Color")
    mid_grey = owner.program.colour([MID_GREY] * 3)
    return Surface.of(owner.program, diffuse=mid_grey if tint is None else colour(tint, owner))


def _mix(feed: Socket, owner: Owner) -> Surface:
    factor = number(feed.input(0), owner).clamped()
    return _sum(feed, owner, 1.0 - factor, factor, feed.input(1), feed.input(2))


def _add(feed: Socket, owner: Owner) -> Surface:
    one = owner.program.number(1.0)
    return _sum(feed, owner, one, one, feed.input(0), feed.input(1))


def _sum(feed: Socket, owner: Owner, weight_a: Value, weight_b: Value, a: Socket, b: Socket) -> Surface:
    pairs = ((weight_a, a), (weight_b, b))
    scaled = [_shader(shader, owner).scaled(weight) for weight, shader in pairs if not weight.is_always(0)]
    if len(scaled) == 1:
        return scaled[0]
    total, exact = added(*scaled)
    if not exact:
        owner.warn(feed.node, "shaders of different normals or tangents cannot be mixed, all take the first one's")
    return total


def _diffuse(feed: Socket, owner: Owner) -> Surface:
    tint, roughness = colour(feed.input("Color"), owner), number(feed.input("Roughness"), owner).clamped()
    if roughness.is_always(0):
        return Surface.of(owner.program, diffuse=tint, normal=normal(feed, owner))
    rough = cloth.rough_diffuse(tint.at_least(0.0), tint, roughness)
    return Surface.of(owner.program, lobes=(rough,), normal=normal(feed, owner))


def _translucent(feed: Socket, owner: Owner) -> Surface:
    return Surface.of(owner.program, translucent=colour(feed.input("Color"), owner), normal=normal(feed, owner))


def _glossy(feed: Socket, owner: Owner) -> Surface:
    tint = colour(feed.input("Color"), owner)
    curve = {"conductor_f0": tint, "conductor_f90": tint, "conductor_weight": owner.program.number(1.0)}
    alpha, anisotropy = _alpha(feed, owner), feed.find_input("Anisotropy")
    if anisotropy is None or is_constant(anisotropy, 0.0):
        return _metal(feed, owner, curve, alpha)
    return _metal(feed, owner, curve, alpha, sides_of_glossy(alpha, number(anisotropy, owner)))


def _metallic(feed: Socket, owner: Owner) -> Surface:
    alpha, anisotropy = _alpha(feed, owner), feed.input("Anisotropy")
    alphas = None if is_constant(anisotropy, 0.0) else sides(alpha, number(anisotropy, owner))
    if feed.node.fresnel_type == "PHYSICAL_CONDUCTOR":
        n, k = (colour(feed.input(name), owner).at_least(0.0) for name in ("IOR", "Extinction"))
        return _metal(feed, owner, {"n": n, "k": k}, alpha, alphas or (alpha, alpha), "conductor")
    base, edge_tint = (colour(feed.input(name), owner).clamped() for name in ("Base Color", "Edge Tint"))
    return _metal(feed, owner, f82(base, edge_tint, owner.program.number(1.0)), alpha, alphas)


def _metal(
    feed: Socket,
    owner: Owner,
    curve: dict[str, Value],
    alpha: Value,
    alphas: tuple[Value, Value] | None = None,
    kind: str = "anisotropic",
) -> Surface:
    """A highlight alone. alphas: GGX alpha along the tangent and across it, if it is one of axes of its own."""
    turned, multiscatter, white = normal(feed, owner), _multiscatter(feed, owner), owner.program.colour((1, 1, 1))
    if alphas is None:
        return Surface.of(owner.program, **curve, alpha=alpha, multiscatter=multiscatter, normal=turned)
    return Surface.of(
        owner.program,
        highlights=(Highlight(kind, tuple(curve.items()), white, *alphas, rotation(feed, owner), multiscatter),),
        tangent=tangent(feed, owner),
        normal=turned,
    )


def _glass(feed: Socket, owner: Owner) -> Surface:
    tint = colour(feed.input("Color"), owner).at_least(0.0)
    return _boundary(feed, owner, reflection=tint, transmission=tint, multiscatter=_multiscatter(feed, owner))


def _refraction(feed: Socket, owner: Owner) -> Surface:
    """All that can comes through, in one bounce: Cycles gives nothing back of what that loses."""
    _multiscatter(feed, owner)
    none, zero = owner.program.colour((0, 0, 0)), owner.program.number(0.0)
    tint = colour(feed.input("Color"), owner).at_least(0.0)
    return _boundary(feed, owner, reflection=none, transmission=tint, fresnel=zero)


def _boundary(feed: Socket, owner: Owner, **given: Value | bool) -> Surface:
    film = Film.of(feed, owner)
    above = {} if film is None else film.on_dielectric()
    dielectric = Dielectric.of(owner.program, alpha=_alpha(feed, owner), ior=_any_ior(feed, owner), **above, **given)
    return Surface.of(owner.program, dielectrics=(dielectric,), normal=normal(feed, owner))


def _transparent(feed: Socket, owner: Owner) -> Surface:
    return _let_through(colour(feed.input("Color"), owner).at_least(0.0))


def _let_through(tint: Value) -> Surface:
    return Surface.of(tint.program, transparency=tint.widened(), opacity=tint.program.number(0.0))


def _emission(feed: Socket, owner: Owner) -> Surface:
    return Surface.of(owner.program, emission=_emitted(feed.input("Color"), feed.input("Strength"), owner))


def _emitted(tint: Socket, strength: Socket, owner: Owner) -> Value:
    factor = number(strength, owner)
    return owner.program.colour((0, 0, 0)) if factor.is_always(0) else colour(tint, owner, unknown=1.0) * factor


def _principled(feed: Socket, owner: Owner) -> Surface:
    base = colour(feed.input("Base Color"), owner).at_least(0.0)
    metallic = number(feed.input("Metallic"), owner).clamped()
    ior, tint = _dielectric(feed, owner, base)
    f0 = base.at_most(1.0)
    f82_tinted = not metallic.is_always(0) and feed.find_input("Specular IOR Level") is not None
    edge_tint = tint.at_most(1.0) if f82_tinted else owner.program.colour((1, 1, 1))
    glass = number(feed.input("Transmission Weight", "Transmission"), owner).clamped()
    opaque = (1.0 - metallic) * (1.0 - glass)
    film = Film.of(feed, owner)
    if film is not None and bpy.app.version >= (5, 0) and not metallic.is_always(0):
        owner.warn(feed.node, "a thin film on metal is not supported, it is left out there")
    is_bare = film is None and not ior.is_always(1)
    curve = f82(f0, edge_tint, metallic) | {
        "dielectric_weight": opaque if is_bare else owner.program.number(0.0),
        "dielectric_ior": ior,
        "dielectric_tint": tint,
    }
    whole = Surface.of(
        owner.program,
        **_principled_diffuse(feed, owner, base, opaque, ior, tint, film),
        alpha=_alpha(feed, owner),
        **curve,
        weight=metallic + opaque,
        dielectrics=() if glass.is_always(0) else _transmission(feed, owner, f0, (1.0 - metallic) * glass, film),
        **({} if film is None else _filmed(feed, owner, film, ior, tint, opaque)),
        multiscatter=_multiscatter(feed, owner),
        emission=_emitted(feed.input("Emission Color", "Emission"), feed.input("Emission Strength"), owner),
        normal=normal(feed, owner),
    )
    whole = coated(brushed(whole, feed, owner), feed, owner)
    if feed.find_input("Sheen Weight") is not None:
        whole = cloth.under_sheen(whole, feed, owner)
    opacity = number(feed.input("Alpha"), owner).clamped()
    if opacity.is_always(1):
        return whole
    return added(whole.scaled(opacity), _let_through(1.0 - opacity))[0]


def _filmed(feed: Socket, owner: Owner, film: Film, ior: Value, tint: Value, opaque: Value) -> dict[str, Any]:
    """Principled's highlight beneath a thin film."""
    if opaque.is_always(0):
        return {}
    turns, multiscatter = rotation(feed, owner), _multiscatter(feed, owner)
    highlight = film.highlight(feed, owner, _alpha(feed, owner), turns, ior, tint, opaque, multiscatter)
    return {
        "highlights": (highlight,),
        "tangent": tangent(feed, owner) if highlight.is_anisotropic else None,
    }


def _principled_diffuse(
    feed: Socket, owner: Owner, base: Value, opaque: Value, ior: Value, tint: Value, film: Film | None
) -> dict[str, Value | tuple[Lobe, ...]]:
    """What Principled has of a diffuse lobe, and beneath it: before Blender 4.0 Disney's, of which the highlight takes
    no share."""
    if opaque.is_always(0):
        return {}
    beneath = number(feed.input("Subsurface Weight", "Subsurface"), owner).clamped()
    if feed.find_input("Specular IOR Level") is None:
        if beneath.is_always(0):
            return {"lobes": (cloth.disney_diffuse(feed, owner, base, opaque),)}
        mixed = subsurface.old_base(feed, owner, base, beneath)
        lobe = subsurface.of_principled(feed, owner, mixed, mixed * opaque, beneath, ior)
        sheen = () if is_constant(feed.input("Sheen"), 0.0) else (cloth.old_sheen(feed, owner, base, opaque),)
        return {"lobes": (lobe, *sheen)}
    target, above = feed.find_input("Diffuse Roughness"), 1.0 - beneath
    is_rough = not (target is None or is_constant(target, 0.0) or above.is_always(0))
    left, multiscatter = owner.program.number(1.0), _multiscatter(feed, owner)
    if film is not None:
        left = film.beneath(feed, owner, _alpha(feed, owner), ior, tint, multiscatter)
    elif (is_rough or not beneath.is_always(0)) and not ior.is_always(1):
        left, _ = beneath_dielectric(owner.program, normal(feed, owner), _alpha(feed, owner), ior, tint, multiscatter)
    lobes = []
    if not beneath.is_always(0):
        weight = base.at_most(1.0) * beneath * opaque * left
        lobes.append(subsurface.of_principled(feed, owner, base, weight, beneath, ior))
    if not is_rough:  # the base's own highlight takes its share by itself
        return {"diffuse": base * (opaque * above) * (1.0 if film is None else left), "lobes": tuple(lobes)}
    rough = cloth.rough_diffuse(base * (opaque * above) * left, base, number(target, owner).clamped())
    return {"lobes": (*lobes, rough)}


def _transmission(feed: Socket, owner: Owner, base: Value, weight: Value, film: Film | None) -> tuple[Dielectric, ...]:
    """What of Principled is glass: light passes two boundaries, each takes the root of the colour. [Cycles 4.5
    svm/closure.h]

    Before Blender 4.0 what comes through may be rougher than what is mirrored, where GGX is chosen.
    """
    program, multiscatter = owner.program, _multiscatter(feed, owner)
    white, black = program.colour((1, 1, 1)), program.colour((0, 0, 0))
    if feed.find_input("Specular IOR Level") is not None:
        f0_tint = colour(feed.input("Specular Tint"), owner).at_least(0.0)
    else:
        f0_tint = program.mixed(number(feed.input("Specular Tint"), owner), white, base)
    alpha = _alpha(feed, owner)
    ior = _any_ior(feed, owner)
    above = {} if film is None else film.on_dielectric()
    whole = Dielectric.of(
        program, transmission=base.root(), f0_tint=f0_tint, alpha=alpha, ior=ior, multiscatter=multiscatter, **above
    ).scaled(weight)
    further = feed.find_input("Transmission Roughness")
    if further is None or multiscatter or is_constant(further, 0.0):
        return (whole,)
    roughness = 1.0 - (1.0 - number(feed.input("Roughness"), owner).clamped()) * (
        1.0 - number(further, owner).clamped()
    )
    return (
        replace(whole, transmission=black),
        replace(whole, reflection=black, alpha=roughness * roughness),
    )


def _dielectric(feed: Socket, owner: Owner, base: Value) -> tuple[Value, Value]:
    """IOR and tint at normal incidence of Principled's specular layer. [Cycles 4.5 svm/closure.h]

    From Blender 4.0, Specular IOR Level scales the reflectance of IOR by twice its value. Before, Specular was 1 / 0.08
    of the reflectance at normal incidence, IOR meant for transmission alone, and the tint was an amount of base colour.
    """
    level = feed.find_input("Specular IOR Level")
    if level is not None:
        ior = _ior(feed, owner)
        ratio = (ior - 1.0) / (ior + 1.0)
        f0 = ratio * ratio * (2.0 * number(level, owner).at_least(0.0))
        return _ior_from_f0(f0), colour(feed.input("Specular Tint"), owner).at_least(0.0)
    f0 = 0.08 * number(feed.input("Specular"), owner).at_least(0.0)
    white = owner.program.colour((1, 1, 1))
    return _ior_from_f0(f0), owner.program.mixed(number(feed.input("Specular Tint"), owner), white, cloth.hue(base))


def _any_ior(feed: Socket, owner: Owner) -> Value:
    return number(feed.input("IOR"), owner).at_least(1e-5)


def _ior(feed: Socket, owner: Owner) -> Value:
    """The index of refraction, at least 1.

    One below reflects all light past some angle, which the core's base does not know; its inverse reflects as much at
    normal incidence.
    """
    ior = _any_ior(feed, owner)
    if ior.is_constant and ior.numbers[0] < 1:
        owner.warn(feed.node, "an IOR below 1 is not supported, it is shown as 1 / IOR")
    return ior if ior.is_constant and ior.numbers[0] >= 1 else ior.at_least(1.0 / ior)


def _ior_from_f0(f0: Value) -> Value:
    root = f0.at_most(0.99).root()
    return (1.0 + root) / (1.0 - root)


def _alpha(feed: Socket, owner: Owner) -> Value:
    """GGX alpha of a shader with a Roughness."""
    if getattr(feed.node, "distribution", "") == "SHARP":
        return owner.program.number(0.0)
    roughness = number(feed.input("Roughness"), owner).clamped()
    return roughness * roughness


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


_SHADERS: dict[str, Callable[[Socket, Owner], Surface]] = {
    "BSDF_PRINCIPLED": _principled,
    "BSDF_DIFFUSE": _diffuse,
    "BSDF_TRANSLUCENT": _translucent,
    "BSDF_SHEEN": cloth.sheen,
    "BSDF_VELVET": cloth.velvet,
    "BSDF_HAIR_PRINCIPLED": principled_hair,
    "SUBSURFACE_SCATTERING": subsurface.node,
    "BSDF_GLOSSY": _glossy,
    "BSDF_ANISOTROPIC": _glossy,
    "BSDF_METALLIC": _metallic,
    "BSDF_GLASS": _glass,
    "BSDF_REFRACTION": _refraction,
    "BSDF_TRANSPARENT": _transparent,
    "EMISSION": _emission,
    "BACKGROUND": _emission,
    "MIX_SHADER": _mix,
    "ADD_SHADER": _add,
}
