"""
Lobes under lights within an error budget, as the renderer does it.
"""

from __future__ import annotations
import typing

__all__: list[str] = ["METHODS", "ggx_area_light", "ggx_gaussian_light", "ggx_sphere_light"]

def ggx_area_light(
    alpha: typing.Any,
    wo: typing.Any,
    center: typing.Any,
    half_u: typing.Any,
    half_v: typing.Any,
    ellipse: bool,
    error_budget: typing.SupportsFloat | typing.SupportsIndex,
) -> tuple:
    """
    ggx_area_light(alpha, wo, center, half_u, half_v, ellipse, error_budget): (value, error, method).

    The same for a parallelogram, or the ellipse in it: center (n, 3) from the shaded point, half_u and half_v (n, 3) from
    the centre to the middle of two sides, in the shading frame.
    """

def ggx_gaussian_light(
    alpha: typing.Any, wo: typing.Any, axis: typing.Any, sharpness: typing.Any, way: str = "AUTO"
) -> tuple:
    """
    ggx_gaussian_light(alpha, wo, axis, sharpness, way): (value, error, method).

    The same for a spherical Gaussian of radiance, 1 on its axis (n, 3): by CAPS of the exact core, by POINTS of the lobe,
    by the WIDENED lobe of [Tokuyoshi24], by the ANISOTROPIC Gaussian of [Tokuyoshi15], or, AUTO, by points where the light
    is much wider than the lobe, else caps.
    """

def ggx_sphere_light(
    alpha: typing.Any,
    wo: typing.Any,
    cap_axis: typing.Any,
    half_angle: typing.Any,
    error_budget: typing.SupportsFloat | typing.SupportsIndex,
) -> tuple:
    """
    ggx_sphere_light(alpha, wo, cap_axis, half_angle, error_budget): (value, error, method).

    GGX (F = 1, height-correlated masking-shadowing) over a spherical light of radiance 1, cut at the horizon, by the
    cheapest method whose predicted error meets the budget: what the analytic integrator computes. Shading frame, z the
    normal. alpha (n,) in [1e-3, 1]; wo and cap_axis (n, 3), unit, wo above the surface; half_angle (n,) in radians, at
    most pi/2; error_budget in percent, relative to max(value, 1e-3). All broadcast.
    value: reflected over emitted radiance, float32. error: the predicted relative error. method: an index into METHODS.
    """

METHODS: tuple = (
    "NONE",
    "POINTS_1",
    "POINTS_4",
    "POINTS_8",
    "POINTS_16",
    "SLICES_5",
    "SLICES_6",
    "SLICES_8",
    "BEAM_LAYERS",
    "AREA_POINTS",
    "LOBE_DIRECTIONS",
    "SPTD",
    "LTC",
    "VIRTUAL_LIGHTS",
    "POINT_SET",
)
