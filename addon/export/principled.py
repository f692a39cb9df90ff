"""Principled, of Blender 3.4 to 5.x, as its Cycles means it."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import bpy

from . import cloth, subsurface, thin_wall
from .dielectric import Dielectric
from .film import Film, metal_of_f82
from .highlight import Highlight, f82, sides
from .layers import beneath_dielectric, brushed, coated, rotation
from .lobe import Lobe
from .nodes import Owner, Socket, colour, is_constant, normal, number, tangent
from .program import Value
from .shader_inputs import any_ior, emitted, ggx_alpha, is_multiscatter, let_through
from .surface import Surface, added


def principled(feed: Socket, owner: Owner) -> Surface:
    base = colour(feed.input("Base Color"), owner).at_least(0.0)
    metallic = number(feed.input("Metallic"), owner).clamped()
    ior, tint = _dielectric(feed, owner, base)
    f0 = base.at_most(1.0)
    f82_tinted = not metallic.is_always(0) and feed.find_input("Specular IOR Level") is not None
    edge_tint = tint.at_most(1.0) if f82_tinted else owner.program.colour((1, 1, 1))
    glass = number(feed.input("Transmission Weight", "Transmission"), owner).clamped()
    through, opaque = (1.0 - metallic) * glass, (1.0 - metallic) * (1.0 - glass)
    film, is_thin = Film.of(feed, owner), thin_wall.is_there(feed)
    on_metal = film is not None and bpy.app.version >= (5, 0) and not metallic.is_always(0)
    is_bare = film is None and not ior.is_always(1)
    curve = f82(f0, edge_tint, owner.program.number(0.0) if on_metal else metallic) | {
        "dielectric_weight": opaque if is_bare else owner.program.number(0.0),
        "dielectric_ior": ior,
        "dielectric_tint": tint,
    }
    whole = Surface.of(
        owner.program,
        **_principled_diffuse(feed, owner, base, opaque, ior, tint, film),
        alpha=ggx_alpha(feed, owner),
        **curve,
        weight=metallic + opaque,
        dielectrics=() if is_thin or glass.is_always(0) else _transmission(feed, owner, f0, through, film),
        **({} if film is None else _filmed(feed, owner, film, ior, tint, opaque)),
        multiscatter=is_multiscatter(feed, owner),
        emission=emitted(feed.input("Emission Color", "Emission"), feed.input("Emission Strength"), owner),
        normal=normal(feed, owner),
    )
    whole = brushed(whole, feed, owner)
    if on_metal:
        whole = _metal_beneath(whole, feed, owner, film, metal_of_f82(f0, edge_tint), metallic)
    if is_thin and not glass.is_always(0):
        pane = thin_wall.glass(feed, owner, f0, through, film)
        whole = added(replace(whole, opacity=1.0 - through), pane)[0]
    whole = coated(whole, feed, owner)
    if feed.find_input("Sheen Weight") is not None:
        whole = cloth.under_sheen(whole, feed, owner)
    opacity = number(feed.input("Alpha"), owner).clamped()
    if opacity.is_always(1):
        return whole
    return added(whole.scaled(opacity), let_through(1.0 - opacity))[0]


def _filmed(feed: Socket, owner: Owner, film: Film, ior: Value, tint: Value, opaque: Value) -> dict[str, Any]:
    """Principled's highlight beneath a thin film."""
    if opaque.is_always(0):
        return {}
    turns, multiscatter = rotation(feed, owner), is_multiscatter(feed, owner)
    highlight = film.highlight(feed, owner, ggx_alpha(feed, owner), turns, ior, tint, opaque, multiscatter)
    return {
        "highlights": (highlight,),
        "tangent": tangent(feed, owner) if highlight.is_anisotropic else None,
    }


def _metal_beneath(
    whole: Surface, feed: Socket, owner: Owner, film: Film, metal: dict[str, Value], weight: Value
) -> Surface:
    """Principled with its metal beneath a thin film."""
    alpha, turns = ggx_alpha(feed, owner), rotation(feed, owner)
    is_even = is_constant(feed.input("Anisotropic"), 0.0)
    alphas = (alpha, alpha) if is_even else sides(alpha, number(feed.input("Anisotropic"), owner))
    curve, multiscatter = film.on_metal(metal), is_multiscatter(feed, owner)
    highlight = Highlight("metal_film", curve, weight.widened(), *alphas, turns, multiscatter)
    along = whole.tangent if is_even else tangent(feed, owner)
    return replace(whole, highlights=(*whole.highlights, highlight), tangent=along)


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
    left, alpha, multiscatter = owner.program.number(1.0), ggx_alpha(feed, owner), is_multiscatter(feed, owner)
    if film is not None:
        left = film.beneath(feed, owner, alpha, ior, tint, multiscatter)
    elif (is_rough or not beneath.is_always(0)) and not ior.is_always(1):
        left, _ = beneath_dielectric(owner.program, normal(feed, owner), alpha, ior, tint, multiscatter)
    lobes, parts, smooth = [], {}, base * (opaque * above)
    under = 1.0 if film is None else left  # else the base's own highlight takes its share by itself
    if not beneath.is_always(0):
        weight = base.at_most(1.0) * beneath * opaque
        if thin_wall.is_there(feed):
            reflected, translucent = thin_wall.leaf(feed, owner, weight)
            parts = {"diffuse": reflected * under, "translucent": translucent * left}
            smooth = smooth + reflected
        else:
            lobes.append(subsurface.of_principled(feed, owner, base, weight * left, beneath, ior))
    if not is_rough:
        return parts | {"diffuse": smooth * under, "lobes": tuple(lobes)}
    rough = cloth.rough_diffuse(base * (opaque * above) * left, base, number(target, owner).clamped())
    return parts | {"lobes": (*lobes, rough)}


def _transmission(feed: Socket, owner: Owner, base: Value, weight: Value, film: Film | None) -> tuple[Dielectric, ...]:
    """What of Principled is glass: light passes two boundaries, each takes the root of the colour. [Cycles 4.5
    svm/closure.h]

    Before Blender 4.0 what comes through may be rougher than what is mirrored, where GGX is chosen.
    """
    program, multiscatter = owner.program, is_multiscatter(feed, owner)
    white, black = program.colour((1, 1, 1)), program.colour((0, 0, 0))
    if feed.find_input("Specular IOR Level") is not None:
        f0_tint = colour(feed.input("Specular Tint"), owner).at_least(0.0)
    else:
        f0_tint = program.mixed(number(feed.input("Specular Tint"), owner), white, base)
    alpha = ggx_alpha(feed, owner)
    ior = any_ior(feed, owner)
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


def _ior(feed: Socket, owner: Owner) -> Value:
    """The index of refraction, at least 1.

    One below reflects all light past some angle, which the core's base does not know; its inverse reflects as much at
    normal incidence.
    """
    ior = any_ior(feed, owner)
    if ior.is_constant and ior.numbers[0] < 1:
        owner.warn(feed.node, "an IOR below 1 is not supported, it is shown as 1 / IOR")
    return ior if ior.is_constant and ior.numbers[0] >= 1 else ior.at_least(1.0 / ior)


def _ior_from_f0(f0: Value) -> Value:
    root = f0.at_most(0.99).root()
    return (1.0 + root) / (1.0 - root)
