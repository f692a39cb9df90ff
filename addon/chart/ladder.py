"""The settings a chart compares: lines of them, a method each, from fast to accurate. Direct light, the one light
transport that all methods have; and light that bounced once, for the methods that have it.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any

from .. import denoise


@dataclass(frozen=True)
class Rung:
    """One picture: a point of a method's line."""

    renderer: str  # "PIVOT", or another that is measured beside it
    method: str  # the line's name
    label: str  # the point's
    samples: int
    settings: dict[str, Any] = field(default_factory=dict)  # Pivot's: of scene.pivot

    @property
    def virtual_lights(self) -> int | None:
        """How many, where the line is of their number."""
        return self.settings.get("virtual_lights")


@dataclass(frozen=True)
class Ladder:
    """width_px: of the charted picture. The reference is Monte Carlo of reference_samples samples, in parts, of as
    many bounces as the rungs' settings say."""

    rungs: tuple[Rung, ...]
    width_px: int
    reference_samples: int
    max_bounces: int = 0

    def of(self, renderer: str) -> list[Rung]:
        """Of a renderer, those that this Blender can make."""
        rungs = [rung for rung in self.rungs if rung.renderer == renderer]
        return [rung for rung in rungs if "denoise" not in rung.settings or denoise.is_there()]


REFERENCE_PARTS = 4  # of equal size: their differences tell the reference's own noise
REFERENCE_SETTINGS = {"integrator": "MONTE_CARLO", "light_sampling": "JOINT"}

_MONTE_CARLO = {"JOINT": "Monte Carlo, joint", "SPTD": "Monte Carlo, SPTD", "MIS": "Monte Carlo, MIS"}
_ANALYTIC = {"AUTO": "Analytic", "EXACT": "Analytic, exact", "SPTD": "Analytic, SPTD", "LTC": "Analytic, LTC"}
_BUDGETS = (10.0, 5.0, 2.0, 1.0, 0.5)
_VIRTUAL_LIGHTS = {
    "AUTO": "Virtual lights, by number",
    "WIDENED": "by the formulas of 2024",
    "ANISOTROPIC": "by the formulas of 2015",
}


def pivot_rungs(monte_carlo: tuple[int, ...], analytic: tuple[int, ...], budget_samples: int) -> Iterator[Rung]:
    """monte_carlo, analytic: the samples of each point. budget_samples: the most along the error budget."""
    for name, method in _MONTE_CARLO.items():
        for samples in monte_carlo:
            settings = {"integrator": "MONTE_CARLO", "light_sampling": name}
            yield Rung("PIVOT", method, f"{samples}", samples, settings)
    for name, method in _ANALYTIC.items():
        for samples in analytic:
            settings = {"integrator": "ANALYTIC", "analytic_method": name, "error_budget": 2.0}
            yield Rung("PIVOT", method, f"{samples}", samples, settings)
    for budget in _BUDGETS:
        settings = {"integrator": "ANALYTIC", "analytic_method": "AUTO", "error_budget": budget, "adaptive": True}
        yield Rung("PIVOT", "Analytic, by budget", f"{budget:g} %", budget_samples, settings)


def cycles_rungs(samples: tuple[int, ...]) -> Iterator[Rung]:
    for count in samples:
        yield Rung("CYCLES", "Cycles", f"{count}", count)


def bounce_rungs(monte_carlo: tuple[int, ...], analytic: tuple[int, ...], lights: tuple[int, ...]) -> Iterator[Rung]:
    """Light that bounced once: by paths, and by so many virtual lights, whose formulas there are three of."""
    once = {"max_bounces": 1}
    for samples in monte_carlo:
        settings = {"integrator": "MONTE_CARLO", "light_sampling": "JOINT"} | once
        yield Rung("PIVOT", "Monte Carlo, joint", f"{samples}", samples, settings)
    virtual = {"integrator": "ANALYTIC", "indirect": "VSGL"} | once
    for samples in analytic:
        yield Rung("PIVOT", "Virtual lights", f"{samples}", samples, virtual)
    for name, method in _VIRTUAL_LIGHTS.items():
        for count in lights:
            settings = virtual | {"virtual_lights": count, "virtual_light_method": name}
            yield Rung("PIVOT", method, f"{count}", max(analytic), settings)
    for samples in monte_carlo:
        yield Rung("CYCLES", "Cycles", f"{samples}", samples, once)


def denoised_rungs(samples: tuple[int, ...]) -> Iterator[Rung]:
    """Light that bounced once, denoised."""
    settings = {"integrator": "MONTE_CARLO", "light_sampling": "JOINT", "max_bounces": 1, "denoise": "INDIRECT"}
    for count in samples:
        yield Rung("PIVOT", "Monte Carlo, denoised", f"{count}", count, settings)


FULL = Ladder((*pivot_rungs((1, 4, 16, 64, 256), (1, 4, 16, 64), 256), *cycles_rungs((1, 4, 16, 64, 256))), 240, 2048)
PANEL = Ladder(tuple(pivot_rungs((1, 4, 16, 64), (1, 4, 16), 64)), 160, 1024)
SMALL = Ladder((*pivot_rungs((1, 8), (1,), 4), *cycles_rungs((1, 8))), 32, 128)
_BOUNCED = bounce_rungs((1, 4, 16, 64), (1, 4, 16), (64, 256, 1024, 4096, 16384))
BOUNCE = Ladder((*_BOUNCED, *denoised_rungs((4, 16, 64))), 160, 1024, max_bounces=1)
SMALL_BOUNCE = Ladder((*bounce_rungs((1, 8), (1,), (64,)), *denoised_rungs((8,))), 32, 128, max_bounces=1)
LADDERS = {"FULL": FULL, "PANEL": PANEL, "SMALL": SMALL, "BOUNCE": BOUNCE, "SMALL_BOUNCE": SMALL_BOUNCE}
