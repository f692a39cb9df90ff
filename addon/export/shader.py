"""Shader nodes as surfaces the core can shade with.

A shader the core has no lobe for is reported once and becomes its nearest meaning.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

import bpy

from . import cloth, subsurface
from .census import INPUTS
from .dielectric import Dielectric
from .film import Film, metal_of_f82, physical_metal
from .hair import hair, principled_hair
from .highlight import Highlight, f82, sides, sides_of_glossy
from .layers import rotation
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
from .principled import principled
from .program import Program, Value
from .shader_inputs import any_ior, emitted, ggx_alpha, is_beckmann, is_multiscatter, let_through
from .surface import Surface, added

MAX_LOBES = 3  # of the core, beside a base


def grey(program: Program) -> Surface:
    """Cycles' for objects without a material."""
    return Surface.of(program, diffuse=program.colour((0.8, 0.8, 0.8)))


def material_surface(tree: bpy.types.NodeTree, owner: Owner) -> Surface:
    """What a material's node tree stands for."""
    output = output_socket(tree, "Surface")
    if output is None:  # as in Cycles, and as where nothing is linked to it
        return Surface.of(owner.program)
    _leave_out(output, owner)
    try:
        displacement = output.find_input("Displacement")
        if displacement is not None and is_linked(displacement):
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
    if feed.socket.type != "SHADER":  # a colour or number shines, as in Cycles
        return Surface.of(owner.program, emission=colour(target, owner, unknown=1.0))
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
    if any(surface.is_holdout for surface in scaled):
        owner.warn(feed.node, "a Holdout is not supported beside other shaders, its part is black")
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
    alpha, anisotropy = ggx_alpha(feed, owner), feed.find_input("Anisotropy")
    is_even = anisotropy is None or is_constant(anisotropy, 0.0)
    alphas = None if is_even else sides_of_glossy(alpha, number(anisotropy, owner))
    if feed.node.distribution == "ASHIKHMIN_SHIRLEY":
        return _metal(feed, owner, {}, alpha, alphas, "ashikhmin_shirley", tint.widened())
    curve = {"conductor_f0": tint, "conductor_f90": tint, "conductor_weight": owner.program.number(1.0)}
    return _metal(feed, owner, curve, alpha, alphas)


def _metallic(feed: Socket, owner: Owner) -> Surface:
    alpha, anisotropy = ggx_alpha(feed, owner), feed.input("Anisotropy")
    alphas = None if is_constant(anisotropy, 0.0) else sides(alpha, number(anisotropy, owner))
    film = Film.of(feed, owner)
    if feed.node.fresnel_type == "PHYSICAL_CONDUCTOR":
        n, k = (colour(feed.input(name), owner).at_least(0.0).widened() for name in ("IOR", "Extinction"))
        if film is not None:
            return _metal(feed, owner, dict(film.on_metal(physical_metal(n, k))), alpha, alphas, "metal_film")
        return _metal(feed, owner, {"n": n, "k": k}, alpha, alphas, "conductor")
    base, edge_tint = (colour(feed.input(name), owner).clamped() for name in ("Base Color", "Edge Tint"))
    if film is not None:
        return _metal(feed, owner, dict(film.on_metal(metal_of_f82(base, edge_tint))), alpha, alphas, "metal_film")
    return _metal(feed, owner, f82(base, edge_tint, owner.program.number(1.0)), alpha, alphas)


def _metal(
    feed: Socket,
    owner: Owner,
    curve: dict[str, Value],
    alpha: Value,
    alphas: tuple[Value, Value] | None = None,
    kind: str = "anisotropic",
    tint: Value | None = None,
) -> Surface:
    """A highlight alone. alphas: GGX alpha along the tangent and across it, if they differ; tint: None for white."""
    program, turned, multiscatter = owner.program, normal(feed, owner), is_multiscatter(feed, owner)
    beckmann = is_beckmann(feed)
    if alphas is None and kind == "anisotropic" and not beckmann:
        return Surface.of(program, **curve, alpha=alpha, multiscatter=multiscatter, normal=turned)
    about = program.number(0.0) if alphas is None else rotation(feed, owner)
    white = program.colour((1, 1, 1))
    highlight = Highlight(
        kind,
        tuple(curve.items()),
        tint or white,
        *(alphas or (alpha, alpha)),
        about,
        multiscatter,
        is_beckmann=beckmann,
    )
    along = None if alphas is None else tangent(feed, owner)
    return Surface.of(program, highlights=(highlight,), tangent=along, normal=turned)


