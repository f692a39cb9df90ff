"""What the core can shade with, as a value that shader nodes scale and add."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from .colour import Colour


def _black() -> Colour:
    return np.zeros(3)


def _white() -> Colour:
    return np.ones(3)


@dataclass(frozen=True)
class Surface:
    """A Lambert lobe, one GGX lobe of two Fresnel parts, and emission: the arguments of pivot_core.Material."""

    diffuse: Colour = field(default_factory=_black)
    alpha: float = 1.0
    conductor_f0: Colour = field(default_factory=_black)
    conductor_f90: Colour = field(default_factory=_black)
    conductor_weight: float = 0.0
    dielectric_weight: float = 0.0
    dielectric_ior: float = 1.5
    dielectric_tint: Colour = field(default_factory=_white)
    multiscatter: bool = False
    emission: Colour = field(default_factory=_black)

    def scaled(self, weight: float) -> Surface:
        return replace(
            self,
            diffuse=self.diffuse * weight,
            conductor_f0=self.conductor_f0 * weight,
            conductor_f90=self.conductor_f90 * weight,
            conductor_weight=self.conductor_weight * weight,
            dielectric_weight=self.dielectric_weight * weight,
            emission=self.emission * weight,
        )

    def gloss(self) -> float:
        """Roughly what the GGX lobe reflects: which of two lobes is the stronger."""
        f0 = ((self.dielectric_ior - 1) / (self.dielectric_ior + 1)) ** 2
        return float(np.mean(self.conductor_f0 + self.conductor_f90)) / 2 + self.dielectric_weight * f0

    def core_material(self, core: Any) -> Any:
        """A pivot_core.Material."""
        return core.Material(
            diffuse=self.diffuse.tolist(),
            alpha=self.alpha,
            conductor_f0=self.conductor_f0.tolist(),
            conductor_f90=self.conductor_f90.tolist(),
            conductor_weight=self.conductor_weight,
            dielectric_weight=self.dielectric_weight,
            dielectric_ior=self.dielectric_ior,
            dielectric_tint=self.dielectric_tint.tolist(),
            multiscatter=self.multiscatter,
            emission=self.emission.tolist(),
        )


def added(a: Surface, b: Surface) -> tuple[Surface, bool]:
    """The sum of two, and whether it is exact: where their GGX lobes differ in shape, both take the stronger one's."""
    strong, weak = (a, b) if a.gloss() >= b.gloss() else (b, a)
    same_lobe = weak.gloss() == 0 or (strong.alpha, strong.multiscatter) == (weak.alpha, weak.multiscatter)
    dense, thin = (a, b) if a.dielectric_weight >= b.dielectric_weight else (b, a)
    same_dielectric = thin.dielectric_weight == 0 or (
        dense.dielectric_ior == thin.dielectric_ior and bool(np.all(dense.dielectric_tint == thin.dielectric_tint))
    )
    total = Surface(
        diffuse=a.diffuse + b.diffuse,
        alpha=strong.alpha,
        conductor_f0=a.conductor_f0 + b.conductor_f0,
        conductor_f90=a.conductor_f90 + b.conductor_f90,
        conductor_weight=a.conductor_weight + b.conductor_weight,
        dielectric_weight=a.dielectric_weight + b.dielectric_weight,
        dielectric_ior=dense.dielectric_ior,
        dielectric_tint=dense.dielectric_tint,
        multiscatter=strong.multiscatter,
        emission=a.emission + b.emission,
    )
    return total, same_lobe and same_dielectric
