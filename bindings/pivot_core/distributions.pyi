"""
Spherical distributions: eval, integrate, sample and pdf, over NumPy arrays.

Arguments broadcast over their leading axes: a scalar has shape (...), a direction (..., 3), random numbers (..., 2).
Results are float32 if every floating-point array given is float32, else float64. Angles are in radians, solid angles
in steradians, pdfs per steradian. A spherical cap is its unit axis and its versine, 1 - cos(half-angle), in [0, 2]: a
tiny cap keeps all its bits. A pivot is a unit direction and delta = 1 - |r_p| in (0, 1]. Bad input raises ValueError
naming the argument; nothing returns NaN.
"""

from __future__ import annotations
import typing

__all__: list[str] = [
    "asg_eval",
    "asg_integrate_sg",
    "cap_contains",
    "cap_cosine_integral",
    "cap_intersection",
    "cap_intersection3",
    "cap_intersection_approximate",
    "cap_intersection_approximate_at",
    "cap_intersection_at",
    "cap_intersection_pdf",
    "cap_intersection_sample",
    "cap_pdf",
    "cap_sample",
    "cap_solid_angle",
    "cubemap_corner_solid_angle",
    "cubemap_pixel_solid_angle",
    "ggx_cap_integral",
    "ggx_cap_pdf",
    "ggx_cap_points",
    "ggx_cap_sample",
    "ggx_polygon_chords_integral",
    "ggx_polygon_integral",
    "henyey_greenstein_cap_integral",
    "henyey_greenstein_cdf",
    "henyey_greenstein_eval",
    "henyey_greenstein_mean_cosine",
    "henyey_greenstein_sample_cosine",
    "ltc_above_horizon",
    "ltc_integrate_cap",
    "ltc_integrate_polygon",
    "ltsd_base_sample_cosine",
    "ltsd_eval",
    "ltsd_integrate_polygon",
    "ltsd_mean_direction",
    "ltsd_sample",
    "orthographic_corner_solid_angle",
    "orthographic_pixel_solid_angle",
    "pivot_jacobian",
    "pivot_phase_cap_integral",
    "pivot_phase_cap_pdf",
    "pivot_phase_cap_sample",
    "pivot_phase_cdf",
    "pivot_phase_eval",
    "pivot_phase_like",
    "pivot_phase_mean_cosine",
    "pivot_phase_of_mean_cosine",
    "pivot_phase_sample_cosine",
    "pivot_transform",
    "pivot_transform_cap",
    "pivot_transform_cap_versines",
    "pivot_transform_point",
    "projected_cap_density_bound",
    "projected_cap_geometry",
    "projected_cap_invert",
    "projected_cap_pdf",
    "projected_cap_sample",
    "projected_cap_warp",
    "projected_cap_worst_density_bound",
    "sg_eval",
    "sg_ggx_lobe",
    "sg_integral",
    "sg_irradiance",
    "sg_irradiance_estimate",
    "sg_irradiance_vsgl",
    "sg_product",
    "sg_sharpness_of_mean",
    "sphere_light_cap",
    "sptd_cosine_cap_pdf",
    "sptd_cosine_cap_sample",
    "sptd_cosine_clipped_pdf",
    "sptd_cosine_clipped_sample",
    "sptd_cosine_eval",
    "sptd_cosine_integral",
    "sptd_cosine_integral2",
    "sptd_cosine_integral3",
    "sptd_cosine_sample",
    "sptd_uniform_cap_pdf",
    "sptd_uniform_cap_sample",
    "sptd_uniform_clipped_pdf",
    "sptd_uniform_clipped_sample",
    "sptd_uniform_eval",
    "sptd_uniform_integral",
    "sptd_uniform_integral2",
    "sptd_uniform_integral3",
    "sptd_uniform_sample",
]

def asg_eval(frame: typing.Any, eta_x: typing.Any, eta_y: typing.Any, omega: typing.Any) -> typing.Any:
    """
    asg_eval(frame, eta_x, eta_y, omega): max(omega . z, 0) exp(-eta_x (omega . x)^2 - eta_y (omega . y)^2).

    frame (..., 3, 3): rows x, y, z, orthonormal; eta_x, eta_y (...) >= 0; omega (..., 3), unit. [Xu13 (1)]
    """

def asg_integrate_sg(
    frame: typing.Any, eta_x: typing.Any, eta_y: typing.Any, axis: typing.Any, sharpness: typing.Any
) -> typing.Any:
    """
    asg_integrate_sg(frame, eta_x, eta_y, axis, sharpness): the integral of the anisotropic Gaussian times a Gaussian: the
    VSGL's specular shading before the factor intensity * M.

    An approximation: within 5 % while the axes are within 0.3 rad or the lobes are wide. axis (..., 3), unit.
    [Tokuyoshi15, appendix B], [Xu13 (9)]
    """

