"""The stability table: where each formula fails, and what the engine does there.

A row is the worst of a walk to a limit: of the seed's printed form in float32, where one is printed, and of the
engine's in float32, both against the engine's in float64, which the oracles test; GGX under a light against brute
force, with the method chosen; and whole renders.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass

import numpy as np
from pivot_core.shading import METHODS, ggx_gaussian_light, ggx_sphere_light
from pivot_core.tables import ggx_sptd

from tests.core import printed_forms
from tests.core.ggx_reference import LEAST_VALUE, UP, Floats, ggx_under_cap, ggx_under_gaussian
from tests.core.stability import Sweep, as_vector
from tests.core.stability_bounces import bounce_renders
from tests.core.stability_scenes import edge_renders
from tests.core.test_stability import SWEEPS
from tests.core.test_stability_linear import SWEEPS as LINEAR_SWEEPS

BUDGET_PERCENT = 2.0
WORST_OF_GAUSSIANS = 0.25  # what ggx_gaussian_light.h states of any light


@dataclass(frozen=True)
class Row:
    what: str  # "functions", "GGX under a light", "GGX under a Gaussian", "renders"
    name: str
    limit: str
    printed_error: float | None  # relative; None where no seed prints a form
    error: float
    bound: float
    method: str


def function_rows() -> Iterator[Row]:
    for sweep in (*SWEEPS, *LINEAR_SWEEPS):
        form = printed_forms.printed_form(sweep.function)
        printed = None if form is None else max(printed_error(sweep, form, t) for t in sweep.walk)
        yield Row("functions", sweep.name, sweep.limit, printed, sweep.worst()[0], sweep.bound, "")


def printed_error(sweep: Sweep, form: Callable[..., object], t: float) -> float:
    """As Sweep.error, of the printed form."""
    inputs = [x if isinstance(x, str) else np.asarray(x, np.float32) for x in sweep.inputs(t)]
    exact = as_vector(sweep.function(*[x if isinstance(x, str) else x.astype(np.float64) for x in inputs]))
    with np.errstate(all="ignore"):
        value = as_vector(form(*inputs))
    if not np.isfinite(value).all():
        return np.inf
    size, difference = float(np.linalg.norm(exact)), float(np.linalg.norm(value - exact))
    return difference / size if size > 0 else difference


@dataclass(frozen=True)
class LightWalk:
    """case(t): alpha, wo, the light's axis and half-angle."""

    limit: str
    walk: list[float]
    case: Callable[[float], tuple[float, Floats, Floats, float]]


def direction(theta: float, azimuth: float = 0.0) -> Floats:
    return np.array([np.sin(theta) * np.cos(azimuth), np.sin(theta) * np.sin(azimuth), np.cos(theta)])


def mirrored(theta: float, by: float = 0.0) -> Floats:
    """The mirror direction of a view at theta, lowered by an angle."""
    return direction(theta + by, np.pi)


def powers(first: float, last: float) -> list[float]:
    return list(10.0 ** np.linspace(first, last, 7))


LIGHT_WALKS = (
    LightWalk("alpha -> 1e-3", powers(0, -3), lambda a: (a, direction(0.8), mirrored(0.8, 0.3 * a), 0.05)),
    LightWalk("alpha -> 1", powers(-1, 0), lambda a: (a, direction(0.8), mirrored(0.8), 0.3)),
    LightWalk("view -> 89.4 deg", powers(0, -2), lambda t: (0.2, direction(np.pi / 2 - t), mirrored(0.8), 0.2)),
    LightWalk(
        "light across the horizon",
        list(np.linspace(1.5, -0.95, 8)),
        lambda s: (0.3, direction(1.2), direction(np.pi / 2 - 0.3 * s, np.pi), 0.3),
    ),
    LightWalk("half-angle -> 1e-6 rad", powers(-1, -6), lambda p: (0.1, direction(1.0), mirrored(1.0, 0.02), p)),
    LightWalk("half-angle -> pi / 2", powers(0, -4), lambda t: (0.3, direction(0.6), mirrored(0.6), np.pi / 2 - t)),
    LightWalk("light surrounds -wo", list(np.linspace(0.9, 1.5, 7)), lambda p: (0.4, direction(1.3), mirrored(1.9), p)),
    LightWalk("mirror, tiny light, grazing", powers(-2, -5), lambda p: (1e-3, direction(1.5), mirrored(1.5), p)),
)


