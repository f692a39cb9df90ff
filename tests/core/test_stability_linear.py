"""Stability of LTSDs, spherical Gaussians, pixels and phase functions: float32 against double on the way to each limit.

`python -m tests.core.test_stability_linear` prints the table.
"""

from collections.abc import Sequence

import numpy as np
import pivot_core.distributions as pd
import pytest

from tests.core.stability import Sweep, print_table

BASES = ("uniform_sphere", "uniform_hemisphere", "clamped_cosine", "squared_clamped_cosine")
GENERAL = np.array([[1.2, 0.1, -0.4], [0.05, 0.7, 0.2], [0.3, -0.2, 0.9]])
TRIANGLE = np.array([[-0.3, 0.1, 1.0], [0.6, -0.2, 0.9], [0.5, 0.9, 1.3]])
OMEGA = np.array([0.48, 0.6, 0.64])
AXIS = np.array([0.6, 0.0, 0.8])


def powers(first: int, last: int) -> Sequence[float]:
    """10^first .. 10^last, two a decade."""
    return list(10.0 ** np.linspace(first, last, 2 * abs(last - first) + 1))


def turned(axis: np.ndarray, angle: float) -> np.ndarray:
    """axis turned by an angle, to float32's unit length."""
    side = np.cross(axis, [0.0, 1.0, 0.0])
    side /= np.linalg.norm(side)
    return np.cos(angle) * axis + np.sin(angle) * side


def flattened(t: float) -> np.ndarray:
    """A matrix whose smallest singular value goes to 0."""
    return np.diag([1.0, 0.5, 0.3]) @ GENERAL @ np.diag([1.0, 1.0, t])


def triangle_of_size(t: float) -> np.ndarray:
    return np.array([0.2, 0.3, 1.0]) + t * TRIANGLE


def triangle_at_horizon(t: float) -> np.ndarray:
    """Ever flatter above the base's horizon, one vertex below it."""
    return np.array([[1.0, 0.0, t], [0.6, 0.8, 2 * t], [0.8, 0.5, -t]])


def rim_pixel(t: float) -> tuple[float, ...]:
    """A pixel of size t that the rim crosses."""
    return 0.6 - t / 2, 0.6 + t / 2, 0.8 - t / 2, 0.8 + t / 2