def cap_contains(axis: typing.Any, versine: typing.Any, omega: typing.Any) -> typing.Any:
    """
    Whether a direction lies in a cap.

    axis, omega: (..., 3) unit; versine: (...) in [0, 2]. Returns (...) bool.
    """

def cap_cosine_integral(axis: typing.Any, versine: typing.Any, normal: typing.Any) -> typing.Any:
    """
    The integral of max(0, omega . normal) over a cap, cut by the horizon: its projected solid angle.

    axis, normal: (..., 3) unit; versine: (...) in [0, 2]. Returns (...), in [0, pi]. [Peters19 Cases 1-3]
    """

def cap_intersection(axis1: typing.Any, versine1: typing.Any, axis2: typing.Any, versine2: typing.Any) -> typing.Any:
    """
    The solid angle inside two caps, in steradians.

    axis1, axis2: (..., 3) unit; versine1, versine2: (...) in [0, 2]. Returns (...). [Dupuy17 Eq 35-36, in forms that keep
    small caps' bits and cover caps that overlap all around]
    """

def cap_intersection3(
    axis1: typing.Any,
    versine1: typing.Any,
    axis2: typing.Any,
    versine2: typing.Any,
    axis3: typing.Any,
    versine3: typing.Any,
) -> typing.Any:
    """
    The solid angle inside three caps, in steradians.

    axis1, axis2, axis3: (..., 3) unit; versine1, versine2, versine3: (...) in [0, 2]. Returns (...). For specular occlusion
    above the horizon: light, bent cone and hemisphere. [Dupuy17 Eq 23, clipped]
    """

def cap_intersection_approximate(
    axis1: typing.Any, versine1: typing.Any, axis2: typing.Any, versine2: typing.Any
) -> typing.Any:
    """
    The solid angle inside two caps by a cubic, in steradians.

    Exact where one cap holds the other or they are apart. Arguments as of cap_intersection. [Dupuy17 Eq 37-38]
    """

def cap_intersection_approximate_at(versine1: typing.Any, versine2: typing.Any, separation: typing.Any) -> typing.Any:
    """
    cap_intersection_approximate, given the angle between the axes.

    versine1, versine2: (...) in [0, 2]; separation: (...) in [0, pi], radians. Returns (...).
    """

def cap_intersection_at(versine1: typing.Any, versine2: typing.Any, separation: typing.Any) -> typing.Any:
    """
    cap_intersection, given the angle between the axes.

    versine1, versine2: (...) in [0, 2]; separation: (...) in [0, pi], radians. Returns (...).
    """

def cap_intersection_pdf(
    axis1: typing.Any, versine1: typing.Any, axis2: typing.Any, versine2: typing.Any, omega: typing.Any
) -> typing.Any:
    """
    The density of cap_intersection_sample, per steradian: 0 outside the intersection.

    Arguments as of cap_intersection_sample, with omega: (..., 3) unit for u. Returns (...).
    """

def cap_intersection_sample(
    axis1: typing.Any, versine1: typing.Any, axis2: typing.Any, versine2: typing.Any, u: typing.Any
) -> typing.Any:
    """
    A direction uniform over the intersection of two caps.

    axis1, axis2: (..., 3) unit; versine1, versine2: (...) in [0, 2], 1 to cut a cap by the horizon about the other axis;
    u: (..., 2) in [0, 1). Returns (..., 3), unit; an axis of the two if the intersection is empty.
    """

def cap_pdf(axis: typing.Any, versine: typing.Any, omega: typing.Any) -> typing.Any:
    """
    The density of cap_sample, per steradian: 0 outside the cap.

    axis, omega: (..., 3) unit; versine: (...) in (0, 2]. Returns (...).
    """

def cap_sample(axis: typing.Any, versine: typing.Any, u: typing.Any) -> typing.Any:
    """
    A direction uniform over a cap.

    axis: (..., 3) unit; versine: (...) in [0, 2]; u: (..., 2) in [0, 1). Returns (..., 3), unit.
    """

def cap_solid_angle(versine: typing.Any) -> typing.Any:
    """
    The solid angle of a cap, in steradians.

    versine: (...) in [0, 2]. Returns (...). [Dupuy17 Eq 5]
    """

def cubemap_corner_solid_angle(x: typing.Any, y: typing.Any) -> typing.Any:
    """
    cubemap_corner_solid_angle(x, y): solid angle of [0, x] x [0, y] on the plane z = 1, odd in x and in y. [Patapom (1)]
    """

def cubemap_pixel_solid_angle(x0: typing.Any, x1: typing.Any, y0: typing.Any, y1: typing.Any) -> typing.Any:
    """
    cubemap_pixel_solid_angle(x0, x1, y0, y1): solid angle of the pixel [x0, x1] x [y0, y1] on the plane z = 1.

    To rounding for pixels of any size.
    """

