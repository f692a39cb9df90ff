"""chi^2 tests of the samplers of caps, SPTDs and GGX under caps against their pdfs."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import pivot_core.distributions as pd
import pytest

from tests.core.chi_squared import Array, chi_squared_p, random_squares

COUNT = 40_000
SIGNIFICANCE = 1e-4
Z = np.array([0.0, 0.0, 1.0])


def towards(theta: float, phi: float = 0.4) -> Array:
    """The direction at the angle theta from z."""
    return np.array([np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi), np.cos(theta)])


def rings(versine: float, count: int = 24) -> Array:
    """Cells inside a cap, and one for the rest of the sphere."""
    inside = np.linspace(0, versine, count + 1)
    return inside if versine == 2 else np.append(inside, 2.0)


@dataclass(frozen=True)
class Case:
    """A sampler, its pdf, and rings about an axis along whose edges the pdf may be cut off."""

    name: str
    sample: Callable[[Array], Array]
    pdf: Callable[[Array], Array]
    axis: Array
    edges: Array


def case(name: str, sampler: Callable, pdf: Callable, arguments: tuple, axis: Array, edges: Array) -> Case:
    return Case(name, lambda u: sampler(*arguments, u), lambda omega: pdf(*arguments, omega), axis, edges)


def cap_case(versine: float) -> Case:
    axis = towards(2.1)
    return case(f"cap {versine}", pd.cap_sample, pd.cap_pdf, (axis, versine), axis, rings(versine))


def clipped_case(versine: float, theta: float, other: float) -> Case:
    """A cap whose axis is at theta from z, in a cap about z."""
    arguments = towards(theta), versine, Z, other
    name = f"cap {versine} at {theta} in cap {other}"
    axis, inner = (Z, other) if other < versine else (towards(theta), versine)
    return case(name, pd.cap_intersection_sample, pd.cap_intersection_pdf, arguments, axis, rings(inner))


def projected_case(versine: float, theta: float) -> Case:
    arguments = towards(theta), versine, Z
    name = f"projected cap {versine} at {theta}"
    return case(name, pd.projected_cap_sample, pd.projected_cap_pdf, arguments, arguments[0], rings(versine))


def uniform_case(delta: float) -> Case:
    u = towards(1.0)
    edges = 2 * np.linspace(0, 1, 49) ** 3
    return Case(
        f"uniform SPTD, delta {delta}",
        lambda random: pd.sptd_uniform_sample(u, delta, random),
        lambda omega: pd.sptd_uniform_eval(omega, u, delta),
        u,
        edges,
    )


def uniform_cap_case(delta: float, versine: float) -> Case:
    axis = towards(0.7, 1.0)
    arguments = axis, versine, towards(1.0), delta
    name = f"uniform SPTD, delta {delta}, in cap {versine}"
    return case(name, pd.sptd_uniform_cap_sample, pd.sptd_uniform_cap_pdf, arguments, axis, rings(versine, 32))


def uniform_clipped_case(delta: float, versine: float, theta: float) -> Case:
    arguments = towards(theta), versine, Z, 1.0, towards(1.0), delta
    name = f"uniform SPTD, delta {delta}, in cap {versine} at {theta} above the horizon"
    return case(
        name, pd.sptd_uniform_clipped_sample, pd.sptd_uniform_clipped_pdf, arguments, arguments[0], rings(versine)
    )


def cosine_case(delta: float) -> Case:
    u, cosine_axis = towards(1.0), -towards(0.8)
    # g(horizon of cosine_axis) bounds the density: rings about its axis have it for an edge
    axis, versine = pd.pivot_transform_cap(cosine_axis, 1.0, u, delta)
    return Case(
        f"cosine SPTD, delta {delta}",
        lambda random: pd.sptd_cosine_sample(u, delta, cosine_axis, random),
        lambda omega: pd.sptd_cosine_eval(omega, u, delta, cosine_axis),
        axis,
        rings(float(versine), 64),
    )


def cosine_cap_case(delta: float, versine: float, cosine_theta: float) -> Case:
    axis = towards(0.7, 1.0)
    u, cosine_axis = towards(1.0), towards(cosine_theta)
    return Case(
        f"cosine SPTD, delta {delta}, axis {cosine_theta}, in cap {versine}",
        lambda random: pd.sptd_cosine_cap_sample(axis, versine, u, delta, cosine_axis, random),
        lambda omega: pd.sptd_cosine_cap_pdf(axis, versine, u, delta, cosine_axis, omega),
        axis,
        rings(versine),
    )


def cosine_clipped_case(delta: float, versine: float, theta: float) -> Case:
    axis, u, cosine_axis = towards(theta), towards(1.0), towards(2.2, 1.2)
    return Case(
        f"cosine SPTD, delta {delta}, in cap {versine} at {theta} above the horizon",
        lambda random: pd.sptd_cosine_clipped_sample(axis, versine, Z, 1.0, u, delta, cosine_axis, random),
        lambda omega: pd.sptd_cosine_clipped_pdf(axis, versine, Z, 1.0, u, delta, cosine_axis, omega),
        axis,
        rings(versine),
    )


def ggx_case(theta_o: float, theta: float, versine: float, alpha_x: float, alpha_y: float) -> Case:
    axis = towards(theta, 0.4 + np.pi)
    arguments = towards(theta_o), axis, versine, alpha_x, alpha_y
    name = f"GGX {alpha_x} {alpha_y} seen from {theta_o} under cap {versine} at {theta}"
    return case(name, lambda *a: pd.ggx_cap_sample(*a)[0], pd.ggx_cap_pdf, arguments, axis, rings(versine, 48))


CASES = [
    *(cap_case(versine) for versine in (1e-6, 0.3, 1.0, 1.9, 2.0)),
    clipped_case(0.3, 0.5, 1.0),  # whole
    clipped_case(0.3, 1.2, 1.0),
    clipped_case(0.3, 2.0, 1.0),
    clipped_case(0.9, 1.8, 1.0),
    clipped_case(0.5, 1.0, 0.3),
    clipped_case(1.6, 1.3, 1.5),
    clipped_case(1.9, 2.8, 1.7),
    *(
        projected_case(versine, theta)
        for versine in (0.05, 0.4, 0.95)
        for theta in (0.0, 0.9, 1.5, 1.65, 2.0)
        if np.cos(theta) > -0.8 * np.sqrt(versine * (2 - versine))
    ),
    *(uniform_case(delta) for delta in (1.0, 0.5, 0.1)),
    *(uniform_cap_case(delta, versine) for delta in (0.9, 0.3) for versine in (0.05, 0.6, 1.7)),
    *(uniform_clipped_case(delta, 0.4, theta) for delta in (0.8, 0.3) for theta in (0.5, 1.3, 1.9)),
    *(cosine_case(delta) for delta in (1.0, 0.6)),
    *(
        cosine_cap_case(delta, versine, theta)
        for delta in (0.9, 0.4)
        for versine in (0.05, 0.4)
        for theta in (2.4, 1.9)
    ),
    cosine_cap_case(0.4, 0.4, 1.6),
    *(cosine_clipped_case(delta, 0.4, theta) for delta in (0.9, 0.4) for theta in (0.5, 1.6)),
    ggx_case(0.3, 0.3, 0.1, 0.4, 0.4),
    ggx_case(1.3, 1.2, 0.02, 0.2, 0.2),
    ggx_case(1.0, 1.1, 0.15, 0.3, 0.8),
    ggx_case(0.8, 0.4, 0.3, 0.9, 0.5),
    ggx_case(0.5, 1.2, 0.01, 0.05, 0.05),
    ggx_case(0.5, 0.5, 1e-8, 0.001, 0.001),
]


@pytest.mark.parametrize("sampler", CASES, ids=[c.name for c in CASES])
def test_samples_follow_their_pdf(sampler: Case) -> None:
    samples = sampler.sample(random_squares(COUNT))
    np.testing.assert_allclose(np.linalg.norm(samples, axis=-1), 1, rtol=1e-12)
    assert chi_squared_p(samples, sampler.pdf, sampler.axis, sampler.edges) > SIGNIFICANCE


@pytest.mark.parametrize("sampler", CASES, ids=[c.name for c in CASES])
def test_samples_have_a_pdf(sampler: Case) -> None:
    """Every sample, the corners of the unit square too, is where the pdf is not 0."""
    corner = [0.0, 1e-12, 0.5, 1 - 1e-12]
    u = np.concatenate([random_squares(200), np.stack(np.meshgrid(corner, corner), -1).reshape(-1, 2)])
    pdf = sampler.pdf(sampler.sample(u))
    assert np.isfinite(pdf).all()
    inside = np.abs(u - 0.5).max(-1) < 0.5 - 1e-9
    assert (pdf[inside] > 0).all()


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
@pytest.mark.parametrize("half_angle", [1e-4, 1e-2, 0.3])
@pytest.mark.parametrize("alpha", [1e-3, 0.05, 0.5])
def test_ggx_weights_average_to_the_integral(dtype: type, half_angle: float, alpha: float) -> None:
    wo, axis = towards(1.0).astype(dtype), towards(1.02, 0.41 + np.pi).astype(dtype)
    versine = dtype(2 * np.sin(half_angle / 2) ** 2)
    integral, valid = pd.ggx_cap_integral(wo, axis, versine, dtype(alpha), dtype(alpha))
    side = (np.arange(256, dtype=dtype) + dtype(0.5)) / dtype(256)
    u = np.stack(np.meshgrid(side, side), -1)
    omega, weight, pdf = pd.ggx_cap_sample(wo, axis, versine, dtype(alpha), dtype(alpha), u)
    assert valid
    assert weight.mean(dtype=np.float64) == pytest.approx(integral, rel=2e-5)
    # inside the light, to the rounding of a direction
    offset = np.linalg.norm(omega.astype(np.float64) - axis.astype(np.float64), axis=-1)
    assert offset.max() <= np.sqrt(2 * versine) * (1 + 4 * np.finfo(dtype).eps) + np.finfo(dtype).eps
    if dtype is np.float64:
        np.testing.assert_allclose(pd.ggx_cap_pdf(wo, axis, versine, alpha, alpha, omega), pdf, rtol=1e-6)
