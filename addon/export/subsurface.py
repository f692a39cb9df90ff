"""Subsurface scattering of shader nodes: what the core's lobe of that name is told of each of Cycles' methods.

What a radius means, and by which way light enters, follows Cycles' bssrdf.h and subsurface.h, of 3.4, 4.5 and 5.2.
Burley's method is walked like the others, in the same medium as the random walk of its time.
"""

from __future__ import annotations

import math

import bpy

from .lobe import Lobe
from .nodes import Owner, Socket, colour, normal, number
from .program import Value
from .surface import Surface

_OF_BURLEY = 0.25 / math.pi  # of a radius, the mean free path of methods that look like the first ones
_IS_OLD = bpy.app.version < (4, 0)  # random walks enter by the cosine
_WALKS_AFTER_DIFFUSE = bpy.app.version >= (5, 0)


def node(feed: Socket, owner: Owner) -> Surface:
    """The Subsurface Scattering node."""
    tint = colour(feed.input("Color"), owner).at_least(0.0)
    scale = number(feed.input("Scale"), owner)
    roughness = None if _IS_OLD else number(feed.input("Roughness"), owner).clamped()
    ior = number(feed.input("IOR"), owner)
    lobe = _lobe(feed, owner, feed.node.falloff, tint, tint, scale, ior, ior, roughness, "Radius", "Anisotropy")
    return Surface.of(owner.program, lobes=(lobe,), normal=normal(feed, owner))


def of_principled(feed: Socket, owner: Owner, base: Value, weight: Value, amount: Value, ior: Value) -> Lobe:
    """Principled's; weight: of the lobe, in its colour; amount: of Subsurface; ior: of its highlight."""
    roughness = number(feed.input("Roughness"), owner).clamped()
    names = "Subsurface Radius", "Subsurface Anisotropy"
    inner_ior = number(feed.input("Subsurface IOR"), owner)
    method = feed.node.subsurface_method
    if _IS_OLD:
        disney = (("roughness", roughness),), (("disney", 1.0),)
        return _lobe(feed, owner, method, weight, base, amount, ior, inner_ior, None, *names, *disney)
    scale = number(feed.input("Subsurface Scale"), owner)
    return _lobe(feed, owner, method, weight, base, scale, ior, inner_ior, roughness * roughness, *names)


def old_base(feed: Socket, owner: Owner, base: Value, amount: Value) -> Value:
    """The colour of Principled's diffuse part before Blender 4.0, where some of it goes beneath the surface."""
    return owner.program.mixed(amount, base, colour(feed.input("Subsurface Color"), owner).at_least(0.0))


def _lobe(
    feed: Socket,
    owner: Owner,
    method: str,
    weight: Value,
    albedo: Value,
    scale: Value,
    ior: Value,
    inner_ior: Value,
    entry_alpha: Value | None,
    radius: str,
    anisotropy: str,
    further_shape: tuple[tuple[str, Value], ...] = (),
    further_settings: tuple[tuple[str, float], ...] = (),
) -> Lobe:
    """scale: of the radius; inner_ior: of methods with one; entry_alpha: None where all enter by the cosine."""
    program, is_new = owner.program, _has_legacy(feed.node)
    is_length = method == ("RANDOM_WALK" if _IS_OLD else "RANDOM_WALK_SKIN")
    is_similar = is_new and method == "RANDOM_WALK"
    factor = 1.0 if is_length or is_similar else _OF_BURLEY
    low, high = (-0.99, 0.99 if is_similar else 0.9) if is_new else (0.0, 0.9)
    shape = (
        ("albedo", albedo.widened().clamped()),
        ("radius_m", (colour(feed.input(radius), owner) * scale * factor).at_least(0.0).widened()),
        ("anisotropy", number(feed.input(anisotropy), owner).at_least(low).at_most(high)),
        ("ior", (inner_ior if is_length else ior).at_least(1.01).at_most(3.8)),
        ("entry_alpha", program.number(1.0) if entry_alpha is None or is_length else entry_alpha),
        *further_shape,
    )
    cosine_entry = 1.0 if entry_alpha is None or method == "BURLEY" else 0.5 if is_length else 0.0
    settings = (
        ("cosine_entry", cosine_entry),
        ("is_diffusion_length", float(is_length)),
        ("is_similar", float(is_similar)),
        ("is_always_walked", float(_WALKS_AFTER_DIFFUSE and method != "BURLEY")),
        *further_settings,
    )
    return Lobe("subsurface", (("color", weight.widened()),), shape, settings)


def _has_legacy(shader: bpy.types.Node) -> bool:
    """Whether the random walk is the one that came beside an older one, which is then named so."""
    name = "falloff" if hasattr(shader, "falloff") else "subsurface_method"
    return "RANDOM_WALK_LEGACY" in shader.bl_rna.properties[name].enum_items