def ggx_cap_integral(
    wo: typing.Any, axis: typing.Any, versine: typing.Any, alpha_x: typing.Any, alpha_y: typing.Any
) -> typing.Any:
    """
    The integral over a cap of D(h) / (4 cos_o), GGX without masking, Fresnel and horizon; and whether it holds.

    wo, axis: (..., 3) unit, in the shading frame (z = normal), wo above; versine: (...) in (0, 2); alpha_x, alpha_y: (...) in
    (0, 1]. Returns the integral (...) and valid (...) bool: False, and the integral 0, where the cap's half vectors are no
    cone or leave the upper hemisphere. float32 is within 1e-4 relative for alphas from 1e-3 and half-angles from 1e-5.
    """

def ggx_cap_pdf(
    wo: typing.Any, axis: typing.Any, versine: typing.Any, alpha_x: typing.Any, alpha_y: typing.Any, omega_i: typing.Any
) -> typing.Any:
    """
    The density of ggx_cap_sample, per steradian: 0 outside the cap.

    Arguments as of ggx_cap_sample, with omega_i: (..., 3) unit for u. Returns (...).
    """

def ggx_cap_points(
    wo: typing.Any,
    axis: typing.Any,
    versine: typing.Any,
    alpha_x: typing.Any,
    alpha_y: typing.Any,
    count: typing.SupportsInt | typing.SupportsIndex,
) -> typing.Any:
    """
    A fixed rule of 1, 4, 8 or 16 directions in a cap.

    wo, axis: (..., 3) unit; versine: (...) in (0, 2); alpha_x, alpha_y: (...) in (0, 1]. Returns omega_i (..., count, 3) unit
    and weights (..., count), which sum to ggx_cap_integral: the integral of D(h) / (4 cos_o) times a smooth f, such as
    masking and Fresnel, is about the sum of weight f(omega_i). One point is the highlight's centre.
    """

def ggx_cap_sample(
    wo: typing.Any, axis: typing.Any, versine: typing.Any, alpha_x: typing.Any, alpha_y: typing.Any, u: typing.Any
) -> typing.Any:
    """
    A direction in a cap by the GGX lobe, its weight D(h) / (4 cos_o) / pdf, and its pdf per steradian.

    wo, axis: (..., 3) unit; versine: (...) in (0, 2); alpha_x, alpha_y: (...) in (0, 1]; u: (..., 2) in [0, 1). Returns
    omega_i (..., 3) unit, weight (...) and pdf (...). ValueError where ggx_cap_integral is not valid.
    """

def ggx_polygon_chords_integral(
    wo: typing.Any, alpha_x: typing.Any, alpha_y: typing.Any, polygon: typing.Any, chords: typing.Any
) -> typing.Any:
    """
    ggx_polygon_integral with a number of chords for each edge, in place of convergence.

    chords: (...) >= 1, a whole number. Other arguments and results as of ggx_polygon_integral.
    """

def ggx_polygon_integral(wo: typing.Any, alpha_x: typing.Any, alpha_y: typing.Any, polygon: typing.Any) -> typing.Any:
    """
    The integral over a polygon of D(h) / (4 cos_o), GGX without masking and Fresnel, by its contour.

    wo: (..., 3) unit, in the shading frame (z = normal), above the surface; alpha_x, alpha_y: (...) in (0, 1]; polygon:
    (..., n, 3), its vertices relative to the shaded point, either way round; what is below the surface is clipped. Returns
    the integral (...) and the half vector (..., 3) of the highlight's centre. Converged to the precision of the input.
    """

def henyey_greenstein_cap_integral(
    g: typing.Any, omega_o: typing.Any, light_axis: typing.Any, light_versine: typing.Any
) -> typing.Any:
    """
    henyey_greenstein_cap_integral(g, omega_o, light_axis, light_versine): the phase function's integral over a sphere
    light's cap, in [0, 1], to half a percent. Arguments as of pivot_phase_cap_integral.
    """

def henyey_greenstein_cdf(g: typing.Any, mu: typing.Any) -> typing.Any:
    """
    henyey_greenstein_cdf(g, mu): the probability of a cosine <= mu.
    """

def henyey_greenstein_eval(g: typing.Any, mu: typing.Any) -> typing.Any:
    """
    henyey_greenstein_eval(g, mu): the phase function per steradian, also the pdf of its sampling.

    g (...) in (-1, 1), the mean cosine; mu (...): cosine between the directions of travel before and after. [Dupuy17 (26)]
    """

def henyey_greenstein_mean_cosine(g: typing.Any) -> typing.Any:
    """
    henyey_greenstein_mean_cosine(g): g itself.
    """

def henyey_greenstein_sample_cosine(g: typing.Any, xi: typing.Any) -> typing.Any:
    """
    henyey_greenstein_sample_cosine(g, xi): (mu, sin) by inverting the cdf at xi in [0, 1].
    """

def ltc_above_horizon(m: typing.Any) -> typing.Any:
    """
    ltc_above_horizon(m): the integral of the linearly transformed cosine over z > 0.

    m (..., 3, 3).
    """

