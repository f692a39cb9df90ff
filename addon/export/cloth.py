"""Diffuse reflection that is not Lambert's, and sheen, of shader nodes."""

from __future__ import annotations

import bpy

from .lobe import Lobe
from .nodes import Owner, Socket, colour, normal, number
from .program import Value
from .surface import Surface, added

KEEPS_ENERGY = bpy.app.version >= (4, 3)  # Cycles' Oren-Nayar: before, what facets scatter on was lost


def rough_diffuse(weight: Value, tint: Value, roughness: Value) -> Lobe:
    """Oren-Nayar; weight: the share of the surface that it is, in its colour."""
    shape = (("color", tint.widened()), ("roughness", roughness))
    return Lobe("oren_nayar", (("weight", weight.widened()),), shape, (("keeps_energy", float(KEEPS_ENERGY)),))


def disney_diffuse(feed: Socket, owner: Owner, base: Value, opaque: Value) -> Lobe:
    """Principled's before Blender 4.0, with its sheen. [Cycles 3.4 svm/closure.h]"""
    return _disney(feed, owner, (base * opaque).widened(), _sheen_before(feed, owner, base, opaque))


def old_sheen(feed: Socket, owner: Owner, base: Value, opaque: Value) -> Lobe:
    """The sheen of that alone."""
    return _disney(feed, owner, owner.program.colour((0, 0, 0)), _sheen_before(feed, owner, base, opaque))


def _disney(feed: Socket, owner: Owner, tint: Value, sheen: Value) -> Lobe:
    shares = (("color", tint), ("sheen", sheen))
    return Lobe("disney_diffuse", shares, (("roughness", number(feed.input("Roughness"), owner).clamped()),))


def _sheen_before(feed: Socket, owner: Owner, base: Value, opaque: Value) -> Value:
    """Principled's before Blender 4.0."""
    amount, program = number(feed.input("Sheen"), owner).at_least(0.0), owner.program
    white = program.colour((1, 1, 1))
    tint = program.mixed(number(feed.input("Sheen Tint"), owner).clamped(), white, hue(base))
    return (tint * amount * opaque).widened()


def hue(base: Value) -> Value:
    """A colour over its luminance, white where that is 0. [Cycles 3.4 svm/closure.h]"""
    luminance = base[0] * 0.3 + base[1] * 0.6 + base[2] * 0.1
    lit = base.program.each("math_greater_than", luminance, 0.0)
    return base.program.mixed(lit, base.program.colour((1, 1, 1)), base / luminance)


def under_sheen(beneath: Surface, feed: Socket, owner: Owner) -> Surface:
    """A surface beneath Principled's layer of fibres, from Blender 4.0 on: as much darker as that is bright."""
    amount = number(feed.input("Sheen Weight"), owner).at_least(0.0)
    if amount.is_always(0):
        return beneath
    tint = colour(feed.input("Sheen Tint"), owner).at_least(0.0) * amount
    roughness = number(feed.input("Sheen Roughness"), owner).clamped()
    reflected = owner.program.op("sheen_albedo", _normal(feed, owner), roughness)
    left = (1.0 - tint[0].at_least(tint[1]).at_least(tint[2]) * reflected).clamped()
    layer = Surface.of(
        owner.program,
        lobes=(_microfiber(tint, roughness),),
        normal=normal(feed, owner),
        opacity=1.0 - left,
    )
    return added(beneath.scaled(left), layer)[0]


def sheen(feed: Socket, owner: Owner) -> Surface:
    tint = colour(feed.input("Color"), owner).at_least(0.0)
    roughness = number(feed.input("Roughness"), owner).clamped()
    lobe = _microfiber(tint, roughness) if feed.node.distribution == "MICROFIBER" else _fibres(tint, roughness)
    return Surface.of(owner.program, lobes=(lobe,), normal=normal(feed, owner))


def velvet(feed: Socket, owner: Owner) -> Surface:
    tint = colour(feed.input("Color"), owner).at_least(0.0)
    lobe = _fibres(tint, number(feed.input("Sigma"), owner).clamped())
    return Surface.of(owner.program, lobes=(lobe,), normal=normal(feed, owner))


def _microfiber(tint: Value, roughness: Value) -> Lobe:
    return Lobe("sheen", (("color", tint.widened()),), (("roughness", roughness),))


def _fibres(tint: Value, sigma: Value) -> Lobe:
    return Lobe("velvet", (("color", tint.widened()),), (("sigma", sigma),))


def _normal(feed: Socket, owner: Owner) -> Value:
    turned = normal(feed, owner)
    return owner.program.op("normal") if turned is None else turned