SWEEPS = [
    *(
        Sweep(
            f"ltsd_eval {base}",
            pd.ltsd_eval,
            "smallest singular value -> 0",
            powers(0, -5),
            lambda t, base=base: (base, flattened(t), OMEGA),
        )
        for base in BASES
    ),
    *(
        Sweep(
            f"ltsd_mean_direction {base}",
            pd.ltsd_mean_direction,
            "smallest singular value -> 0",
            powers(0, -5),
            lambda t, base=base: (base, flattened(t)),
        )
        for base in BASES[1:]
    ),
    *(
        Sweep(
            f"ltsd_integrate_polygon {base}",
            pd.ltsd_integrate_polygon,
            "smallest singular value -> 0",
            powers(0, -3),
            lambda t, base=base: (base, flattened(t), TRIANGLE),
        )
        for base in BASES
    ),
    *(
        Sweep(
            f"ltsd_integrate_polygon {base}",
            pd.ltsd_integrate_polygon,
            "angular size -> 0",
            powers(0, -6),
            lambda t, base=base: (base, GENERAL, triangle_of_size(t)),
        )
        for base in BASES
    ),
    *(
        Sweep(
            f"ltsd_integrate_polygon {base}",
            pd.ltsd_integrate_polygon,
            "horizon grazed",
            powers(0, -5),
            lambda t, base=base: (base, np.eye(3), triangle_at_horizon(t)),
        )
        for base in BASES[1:]
    ),
    Sweep(
        "sg_eval",
        pd.sg_eval,
        "sharpness -> 1e7, at its width",
        powers(-6, 7),
        lambda t: (AXIS, t, turned(AXIS, min(1.0, t**-0.5))),
    ),
    Sweep("sg_integral", pd.sg_integral, "sharpness -> 0", powers(0, -30), lambda t: (t,)),
    Sweep("sg_integral", pd.sg_integral, "sharpness -> 1e30", powers(0, 30), lambda t: (t,)),
    Sweep(
        "sg_product",
        pd.sg_product,
        "sharpness -> 1e7, at its width",
        powers(-6, 7),
        lambda t: (AXIS, t, turned(AXIS, min(1.0, t**-0.5)), 2 * t),
    ),
    Sweep("sg_irradiance", pd.sg_irradiance, "sharpness -> 0", powers(0, -30), lambda t: (t, 0.3)),
    Sweep("sg_irradiance", pd.sg_irradiance, "sharpness -> 1e7", powers(0, 7), lambda t: (t, 0.3)),
    Sweep("sg_irradiance", pd.sg_irradiance, "axis on the horizon", powers(0, -7), lambda t: (50.0, t)),
    Sweep("sg_irradiance", pd.sg_irradiance, "axis below the horizon", powers(-7, 0), lambda t: (50.0, -0.7 * t)),
    Sweep("sg_ggx_lobe", pd.sg_ggx_lobe, "alpha -> 0", powers(0, -6), lambda t: (t, OMEGA)),
    Sweep(
        "asg_integrate_sg",
        pd.asg_integrate_sg,
        "eta_x, sharpness -> 1e7",
        powers(-2, 7),
        lambda t: (np.eye(3), t, 3.0, np.array([0.0, 0.0, 1.0]), t),
    ),
    Sweep(
        "orthographic_corner",
        pd.orthographic_corner_solid_angle,
        "the rim",
        powers(0, -7),
        lambda t: (0.6, 0.8 * (1 - t)),
        scale=lambda t: 1.0,
    ),
    Sweep(
        "orthographic_pixel",
        pd.orthographic_pixel_solid_angle,
        "pixel size -> 0",
        powers(0, -6),
        lambda t: (0.3, 0.3 + t / 2, 0.2, 0.2 + t / 2),
    ),
    Sweep(
        "orthographic_pixel", pd.orthographic_pixel_solid_angle, "pixel size -> 0 on the rim", powers(0, -3), rim_pixel
    ),
    Sweep(
        "orthographic_pixel",
        pd.orthographic_pixel_solid_angle,
        "pixel size -> 0 at (1, 0)",
        powers(0, -3),
        lambda t: (1 - t, 1.0, 0.0, t),
    ),
    Sweep(
        "cubemap_pixel",
        pd.cubemap_pixel_solid_angle,
        "pixel size -> 0",
        powers(0, -6),
        lambda t: (0.3, 0.3 + t, -0.2, -0.2 + t),
    ),
    *(
        Sweep(f"{name} {sign:+d}", function, "|g| -> 1", powers(0, -6), lambda t, s=sign: (s * (1 - t / 2), 0.5))
        for sign in (1, -1)
        for name, function in (
            ("henyey_greenstein_eval", pd.henyey_greenstein_eval),
            ("henyey_greenstein_cdf", pd.henyey_greenstein_cdf),
            ("henyey_greenstein_sample", pd.henyey_greenstein_sample_cosine),
            ("pivot_phase_eval", pd.pivot_phase_eval),
            ("pivot_phase_cdf", pd.pivot_phase_cdf),
            ("pivot_phase_sample", pd.pivot_phase_sample_cosine),
        )
    ),
    *(
        Sweep(name, function, "g -> 0", powers(0, -12), lambda t: (t / 2,))
        for name, function in (
            ("pivot_phase_mean_cosine", pd.pivot_phase_mean_cosine),
            ("pivot_phase_like", pd.pivot_phase_like),
            ("pivot_phase_of_mean_cosine", pd.pivot_phase_of_mean_cosine),
        )
    ),
    *(
        Sweep(name, function, "|g| -> 1", powers(0, -6), lambda t: (t - 1,))
        for name, function in (
            ("pivot_phase_mean_cosine", pd.pivot_phase_mean_cosine),
            ("pivot_phase_like", pd.pivot_phase_like),
            ("pivot_phase_of_mean_cosine", pd.pivot_phase_of_mean_cosine),
        )
    ),
    *(
        Sweep(
            "henyey_greenstein_cap_integral",
            pd.henyey_greenstein_cap_integral,
            limit,
            walk,
            inputs,
            bound=5e-3,
            why="where the rule for small caps ends, as precise as the integral itself",
        )
        for limit, walk, inputs in (
            ("g -> 1", powers(0, -4), lambda t: (1 - t / 2, OMEGA, AXIS, 0.1)),
            ("g -> 1, light ahead", powers(0, -4), lambda t: (1 - t / 2, AXIS, AXIS, 1e-3)),
            ("light's versine -> 0", powers(0, -12), lambda t: (0.9, OMEGA, AXIS, t)),
            ("light's versine -> 2", powers(0, -6), lambda t: (0.9, OMEGA, AXIS, 2 - t)),
        )
    ),
    Sweep(
        "pivot_phase_cap_integral",
        pd.pivot_phase_cap_integral,
        "g_p -> 1",
        powers(0, -5),
        lambda t: (1 - t / 2, OMEGA, AXIS, 0.1),
    ),
    Sweep(
        "pivot_phase_cap_integral",
        pd.pivot_phase_cap_integral,
        "light's versine -> 0",
        powers(0, -12),
        lambda t: (0.7, OMEGA, AXIS, t),
    ),
]


@pytest.mark.parametrize("sweep", SWEEPS, ids=[f"{sweep.name}: {sweep.limit}" for sweep in SWEEPS])
def test_float32_holds_on_the_way_to_a_limit(sweep: Sweep) -> None:
    error, t = sweep.worst()
    assert error <= sweep.bound, f"at {t}"


if __name__ == "__main__":
    print_table(SWEEPS)