def ltc_integrate_cap(m: typing.Any, axis: typing.Any, versine: typing.Any) -> typing.Any:
    """
    ltc_integrate_cap(m, axis, versine): the integral of the linearly transformed cosine over a cap's part at z > 0,
    exact.

    m (..., 3, 3); axis (..., 3), unit; versine (...) = 1 - cos(half-angle), in [0, 2].
    """

def ltc_integrate_polygon(m: typing.Any, polygon: typing.Any) -> typing.Any:
    """
    ltc_integrate_polygon(m, polygon): the integral of the linearly transformed cosine over a polygon's part at z > 0.

    m (..., 3, 3); polygon (..., n, 3), n >= 3 vertices relative to the shading point, in either order.
    """

def ltsd_base_sample_cosine(base: str, xi: typing.Any) -> typing.Any:
    """
    ltsd_base_sample_cosine(base, xi): the cosine to z of a direction drawn from the base distribution D_o, by inverting its distribution at xi.

    base: 'uniform_sphere', 'uniform_hemisphere', 'clamped_cosine' or 'squared_clamped_cosine'; xi (...) in [0, 1].
    [Heitz16, supplement 1.1-1.4]
    """

def ltsd_eval(base: str, m: typing.Any, omega: typing.Any) -> typing.Any:
    """
    ltsd_eval(base, m, omega): the linearly transformed distribution D at omega, per steradian; also the pdf of ltsd_sample. Integrates to 1.

    m (..., 3, 3), invertible, its scale without effect: omega = m omega_o / |m omega_o|; omega (..., 3), unit.
    D = D_o(m^-1 omega / |m^-1 omega|) |det m^-1| / |m^-1 omega|^3. ValueError if m is singular.
    [Heitz16 (1)]
    """

def ltsd_integrate_polygon(base: str, m: typing.Any, polygon: typing.Any) -> typing.Any:
    """
    ltsd_integrate_polygon(base, m, polygon): the integral of D over the directions of a polygon, in [0, 1].

    m (..., 3, 3); polygon (..., n, 3), n >= 3 vertices relative to the shading point, in either order. Exact for all
    four bases; what falls below the base's horizon counts nothing. Relative error in float32 about 1e-7 / angular size.
    [Heitz16, supplement 2.3]
    """

def ltsd_mean_direction(base: str, m: typing.Any) -> typing.Any:
    """
    ltsd_mean_direction(base, m): the mean direction E[omega] (..., 3), of length <= 1.

    m (..., 3, 3). Exact to rounding. [Heitz16, supplement 2.4]
    """

def ltsd_sample(base: str, m: typing.Any, u: typing.Any) -> typing.Any:
    """
    ltsd_sample(base, m, u): a direction (..., 3) drawn from D, with pdf ltsd_eval.

    m (..., 3, 3); u (..., 2) in [0, 1). [Heitz16, supplement, algorithm 1]
    """

def orthographic_corner_solid_angle(x: typing.Any, y: typing.Any) -> typing.Any:
    """
    orthographic_corner_solid_angle(x, y): solid angle of the hemisphere z > 0 over [0, x] x [0, y], odd in x and in y.

    What lies outside the unit disc counts nothing. Absolute error: rounding. [Patapom (2), in a shorter form]
    """

def orthographic_pixel_solid_angle(x0: typing.Any, x1: typing.Any, y0: typing.Any, y1: typing.Any) -> typing.Any:
    """
    orthographic_pixel_solid_angle(x0, x1, y0, y1): solid angle of the hemisphere z > 0 over the pixel [x0, x1] x [y0, y1],
    cut by the unit disc.

    0 if x0 >= x1 or y0 >= y1. Relative error 1e-11 in float64, rounding in float32.
    """

def pivot_jacobian(omega: typing.Any, pivot_direction: typing.Any, delta: typing.Any) -> typing.Any:
    """
    d g(omega) / d omega, a ratio of solid angles.

    omega, pivot_direction: (..., 3) unit; delta: (...) in (0, 1]. Returns (...). [Dupuy17 Eq 4]
    """

def pivot_phase_cap_integral(
    g_p: typing.Any, omega_o: typing.Any, light_axis: typing.Any, light_versine: typing.Any
) -> typing.Any:
    """
    pivot_phase_cap_integral(g_p, omega_o, light_axis, light_versine): the phase function's integral over a sphere light's
    cap, in [0, 1]; exact.

    omega_o, light_axis (..., 3), unit: the direction of travel that mu is measured from, and the light's centre;
    light_versine (...) in (0, 2]. [Dupuy17 (24), 6.2]
    """

def pivot_phase_cap_pdf(
    g_p: typing.Any, omega_o: typing.Any, light_axis: typing.Any, light_versine: typing.Any, omega: typing.Any
) -> typing.Any:
    """
    pivot_phase_cap_pdf(g_p, omega_o, light_axis, light_versine, omega): pdf per steradian of pivot_phase_cap_sample; 0
    outside the cap.
    """

