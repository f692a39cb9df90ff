"""Caps, their intersections and projections, for test_oracles.py."""

from typing import Any

import numpy as np
import pivot_core.distributions as pd

Values = dict[str, Any]
UP = np.array([0, 0, 1])


def versine(psi: np.ndarray) -> np.ndarray:
    """1 - cos psi with all of its bits, in psi's precision."""
    half_sine = np.sin(psi / 2)
    return np.asarray(2 * half_sine * half_sine, psi.dtype)


def versine_of_sine(sine: np.ndarray) -> np.ndarray:
    """1 - cos psi of sin psi, psi <= pi / 2."""
    return np.asarray(sine * sine / (1 + np.sqrt((1 - sine) * (1 + sine))), sine.dtype)


def axis_at(theta: np.ndarray) -> np.ndarray:
    """The direction at the angle theta from z, towards x."""
    return np.asarray([np.sin(theta), 0, np.cos(theta)], theta.dtype)


def rings_across_rim(distance: float, psi: float, t: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """The circles about a pole that a cap's rim cuts, for t in 0..pi: their angles from the pole, the derivative of
    these by t, and how far in azimuth to either side of the cap's axis a circle is inside the cap.

    distance: of the axis from the pole. The angles run as a cosine of t, which takes the square root out of both ends.
    A circle at the angle beta is inside up to the azimuth phi, where sin beta sin distance times
        sin^2 phi/2 is sin((distance + psi - beta) / 2) sin((beta + psi - distance) / 2),
        cos^2 phi/2 is sin((beta + distance + psi) / 2) sin((beta + distance - psi) / 2):
    products of the four distances from the ends, each with its own bits, so that the tiniest cap has them all.
    """
    near, far = abs(distance - psi), min(distance + psi, 2 * np.pi - distance - psi)
    half = min(distance, psi, np.pi - distance, np.pi - psi)
    from_near, to_far = 2 * half * np.sin(t / 2) ** 2, 2 * half * np.cos(t / 2) ** 2
    low = [np.sin(from_near / 2), np.sin(near + from_near / 2)]
    high = [np.sin(to_far / 2), np.sin(far - to_far / 2)]
    if psi > distance:
        low.reverse()
    if psi > np.pi - distance:
        high.reverse()
    reach = 2 * np.arctan2(np.sqrt(low[0] * high[0]), np.sqrt(low[1] * high[1]))
    return near + from_near, half * np.sin(t), reach


def cap_solid_angle(inputs: Values, dtype: type) -> Values:
    return {"A": pd.cap_solid_angle(versine(inputs["psi"]))}


def cap_uniform_sample(inputs: Values, dtype: type) -> Values:
    h = versine(inputs["psi"])
    x, y, z = omega = pd.cap_sample(UP.astype(dtype), h, np.asarray([inputs["xi"], 0.3], dtype))
    # 1 - cos theta from the sine, or from the cosine, whichever is the small number
    one = dtype(1)  # a Python number would make float64 of it in NumPy 1
    one_minus_cos = (x * x + y * y) / (one + z) if z > 0 else one - z
    return {"one_minus_cos_theta": one_minus_cos, "pdf": pd.cap_pdf(UP.astype(dtype), h, omega)}


def sphere_light_cap(inputs: Values, dtype: type) -> Values:
    _, h = pd.sphere_light_cap(inputs["distance"] * UP.astype(dtype), inputs["R"])
    return {
        "inside": dtype(h == 2),
        "sin_psi": np.sqrt(h * (dtype(2) - h)),
        "cos_psi": dtype(1) - h,
        "A": pd.cap_solid_angle(h),
    }


def two_cap_area(inputs: Values, dtype: type) -> Values:
    caps = versine(inputs["psi1"]), versine(inputs["psi2"]), inputs["psi_d"]
    return {"A": pd.cap_intersection_at(*caps), "A_eq37": pd.cap_intersection_approximate_at(*caps)}


def projected_cap_area(inputs: Values, dtype: type) -> Values:
    cap = axis_at(inputs["theta_d"]), versine_of_sine(inputs["r_y"])
    return {"projected_solid_angle": pd.cap_cosine_integral(*cap, UP)}


def projected_cap_geometry(inputs: Values, dtype: type) -> Values:
    rim = pd.projected_cap_geometry(axis_at(inputs["theta_d"]), versine_of_sine(inputs["r_y"]), UP)
    return dict(zip(("r_x", "r_y", "r_z", "c_x", "c_z", "t_x"), rim, strict=True))


def projected_cap_warp(inputs: Values, dtype: type) -> Values:
    cap = axis_at(inputs["theta_d"]), versine_of_sine(inputs["r_y"])
    omega, density, disk = pd.projected_cap_warp(*cap, UP, inputs["d_x"], inputs["d_y"])
    return {"omega": omega, "density_psa": density, "A_D": disk}


def projected_cap_bound(inputs: Values, dtype: type) -> Values:
    return {"max_ratio_bound": pd.projected_cap_worst_density_bound(inputs["inv_r_y"])}


FORMULAS = {
    function.__name__: function
    for function in (
        cap_solid_angle,
        cap_uniform_sample,
        sphere_light_cap,
        two_cap_area,
        projected_cap_area,
        projected_cap_geometry,
        projected_cap_warp,
        projected_cap_bound,
    )
}