def light_rows() -> Iterator[Row]:
    for walk in LIGHT_WALKS:
        worst, printed, method = -1.0, 0.0, ""
        for t in walk.walk:
            alpha, wo, axis, half_angle = walk.case(t)
            exact = ggx_under_cap(alpha, wo, axis, half_angle, resolution=300)
            value, _, chosen = ggx_sphere_light(alpha, wo, axis, half_angle, BUDGET_PERCENT)
            least = max(exact, LEAST_VALUE)
            error = abs(float(value) - exact) / least
            if not error <= worst:  # NaN too
                worst, method = error, METHODS[int(chosen)]
            printed = max(printed, abs(printed_sptd(alpha, wo, axis, half_angle) - exact) / least)
        yield Row("GGX under a light", "ggx_sphere_light", walk.limit, printed, worst, BUDGET_PERCENT / 100, method)


def printed_sptd(alpha: float, wo: Floats, axis: Floats, half_angle: float) -> float:
    """One SPTD of the table, cut at the horizon by the printed forms; not finite: infinite. [Dupuy17 (17-19)]"""
    pivot, delta, _, amplitude = ggx_sptd(alpha, wo)
    caps = axis, 2 * np.sin(half_angle / 2) ** 2, UP, 1.0
    with np.errstate(all="ignore"):
        value = float(amplitude * printed_forms.sptd_uniform_integral2(*caps, pivot, delta))
    return value if np.isfinite(value) else np.inf


def lowered(sharpness: float) -> LightWalk:
    """The axis sinks from above to far below the horizon: behind the surface."""
    steps = list(np.linspace(0.45, -1.2, 12))
    return LightWalk(
        f"axis goes behind, sharpness {sharpness:g}",
        steps,
        lambda s: (0.3, direction(1.2), direction(np.pi / 2 - s, np.pi), sharpness),
    )


GAUSSIAN_WALKS = (
    *(
        LightWalk(
            f"sharpness 1e-3 .. 1e7, alpha {a:g}",
            decades,
            lambda x, a=a: (a, direction(0.8), mirrored(0.8, 0.3 * a), x),
        )
        for a in (1e-3, 0.05, 0.3, 1.0)
        for decades in [list(10.0 ** np.linspace(-3, 7, 11))]
    ),
    *(
        LightWalk(
            f"alpha 1e-3 .. 1, sharpness {x:g}",
            powers(0, -3),
            lambda a, x=x: (a, direction(0.8), mirrored(0.8, 0.3 * a), x),
        )
        for x in (1.0, 100.0, 1e5)
    ),
    LightWalk("view -> 89.4 deg", powers(0, -2), lambda t: (0.2, direction(np.pi / 2 - t), mirrored(0.8), 50.0)),
    LightWalk(
        "mirror, grazing", powers(0, -2), lambda t: (0.2, direction(np.pi / 2 - t), mirrored(np.pi / 2 - t), 50.0)
    ),
    *(lowered(x) for x in (5.0, 6.0, 50.0, 1000.0)),
)


def gaussian_rows() -> Iterator[Row]:
    """Errors are relative to a twentieth at least of what the light gives in the highlight."""
    for walk in GAUSSIAN_WALKS:
        worst, printed, method = -1.0, 0.0, ""
        for t in walk.walk:
            alpha, wo, axis, sharpness = walk.case(t)
            exact = ggx_under_gaussian(alpha, wo, axis, sharpness)
            scale = max(exact, 0.05 * ggx_under_gaussian(alpha, wo, wo * [-1, -1, 1], sharpness))
            value, by_points, by_form = (
                float(ggx_gaussian_light(alpha, wo, axis, sharpness, way)[0])
                for way in ("AUTO", "POINTS", "ANISOTROPIC")
            )
            error = abs(value - exact) / scale if value >= 0 else np.inf
            if not error <= worst:  # NaN too
                worst, method = error, "POINTS" if value == by_points else "CAPS"
            printed = max(printed, abs(by_form - exact) / scale)
        yield Row("GGX under a Gaussian", "ggx_gaussian_light", walk.limit, printed, worst, WORST_OF_GAUSSIANS, method)


def render_rows() -> Iterator[Row]:
    for made in (*edge_renders(), *bounce_renders()):
        error = made.error if made.is_finite else np.inf
        yield Row("renders", made.integrator, made.scene, None, error, made.bound, made.settings)
