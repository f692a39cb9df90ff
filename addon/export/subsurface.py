"""Subsurface scattering of shader nodes: what the core's lobe of that name is told of each of Cycles' methods.

What a radius means, and by which way light enters, follows Cycles' bssrdf.h and subsurface.h, of 3.4, 4.5 and 5.2.
Burley's method is walked like the others, in the same medium as the random walk of its time.
"""

from __future__ import annotations

import math
from dataclasses import replace

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
    scale, ior = number(feed.input("Scale"), owner), number(feed.input("IOR"), owner)
    alpha = None if _IS_OLD else number(feed.input("Roughness"), owner).clamped()
    lobe = _lobe(feed, owner, "", feed.node.falloff, tint, tint, scale, ior, alpha)
    return Surface.of(owner.program, lobes=(lobe,), normal=normal(feed, owner))


def of_principled(feed: Socket, owner: Owner, base: Value, weight: Value, amount: Value, ior: Value) -> Lobe:
    """Principled's; weight: of the lobe, in its colour; amount: of Subsurface; ior: of its highlight."""
    roughness = number(feed.input("Roughness"), owner).clamped()
    scale = amount if _IS_OLD else number(feed.input("Subsurface Scale"), owner)
    alpha = None if _IS_OLD else roughness * roughness
    lobe = _lobe(feed, owner, "Subsurface ", feed.node.subsurface_method, weight, base, scale, ior, alpha)
    if not _IS_OLD:
        return lobe
    return replace(lobe, shape=(*lobe.shape, ("roughness", roughness)), settings=(*lobe.settings, ("disney", 1.0)))


def old_base(feed: Socket, owner: Owner, base: Value, amount: Value) -> Value:
    """The colour of Principled's diffuse part before Blender 4.0, where some of it goes beneath the surface."""
    return owner.program.mixed(amount, base, colour(feed.input("Subsurface Color"), owner).at_least(0.0))


def _lobe(
    feed: Socket,
    owner: Owner,
    prefix: str,
    method: str,
    weight: Value,
    albedo: Value,
    scale: Value,
    ior: Value,
    entry_alpha: Value | None,
) -> Lobe:
    """prefix: of the inputs' names; scale: of the radius; entry_alpha: None where all enter by the cosine."""
    is_new = _has_legacy(feed.node)
    is_length = method == ("RANDOM_WALK" if _IS_OLD else "RANDOM_WALK_SKIN")
    is_similar = is_new and method == "RANDOM_WALK"
    radius = colour(feed.input(f"{prefix}Radius"), owner) * scale * (1.0 if is_length or is_similar else _OF_BURLEY)
    anisotropy = number(feed.input(f"{prefix}Anisotropy"), owner)
    low, high = (-0.99, 0.99 if is_similar else 0.9) if is_new else (0.0, 0.9)
    own_ior = number(feed.input(f"{prefix}IOR"), owner) if is_length else ior
    shape = (
        ("albedo", albedo.widened().clamped()),
        ("radius_m", radius.at_least(0.0).widened()),
        ("anisotropy", anisotropy.at_least(low).at_most(high)),
        ("ior", own_ior.at_least(1.01).at_most(3.8)),
        ("entry_alpha", owner.program.number(1.0) if entry_alpha is None or is_length else entry_alpha),
    )
    settings = (
        ("cosine_entry", 1.0 if entry_alpha is None or method == "BURLEY" else 0.5 if is_length else 0.0),
        ("is_diffusion_length", float(is_length)),
        ("is_similar", float(is_similar)),
        ("is_always_walked", float(_WALKS_AFTER_DIFFUSE and method != "BURLEY")),
    )
    return Lobe("subsurface", (("color", weight.widened()),), shape, settings)


def _has_legacy(shader: bpy.types.Node) -> bool:
    """Whether the random walk is the one that came beside an older one, which is then named so."""
    name = "falloff" if hasattr(shader, "falloff") else "subsurface_method"
    return "RANDOM_WALK_LEGACY" in shader.bl_rna.properties[name].enum_items