def pivot_phase_cap_sample(
    g_p: typing.Any, omega_o: typing.Any, light_axis: typing.Any, light_versine: typing.Any, u: typing.Any
) -> typing.Any:
    """
    pivot_phase_cap_sample(g_p, omega_o, light_axis, light_versine, u): a direction (..., 3) inside the light's cap, in
    proportion to the phase function. u (..., 2) in [0, 1). [Dupuy17, 6.2]
    """

def pivot_phase_cdf(g_p: typing.Any, mu: typing.Any) -> typing.Any:
    """
    pivot_phase_cdf(g_p, mu): the probability of a cosine <= mu.
    """

def pivot_phase_eval(g_p: typing.Any, mu: typing.Any) -> typing.Any:
    """
    pivot_phase_eval(g_p, mu): the pivot phase function per steradian, also the pdf of its sampling.

    g_p (...) in (-1, 1): the pivot's place on the direction of travel, not the mean cosine. [Dupuy17 (25)]
    """

def pivot_phase_like(g: typing.Any) -> typing.Any:
    """
    pivot_phase_like(g): g_p of the pivot phase function that looks like Henyey-Greenstein at g, by the paper's rational fit
    with its sign corrected. [Dupuy17 (27-28)]
    """

def pivot_phase_mean_cosine(g_p: typing.Any) -> typing.Any:
    """
    pivot_phase_mean_cosine(g_p): (1 + g_p^2) / (2 g_p) - (1 - g_p^2)^2 / (2 g_p^2) atanh(g_p).
    """

def pivot_phase_of_mean_cosine(g: typing.Any) -> typing.Any:
    """
    pivot_phase_of_mean_cosine(g): g_p of the pivot phase function whose mean cosine is g.
    """

def pivot_phase_sample_cosine(g_p: typing.Any, xi: typing.Any) -> typing.Any:
    """
    pivot_phase_sample_cosine(g_p, xi): (mu, sin) by inverting the cdf at xi in [0, 1].
    """

def pivot_transform(omega: typing.Any, pivot_direction: typing.Any, delta: typing.Any) -> typing.Any:
    """
    g(omega): the other end of the chord from omega through the pivot.

    omega, pivot_direction: (..., 3) unit; delta: (...) in (0, 1]. Returns (..., 3), unit. [Dupuy17 Eq 2]
    """

def pivot_transform_cap(
    axis: typing.Any, versine: typing.Any, pivot_direction: typing.Any, delta: typing.Any
) -> typing.Any:
    """
    g(cap): the cap that a cap maps to.

    axis, pivot_direction: (..., 3) unit; versine: (...) in [0, 2]; delta: (...) in (0, 1].
    Returns axis (..., 3) and versine (...). [Dupuy17 Eq 6-7, as a linear map]
    """

def pivot_transform_cap_versines(
    axis: typing.Any, versine: typing.Any, pivot_direction: typing.Any, delta: typing.Any
) -> typing.Any:
    """
    1 - cos psi' and 1 + cos psi' of the cap that a cap maps to: near the whole sphere the second keeps all its bits.

    axis, pivot_direction: (..., 3) unit; versine: (...) in [0, 2]; delta: (...) in (0, 1]. Returns (...) and (...).
    """

def pivot_transform_point(r: typing.Any, pivot_direction: typing.Any, delta: typing.Any) -> typing.Any:
    """
    g(r) of any point in space; its own inverse.

    r: (..., 3); pivot_direction: (..., 3) unit; delta: (...) in (0, 1]. Returns (..., 3).
    ValueError if r is the map's pole, pivot_direction / (1 - delta). [Dupuy17 Eq 2]
    """

def projected_cap_density_bound(axis: typing.Any, versine: typing.Any, normal: typing.Any) -> typing.Any:
    """
    A bound of max / min density of projected_cap_sample with respect to projected solid angle.

    axis, normal: (..., 3) unit; versine: (...) in (0, 1). Returns (...) >= 1. [Peters19 suppl. Eq 4]
    """

def projected_cap_geometry(axis: typing.Any, versine: typing.Any, normal: typing.Any) -> typing.Any:
    """
    The rim of a cap in the frame of a normal.

    axis, normal: (..., 3) unit; versine: (...) in (0, 1]. Returns r_x, r_y, r_z, c_x, c_z and t_x, each (...): extents and
    centre, z along the normal, x along the horizon to the axis, and the x where rim and horizon meet (>= 1 if they do not).
    [Peters19 suppl. Sec 1]
    """

def projected_cap_invert(axis: typing.Any, versine: typing.Any, normal: typing.Any, omega: typing.Any) -> typing.Any:
    """
    The u at which projected_cap_sample returns omega.

    axis, normal, omega: (..., 3) unit, omega in the cap and above the horizon; versine: (...) in (0, 1]. Returns (..., 2).
    """

