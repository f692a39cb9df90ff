"""What lies over what in Principled: its coat, and its highlight where that is anisotropic."""

from __future__ import annotations

from dataclasses import replace

from .highlight import Highlight, clearcoat, coat, sides
from .nodes import Owner, Socket, colour, is_constant, normal, number, tangent
from .program import Program, Value
from .surface import Surface


def rotation(feed: Socket, owner: Owner) -> Value:
    target = feed.find_input("Rotation", "Anisotropic Rotation")
    return owner.program.number(0.0) if target is None else number(target, owner)


_CURVE = (
    "conductor_f0", "conductor_f90", "conductor_dip", "conductor_weight", "dielectric_weight", "dielectric_ior",
    "dielectric_tint",
)  # fmt: skip


def brushed(whole: Surface, feed: Socket, owner: Owner) -> Surface:
    """Principled with its highlight as anisotropic as it is."""
    if is_constant(feed.input("Anisotropic"), 0.0) or whole.gloss() == 0:
        return whole
    alphas = sides(whole.alpha, number(feed.input("Anisotropic"), owner))
    return replace(_apart(whole, *alphas, rotation(feed, owner)), tangent=tangent(feed, owner))


def _apart(whole: Surface, alpha_x: Value, alpha_y: Value, turns: Value) -> Surface:
    """A base with its highlight beside it, and beneath that what the base itself would leave to its diffuse lobe."""
    program, dull = whole.program, Surface.of(whole.program)
    reaches = program.number(1.0)
    if not whole.dielectric_weight.is_always(0):
        alpha = alpha_x if alpha_x == alpha_y else (alpha_x * alpha_y).root()
        reaches = beneath_dielectric(
            program, whole.normal, alpha, whole.dielectric_ior, whole.dielectric_tint, whole.multiscatter
        )[0]
    curve = tuple((name, getattr(whole, name)) for name in _CURVE)
    white = program.colour((1, 1, 1))
    highlight = Highlight("anisotropic", curve, white, alpha_x, alpha_y, turns, whole.multiscatter)
    none = {name: getattr(dull, name) for name in ("alpha", *_CURVE)}
    return replace(whole, **none, diffuse=whole.diffuse * reaches, highlights=(*whole.highlights, highlight))


def beneath_dielectric(
    program: Program, turned: Value | None, alpha: Value, ior: Value, f0_tint: Value, multiscatter: bool
) -> tuple[Value, Value]:
    """What a layer of dielectric leaves of light beneath it, and how many times its thickness a ray goes in it."""
    about = program.op("normal") if turned is None else turned
    result = program.op("dielectric_layer", about, alpha, ior, f0_tint, program.number(float(multiscatter)))
    return result[0], result[1]


def coated(whole: Surface, feed: Socket, owner: Owner) -> Surface:
    """Principled beneath its coat, which takes from it what it reflects and absorbs. [Cycles 4.5 svm/closure.h]

    Before Blender 4.0 that was Clearcoat, which takes nothing. [Cycles 3.4 svm/closure.h]
    """
    program, is_new = owner.program, feed.find_input("Coat Weight") is not None
    weight = number(feed.input("Coat Weight", "Clearcoat"), owner).at_least(0.0)
    if weight.is_always(0):
        return whole
    roughness = number(feed.input("Coat Roughness", "Clearcoat Roughness"), owner).clamped()
    alpha = roughness * roughness
    turned = normal(feed, owner, "Coat Normal", "Clearcoat Normal")
    normal_of_coat = None if turned == whole.normal else program.op("normal") if turned is None else turned
    if not is_new:
        return replace(whole, highlights=(*whole.highlights, clearcoat(program, alpha, weight * 0.25, normal_of_coat)))
    ior, white = number(feed.input("Coat IOR"), owner).at_least(1.0), program.colour((1, 1, 1))
    reaches, path = beneath_dielectric(program, turned, alpha, ior, white, multiscatter=True)
    left = (1.0 - weight * (1.0 - reaches)).clamped()
    tint = colour(feed.input("Coat Tint"), owner).at_least(0.0)
    if not tint.is_always(1):
        left = program.mixed(weight, white, program.each("math_power", tint, path)) * left
        if whole.gloss() > 0:  # a base's dielectric has no colour that scales it at every angle
            whole = _apart(whole, whole.alpha, whole.alpha, program.number(0.0))
    coats = () if ior.is_always(1) else (coat(program, alpha, ior, weight, normal_of_coat),)
    beneath = replace(whole.scaled(left), opacity=whole.opacity)
    return replace(beneath, highlights=beneath.highlights + coats)
