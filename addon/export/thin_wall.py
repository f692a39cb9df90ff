"""Principled of walls too thin to bend light, panes and leaves: Thin Wall, from Blender 5.2 on. [Cycles 5.2
svm/closure.h]
"""

from __future__ import annotations

from .film import Film
from .lobe import Lobe
from .nodes import Owner, Socket, colour, is_constant, normal, number
from .program import Value
from .shader_inputs import any_ior, ggx_alpha, let_through
from .surface import Surface, added


def is_there(feed: Socket) -> bool:
    target = feed.find_input("Thin Wall")
    return target is not None and not is_constant(target, 0.0)


def glass(feed: Socket, owner: Owner, base: Value, weight: Value, film: Film | None) -> Surface:
    """So much of a pane; base: what of light that crosses it straight is left."""
    program, turned, alpha, ior = owner.program, normal(feed, owner), ggx_alpha(feed, owner), any_ior(feed, owner)
    about = program.op("normal") if turned is None else turned
    f0_tint = colour(feed.input("Specular Tint"), owner).at_least(0.0).widened()
    film_ior, film_nm = (program.number(1.0), program.number(0.0)) if film is None else (film.ior, film.thickness_nm)
    sides = program.op("thin_wall", about, ior, f0_tint, base.widened(), film_ior, film_nm)
    mirrored, through = sides[:3] * weight, sides[3:6] * weight
    share = mirrored.mean()
    pane = Surface.of(
        program,
        conductor_f0=mirrored,
        conductor_f90=mirrored,
        conductor_weight=share,
        weight=share,
        opacity=share,
        alpha=alpha,
        multiscatter=True,
        normal=turned,
    )
    if alpha.is_always(0):
        return added(pane, let_through(through))[0]
    half = ior - 0.5
    # Light is bent twice, the second time back. [KullaConty17, 40]
    spread = (alpha * (3.4 * (ior - 1.0).at_least(0.0) * half * half / (ior * ior * ior)).root()).clamped()
    frosted = Lobe("thin_glass", (("color", through),), (("alpha", spread),))
    return added(pane, Surface.of(program, lobes=(frosted,), normal=turned, opacity=through.mean()))[0]


def leaf(feed: Socket, owner: Owner, weight: Value) -> tuple[Value, Value]:
    """What subsurface scattering of a wall is: colours of light that stays on its side, and that comes through."""
    anisotropy, target = number(feed.input("Subsurface Anisotropy"), owner), feed.find_input("Diffuse Roughness")
    if target is not None and not is_constant(target, 0.0):
        owner.warn(feed.node, "the roughness of what scatters beneath a thin wall is not supported, it is shown as 0")
    stays, comes_through = ((0.5 * (1.0 + towards * anisotropy)).clamped() for towards in (-1.0, 1.0))
    return weight.widened() * stays, weight.widened() * comes_through