def projected_cap_pdf(axis: typing.Any, versine: typing.Any, normal: typing.Any, omega: typing.Any) -> typing.Any:
    """
    The density of projected_cap_sample, per steradian.

    axis, normal, omega: (..., 3) unit; versine: (...) in (0, 1]. Returns (...), 0 outside the cap and below the horizon.
    [Peters19 suppl. Sec 2]
    """

def projected_cap_sample(axis: typing.Any, versine: typing.Any, normal: typing.Any, u: typing.Any) -> typing.Any:
    """
    A direction in a cap and above the horizon, by projected solid angle: uniform in it, or nearly so.

    axis, normal: (..., 3) unit; versine: (...) in (0, 1]; u: (..., 2) in [0, 1). Returns (..., 3), unit; a direction on the
    horizon if the cap is below it. [Peters19]
    """

def projected_cap_warp(
    axis: typing.Any, versine: typing.Any, normal: typing.Any, d_x: typing.Any, d_y: typing.Any
) -> typing.Any:
    """
    The warp of a cap whose axis is below the horizon, from the cut disk that it samples uniformly.

    axis, normal: (..., 3) unit; versine: (...) in (0, 1]; d_x, d_y: (...) in the disk, d_x <= -t_x. Returns omega (..., 3),
    in the frame of projected_cap_geometry, its density (...) with respect to projected solid angle, and the cut disk's area
    (...). [Peters19 suppl. Sec 2]
    """

def projected_cap_worst_density_bound(inverse_sine: typing.Any) -> typing.Any:
    """
    The maximum of projected_cap_density_bound over all elevations of a sphere light.

    inverse_sine: (...) > 1, the distance of the sphere over its radius. Returns (...): sqrt(2) from 2 on.
    [Peters19 suppl. Sec 3.4]
    """

def sg_eval(axis: typing.Any, sharpness: typing.Any, omega: typing.Any) -> typing.Any:
    """
    sg_eval(axis, sharpness, omega): the spherical Gaussian exp(sharpness (omega . axis - 1)), 1 on its axis.

    axis, omega (..., 3), unit; sharpness (...) >= 0. [Tokuyoshi15]
    """

def sg_ggx_lobe(alpha: typing.Any, wo_local: typing.Any) -> typing.Any:
    """
    sg_ggx_lobe(alpha, wo_local): the Gaussian nearest to a GGX reflection lobe over the normal z.

    Returns (axis (..., 3), sharpness (...)): the mirror direction and 2 / alpha^2 / (4 |cos_o|). alpha (...) in (0, 1],
    wo_local (..., 3), unit, not in the plane z = 0. [Tokuyoshi15, appendix A]
    """

def sg_integral(sharpness: typing.Any) -> typing.Any:
    """
    sg_integral(sharpness): the Gaussian's integral over the sphere in steradians, 2 pi (1 - exp(-2 lambda)) / lambda.

    sharpness (...) >= 0, 0 gives 4 pi. [Tokuyoshi15, A(lambda)]
    """

def sg_irradiance(sharpness: typing.Any, cos_axis: typing.Any) -> typing.Any:
    """
    sg_irradiance(sharpness, cos_axis): the integral of the Gaussian times the clamped cosine to a normal.

    cos_axis (...): cosine between the Gaussian's axis and the normal. Error 1e-12 in float64.
    """

def sg_irradiance_estimate(sharpness: typing.Any, cos_axis: typing.Any) -> typing.Any:
    """
    sg_irradiance_estimate(sharpness, cos_axis): sg_irradiance within 2 % of the Gaussian's integral, in closed form.

    [Tokuyoshi24]
    """

def sg_irradiance_vsgl(sharpness: typing.Any, cos_axis: typing.Any) -> typing.Any:
    """
    sg_irradiance_vsgl(sharpness, cos_axis): A(sharpness) max(cos_axis, 0), the VSGL's diffuse shading before the factor
    intensity * reflectance / pi. The cosine is taken as constant: for the exact value see sg_irradiance.

    [Tokuyoshi15, appendix B]
    """

def sg_product(axis_a: typing.Any, sharpness_a: typing.Any, axis_b: typing.Any, sharpness_b: typing.Any) -> typing.Any:
    """
    sg_product(axis_a, sharpness_a, axis_b, sharpness_b): the product of two Gaussians, itself one.

    Returns (axis (..., 3), sharpness (...), log_amplitude (...)): the product is exp(log_amplitude) times the Gaussian.
    log_amplitude = -lambda_a lambda_b |a - b|^2 / (lambda + lambda_a + lambda_b).
    """

def sg_sharpness_of_mean(mean_length: typing.Any) -> typing.Any:
    """
    sg_sharpness_of_mean(mean_length): the sharpness of the Gaussian of directions whose mean vector is so long.

    Within 4 % from a length of 0.9 on, 8 % below. mean_length (...) in [0, 1]. [Banerjee05 (4.4)]
    """

