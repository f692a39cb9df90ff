"""Highlights that are lobes of their own: coats, conductors of an index of refraction, and microfacets that are
anisotropic or not GGX's."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

from .program import Program, Value


@dataclass(frozen=True)
class Highlight:
    """Numbers of one of the core's lobes of core/bsdf/lobes/anisotropic_ggx.h, thin_film.h, metal_film.h,
    ashikhmin_shirley.h or clearcoat.h, which say what they are.

    curve: what its microfacets reflect, of the lobe that `kind` names. normal: world space; None: the surface's.
    """

    kind: str  # "anisotropic", "conductor", "thin_film", "metal_film", "ashikhmin_shirley" or "clearcoat"
    curve: tuple[tuple[str, Value], ...]
    color: Value
    alpha_x: Value
    alpha_y: Value
    rotation: Value
    multiscatter: bool
    normal: Value | None = None
    is_coat: bool = False
    is_beckmann: bool = False

    @property
    def is_anisotropic(self) -> bool:
        return self.alpha_x != self.alpha_y

    def scaled(self, weight: Value) -> Highlight:
        return replace(self, color=self.color * weight)

    def base(self) -> dict[str, Any]:
        """What a base has of it: as rough all around, about the surface's normal."""
        alpha = self.alpha_x if not self.is_anisotropic else (self.alpha_x * self.alpha_y).root()
        return self._curve_of_base() | {"alpha": alpha, "multiscatter": self.multiscatter}

    def _curve_of_base(self) -> dict[str, Value]:
        values, part = dict(self.curve), share(self.color)
        if self.kind in {"conductor", "metal_film"}:
            less, more, k2 = values["n"] - 1.0, values["n"] + 1.0, values["k"] * values["k"]
            f0 = (less * less + k2) / (more * more + k2)
            return {"conductor_f0": f0 * self.color, "conductor_f90": self.color, "conductor_weight": part}
        if self.kind == "ashikhmin_shirley":
            return {"conductor_f0": self.color, "conductor_f90": self.color, "conductor_weight": part}
        if self.kind == "clearcoat":
            return {"dielectric_weight": values["weight"] * part, "dielectric_ior": self.color.program.number(1.5)}
        if self.kind == "thin_film":
            bare = {"dielectric_weight": part, "dielectric_ior": values["ior"]}
            return bare | {"dielectric_tint": values["f0_tint"] * hue(self.color)}
        scaled = dict.fromkeys(("conductor_f0", "conductor_f90", "conductor_dip"), self.color)
        scaled |= {"conductor_weight": part, "dielectric_weight": part, "dielectric_tint": hue(self.color)}
        return {name: value * scaled[name] if name in scaled else value for name, value in values.items()}

    def lobe(self) -> tuple[str, dict[str, Value], dict[str, float]]:
        """As Surface.core_shader gives lobes to the core: a further base where that is the same."""
        settings = {"multiscatter": float(self.multiscatter)}
        is_grey = len(set(self.color.parts)) == 1
        is_plain = self.kind == "anisotropic" and not self.is_anisotropic and not self.is_beckmann
        if is_plain and self.normal is None and is_grey:
            return "base", self._curve_of_base() | {"alpha": self.alpha_x}, settings
        own = {"color": self.color, "alpha_x": self.alpha_x, "alpha_y": self.alpha_y, "rotation": self.rotation}
        if self.normal is not None:
            own["normal"] = self.normal.program.registers(self.normal)
        if self.kind == "ashikhmin_shirley":
            return self.kind, own, {}
        if self.kind == "clearcoat":
            own |= {"weight": dict(self.curve)["weight"] * share(self.color), "alpha": self.alpha_x}
            return self.kind, {name: own[name] for name in ("weight", "alpha", "normal") if name in own}, {}
        return self.kind, dict(self.curve) | own, settings | {"beckmann": float(self.is_beckmann)}


def share(weight: Value) -> Value:
    """The one number of a weight that may be a colour."""
    return weight[0] if len(set(weight.parts)) == 1 else weight.mean()


def hue(weight: Value) -> Value:
    """What of a weight its share leaves out."""
    return weight.program.colour((1, 1, 1)) if len(set(weight.parts)) == 1 else weight / share(weight)


def coat(program: Program, alpha: Value, ior: Value, weight: Value, normal: Value | None) -> Highlight:
    curve = {"conductor_weight": program.number(0.0), "dielectric_weight": weight, "dielectric_ior": ior}
    white = program.colour((1, 1, 1))
    return Highlight(
        "anisotropic", tuple(curve.items()), white, alpha, alpha, program.number(0.0), True, normal, is_coat=True
    )


def clearcoat(program: Program, alpha: Value, weight: Value, normal: Value | None) -> Highlight:
    """That of Principled before Blender 4.0."""
    white, turns = program.colour((1, 1, 1)), program.number(0.0)
    alpha = alpha.at_most(0.9)  # as the lobe has it
    return Highlight("clearcoat", (("weight", weight),), white, alpha, alpha, turns, False, normal, is_coat=True)


def sides(alpha: Value, anisotropic: Value) -> tuple[Value, Value]:
    """GGX alpha along the tangent and across it, of Principled and Metallic BSDF. [Cycles 4.5 svm/closure.h]"""
    aspect = (1.0 - anisotropic.clamped() * 0.9).root()
    return (alpha / aspect).at_most(1.0), alpha * aspect


def sides_of_glossy(alpha: Value, anisotropy: Value) -> tuple[Value, Value]:
    """The same of Glossy BSDF, whose highlight is long across the tangent where anisotropy is above 0."""
    program = alpha.program
    bounded = anisotropy.at_least(-0.99).at_most(0.99)
    rest = 1.0 - program.each("math_absolute", bounded)
    short, long = alpha * rest, (alpha / rest).at_most(1.0)
    is_along = program.each("math_less_than", bounded, 0.0)
    return program.mixed(is_along, short, long), program.mixed(is_along, long, short)


def f82(f0: Value, edge_tint: Value, weight: Value) -> dict[str, Value]:
    """So much of a metal whose reflectance at 82 degrees is Schlick's times a tint. [Cycles 4.5 closure/bsdf_util.h]"""
    at_82 = (6 / 7) ** 5
    dip = (f0 + (1.0 - f0) * at_82) * (1.0 - edge_tint) * (7.0 / (at_82 * 6 / 7))
    return {
        "conductor_f0": f0 * weight,
        "conductor_f90": weight.widened(),
        "conductor_dip": dip * weight,
        "conductor_weight": weight,
    }