def _toon(feed: Socket, owner: Owner) -> Surface:
    tint = colour(feed.input("Color"), owner).at_least(0.0).widened()
    shape = (
        ("size", number(feed.input("Size"), owner).clamped()),
        ("smooth", number(feed.input("Smooth"), owner).clamped()),
        ("glossy", owner.program.number(float(feed.node.component == "GLOSSY"))),
    )
    return Surface.of(owner.program, lobes=(Lobe("toon", (("color", tint),), shape),), normal=normal(feed, owner))


def _glass(feed: Socket, owner: Owner) -> Surface:
    tint = colour(feed.input("Color"), owner).at_least(0.0)
    return _boundary(feed, owner, reflection=tint, transmission=tint, multiscatter=is_multiscatter(feed, owner))


def _refraction(feed: Socket, owner: Owner) -> Surface:
    """All that can comes through, in one bounce: Cycles gives nothing back of what that loses."""
    is_multiscatter(feed, owner)
    none, zero = owner.program.colour((0, 0, 0)), owner.program.number(0.0)
    tint = colour(feed.input("Color"), owner).at_least(0.0)
    return _boundary(feed, owner, reflection=none, transmission=tint, fresnel=zero)


def _boundary(feed: Socket, owner: Owner, **given: Value | bool) -> Surface:
    film = Film.of(feed, owner)
    above = {} if film is None else film.on_dielectric()
    given |= {"alpha": ggx_alpha(feed, owner), "ior": any_ior(feed, owner), "beckmann": is_beckmann(feed)}
    dielectric = Dielectric.of(owner.program, **above, **given)
    return Surface.of(owner.program, dielectrics=(dielectric,), normal=normal(feed, owner))


def _transparent(feed: Socket, owner: Owner) -> Surface:
    return let_through(colour(feed.input("Color"), owner).at_least(0.0))


def _holdout(_: Socket, owner: Owner) -> Surface:
    return Surface.of(owner.program, is_holdout=True)


def _emission(feed: Socket, owner: Owner) -> Surface:
    return Surface.of(owner.program, emission=emitted(feed.input("Color"), feed.input("Strength"), owner))


def _leave_out(feed: Socket, owner: Owner) -> None:
    """Say which inputs of a node are left out."""
    for identifier, neutral in INPUTS[feed.node.bl_idname].neutral_values():
        target = feed.find_input(identifier)
        if target is not None and (is_linked(target) if neutral is None else not is_constant(target, neutral)):
            owner.warn(feed.node, f"{target.socket.name} is not supported, it is left out")


_SHADERS: dict[str, Callable[[Socket, Owner], Surface]] = {
    "BSDF_PRINCIPLED": principled,
    "BSDF_DIFFUSE": _diffuse,
    "BSDF_TRANSLUCENT": _translucent,
    "BSDF_SHEEN": cloth.sheen,
    "BSDF_VELVET": cloth.velvet,
    "BSDF_TOON": _toon,
    "BSDF_HAIR": hair,
    "BSDF_HAIR_PRINCIPLED": principled_hair,
    "SUBSURFACE_SCATTERING": subsurface.node,
    "BSDF_GLOSSY": _glossy,
    "BSDF_ANISOTROPIC": _glossy,
    "BSDF_METALLIC": _metallic,
    "BSDF_GLASS": _glass,
    "BSDF_REFRACTION": _refraction,
    "BSDF_TRANSPARENT": _transparent,
    "BSDF_RAY_PORTAL": _transparent,  # as it is where no other place is linked to it
    "HOLDOUT": _holdout,
    "EMISSION": _emission,
    "BACKGROUND": _emission,
    "MIX_SHADER": _mix,
    "ADD_SHADER": _add,
}