def sphere_light_cap(center: typing.Any, radius: typing.Any) -> typing.Any:
    """
    The cap that a sphere covers, seen from the origin.

    center: (..., 3) and radius: (...) >= 0, in one unit of length. Returns axis (..., 3) and versine (...): 2, the whole
    sphere of directions, from inside the sphere or on it. [Dupuy17 Sec 5.1]
    """

def sptd_cosine_cap_pdf(
    axis: typing.Any,
    versine: typing.Any,
    pivot_direction: typing.Any,
    delta: typing.Any,
    cosine_axis: typing.Any,
    omega: typing.Any,
) -> typing.Any:
    """
    The density of sptd_cosine_cap_sample, per steradian: 0 outside the cap and the image of the cosine's horizon.

    Arguments as of sptd_cosine_cap_sample, with omega: (..., 3) unit for u. Returns (...).
    """

def sptd_cosine_cap_sample(
    axis: typing.Any,
    versine: typing.Any,
    pivot_direction: typing.Any,
    delta: typing.Any,
    cosine_axis: typing.Any,
    u: typing.Any,
) -> typing.Any:
    """
    A direction from it inside a cap.

    axis, pivot_direction, cosine_axis: (..., 3) unit; versine: (...) in [0, 2]; delta: (...) in (0, 1]; u: (..., 2) in
    [0, 1). Returns (..., 3), unit. [Dupuy17 Sec 4.2]
    """

def sptd_cosine_clipped_pdf(
    axis1: typing.Any,
    versine1: typing.Any,
    axis2: typing.Any,
    versine2: typing.Any,
    pivot_direction: typing.Any,
    delta: typing.Any,
    cosine_axis: typing.Any,
    omega: typing.Any,
) -> typing.Any:
    """
    The density of sptd_cosine_clipped_sample, per steradian: 0 outside the intersection.

    Arguments as of sptd_cosine_clipped_sample, with omega: (..., 3) unit for u. Returns (...).
    """

def sptd_cosine_clipped_sample(
    axis1: typing.Any,
    versine1: typing.Any,
    axis2: typing.Any,
    versine2: typing.Any,
    pivot_direction: typing.Any,
    delta: typing.Any,
    cosine_axis: typing.Any,
    u: typing.Any,
) -> typing.Any:
    """
    A direction from it inside two caps, such as light and hemisphere.

    axis1, axis2, pivot_direction, cosine_axis: (..., 3) unit; versine1, versine2: (...) in [0, 2]; delta: (...) in (0, 1];
    u: (..., 2) in [0, 1). Returns (..., 3), unit. [Dupuy17 Sec 4.2]
    """

def sptd_cosine_eval(
    omega: typing.Any, pivot_direction: typing.Any, delta: typing.Any, cosine_axis: typing.Any
) -> typing.Any:
    """
    The pivot transformed clamped cosine, per steradian; also the pdf of sptd_cosine_sample.

    omega, pivot_direction, cosine_axis: (..., 3) unit; delta: (...) in (0, 1]. Returns (...). The pivot turns the sphere
    around: the lobe faces away from cosine_axis. [Dupuy17 Eq 8]
    """

def sptd_cosine_integral(
    axis: typing.Any, versine: typing.Any, pivot_direction: typing.Any, delta: typing.Any, cosine_axis: typing.Any
) -> typing.Any:
    """
    Its integral over a cap, in [0, 1].

    axis, pivot_direction, cosine_axis: (..., 3) unit; versine: (...) in [0, 2]; delta: (...) in (0, 1]. Returns (...).
    [Dupuy17 Eq 10]
    """

def sptd_cosine_integral2(
    axis1: typing.Any,
    versine1: typing.Any,
    axis2: typing.Any,
    versine2: typing.Any,
    pivot_direction: typing.Any,
    delta: typing.Any,
    cosine_axis: typing.Any,
) -> typing.Any:
    """
    Its integral over the intersection of two caps, in [0, 1].

    axis1, axis2, pivot_direction, cosine_axis: (..., 3) unit; versine1, versine2: (...) in [0, 2]; delta: (...) in (0, 1].
    Returns (...). [Dupuy17 Eq 11]
    """

def sptd_cosine_integral3(
    axis1: typing.Any,
    versine1: typing.Any,
    axis2: typing.Any,
    versine2: typing.Any,
    axis3: typing.Any,
    versine3: typing.Any,
    pivot_direction: typing.Any,
    delta: typing.Any,
    cosine_axis: typing.Any,
) -> typing.Any:
    """
    Its integral over the intersection of three caps, in [0, 1].

    axis1, axis2, axis3, pivot_direction, cosine_axis: (..., 3) unit; versine1, versine2, versine3: (...) in [0, 2];
    delta: (...) in (0, 1]. Returns (...). [Dupuy17 Eq 11]
    """

