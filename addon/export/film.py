"""Thin films on dielectrics and metals: as thin as light's waves are long, which colours what is mirrored."""

from __future__ import annotations

from dataclasses import dataclass

from .highlight import Highlight, sides
from .nodes import Owner, Socket, is_constant, normal, number
from .program import Value

_NEXT_TO_NONE_NM = 0.1  # so thick Cycles takes a film for one


@dataclass(frozen=True)
class Film:
    ior: Value
    thickness_nm: Value

    @staticmethod
    def of(feed: Socket, owner: Owner) -> Film | None:
        """That of a node; None without."""
        target = feed.find_input("Thin Film Thickness")
        if target is None:
            return None
        thickness_nm = number(target, owner).at_least(0.0)
        if thickness_nm.is_constant and thickness_nm.numbers[0] <= _NEXT_TO_NONE_NM:
            return None
        return Film(number(feed.input("Thin Film IOR"), owner).at_least(1.0), thickness_nm)

    def on_dielectric(self) -> dict[str, Value]:
        """What a Dielectric is told of it."""
        return {"film_ior": self.ior, "film_nm": self.thickness_nm}

    def on_metal(self, metal: dict[str, Value]) -> tuple[tuple[str, Value], ...]:
        """The curve of a "metal_film" highlight. metal: what physical_metal() or metal_of_f82() gives."""
        return tuple((metal | {"film_ior": self.ior, "film_nm": self.thickness_nm}).items())

    def highlight(
        self, feed: Socket, owner: Owner, alpha: Value, rotation: Value, ior: Value, tint: Value, weight: Value,
        multiscatter: bool,
    ) -> Highlight:  # fmt: skip
        """Principled's, of so much of a dielectric."""
        curve = {"ior": ior, "film_ior": self.ior, "film_nm": self.thickness_nm, "f0_tint": tint.widened()}
        alphas = (alpha, alpha)
        if not is_constant(feed.input("Anisotropic"), 0.0):
            alphas = sides(alpha, number(feed.input("Anisotropic"), owner))
        return Highlight("thin_film", tuple(curve.items()), weight.widened(), *alphas, rotation, multiscatter)

    def beneath(
        self, feed: Socket, owner: Owner, alpha: Value, ior: Value, tint: Value, multiscatter: bool
    ) -> Value:  # fmt: skip
        """What it leaves of light beneath the dielectric."""
        turned, program = normal(feed, owner), owner.program
        about = program.op("normal") if turned is None else turned
        glossiness = (alpha, ior, tint.widened(), program.number(float(multiscatter)))
        return program.op("thin_film_layer", about, *glossiness, self.ior, self.thickness_nm)


def physical_metal(n: Value, k: Value) -> dict[str, Value]:
    """A metal beneath a film, by its index of refraction n + i k."""
    program = n.program
    return {"n": n, "k": k, "f82": program.colour((0, 0, 0)), "has_f82": program.number(0.0)}


def metal_of_f82(f0: Value, edge_tint: Value) -> dict[str, Value]:
    """A metal of F82's curve beneath a film: the index that tells its phases. [Cycles 5.2 closure/bsdf_microfacet.h]"""
    r = f0.widened().at_most(0.999)
    f82 = (r + (1.0 - r) * (6 / 7) ** 5) * edge_tint.widened()
    densest, thinnest = (1.0 + r.root()) / (1.0 - r.root()), (1.0 - r) / (1.0 + r)
    n = densest + f82 * (thinnest - densest)
    more, less = n + 1.0, n - 1.0
    k = ((r * more * more - less * less).at_least(0.0) / (1.0 - r)).root()
    return {"n": n, "k": k, "f82": f82, "has_f82": f0.program.number(1.0)}