def sptd_cosine_sample(
    pivot_direction: typing.Any, delta: typing.Any, cosine_axis: typing.Any, u: typing.Any
) -> typing.Any:
    """
    A direction from it; its pdf is sptd_cosine_eval.

    pivot_direction, cosine_axis: (..., 3) unit; delta: (...) in (0, 1]; u: (..., 2) in [0, 1). Returns (..., 3), unit.
    [Dupuy17 Sec 4.2]
    """

def sptd_uniform_cap_pdf(
    axis: typing.Any, versine: typing.Any, pivot_direction: typing.Any, delta: typing.Any, omega: typing.Any
) -> typing.Any:
    """
    The density of sptd_uniform_cap_sample, per steradian: 0 outside.

    axis, pivot_direction, omega: (..., 3) unit; versine: (...) in (0, 2]; delta: (...) in (0, 1]. Returns (...).
    [Dupuy17 Sec 6.1]
    """

def sptd_uniform_cap_sample(
    axis: typing.Any, versine: typing.Any, pivot_direction: typing.Any, delta: typing.Any, u: typing.Any
) -> typing.Any:
    """
    A direction from it inside a cap.

    axis, pivot_direction: (..., 3) unit; versine: (...) in [0, 2]; delta: (...) in (0, 1]; u: (..., 2) in [0, 1).
    Returns (..., 3), unit. [Dupuy17 Sec 6.1]
    """

def sptd_uniform_clipped_pdf(
    axis1: typing.Any,
    versine1: typing.Any,
    axis2: typing.Any,
    versine2: typing.Any,
    pivot_direction: typing.Any,
    delta: typing.Any,
    omega: typing.Any,
) -> typing.Any:
    """
    The density of sptd_uniform_clipped_sample, per steradian: 0 outside the intersection.

    Arguments as of sptd_uniform_clipped_sample, with omega: (..., 3) unit for u. Returns (...).
    """

def sptd_uniform_clipped_sample(
    axis1: typing.Any,
    versine1: typing.Any,
    axis2: typing.Any,
    versine2: typing.Any,
    pivot_direction: typing.Any,
    delta: typing.Any,
    u: typing.Any,
) -> typing.Any:
    """
    A direction from it inside two caps, such as light and hemisphere.

    axis1, axis2, pivot_direction: (..., 3) unit; versine1, versine2: (...) in [0, 2]; delta: (...) in (0, 1];
    u: (..., 2) in [0, 1). Returns (..., 3), unit. [Dupuy17 Sec 4.2]
    """

def sptd_uniform_eval(omega: typing.Any, pivot_direction: typing.Any, delta: typing.Any) -> typing.Any:
    """
    The pivot transformed uniform distribution, per steradian; also its pdf.

    omega, pivot_direction: (..., 3) unit; delta: (...) in (0, 1]. Returns (...). [Dupuy17 Eq 8, 16]
    """

def sptd_uniform_integral(
    axis: typing.Any, versine: typing.Any, pivot_direction: typing.Any, delta: typing.Any
) -> typing.Any:
    """
    Its integral over a cap, in [0, 1].

    axis, pivot_direction: (..., 3) unit; versine: (...) in [0, 2]; delta: (...) in (0, 1]. Returns (...).
    [Dupuy17 Eq 10, 15]
    """

def sptd_uniform_integral2(
    axis1: typing.Any,
    versine1: typing.Any,
    axis2: typing.Any,
    versine2: typing.Any,
    pivot_direction: typing.Any,
    delta: typing.Any,
) -> typing.Any:
    """
    Its integral over the intersection of two caps, in [0, 1].

    axis1, axis2, pivot_direction: (..., 3) unit; versine1, versine2: (...) in [0, 2], 1 to clip at the horizon;
    delta: (...) in (0, 1]. Returns (...). [Dupuy17 Eq 17-19, 23]
    """

def sptd_uniform_integral3(
    axis1: typing.Any,
    versine1: typing.Any,
    axis2: typing.Any,
    versine2: typing.Any,
    axis3: typing.Any,
    versine3: typing.Any,
    pivot_direction: typing.Any,
    delta: typing.Any,
) -> typing.Any:
    """
    Its integral over the intersection of three caps, in [0, 1].

    axis1, axis2, axis3, pivot_direction: (..., 3) unit; versine1, versine2, versine3: (...) in [0, 2]; delta: (...) in
    (0, 1]. Returns (...). Specular occlusion above the horizon. [Dupuy17 Eq 23, clipped]
    """

def sptd_uniform_sample(pivot_direction: typing.Any, delta: typing.Any, u: typing.Any) -> typing.Any:
    """
    A direction from it; its pdf is sptd_uniform_eval.

    pivot_direction: (..., 3) unit; delta: (...) in (0, 1]; u: (..., 2) in [0, 1). Returns (..., 3), unit. [Dupuy17 Sec 4.2]
    """
