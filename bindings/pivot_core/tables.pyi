"""
Tables fitted by lut/, fetched with linear interpolation.
"""

from __future__ import annotations
import numpy
import numpy.typing
import typing

__all__: list[str] = [
    "alpha_nodes",
    "cos_nodes",
    "eta_nodes",
    "ggx_albedo",
    "ggx_average_albedo",
    "ggx_dielectric_weight",
    "ggx_glass_albedo",
    "ggx_glass_average_albedo",
    "ggx_ltc",
    "ggx_ltc_from_node",
    "ggx_sptd",
    "ggx_sptd_from_node",
    "ior_nodes",
]

def alpha_nodes(count: typing.SupportsInt | typing.SupportsIndex) -> numpy.typing.NDArray[numpy.float32]:
    """
    alpha_nodes(count): alpha at the nodes of a table of that size, 1e-3 to 1, even in its square root.
    """

def cos_nodes(count: typing.SupportsInt | typing.SupportsIndex) -> numpy.typing.NDArray[numpy.float32]:
    """
    cos_nodes(count): cosine at the nodes of a table of that size, 0 to 1, even in its square root.
    """

def eta_nodes(count: typing.SupportsInt | typing.SupportsIndex) -> numpy.typing.NDArray[numpy.float32]:
    """
    eta_nodes(count): relative index of refraction at the nodes of a table of that size, 1 in the middle.
    """

def ggx_albedo(alpha: typing.Any, cos_o: typing.Any) -> typing.Any:
    """
    ggx_albedo(alpha, cos_o): the integral of GGX BRDF * cos over the hemisphere, F = 1, from the table.
    """

def ggx_average_albedo(alpha: typing.Any) -> typing.Any:
    """
    ggx_average_albedo(alpha): 2 int E cos dcos of ggx_albedo's E, from the table.
    """

def ggx_dielectric_weight(alpha: typing.Any, cos_o: typing.Any, ior: typing.Any) -> typing.Any:
    """
    ggx_dielectric_weight(alpha, cos_o, ior): s such that the GGX lobe under the dielectric Fresnel curve has albedo
    lerp(F0, 1, s) * ggx_albedo, from the table. ior (...) >= 1, held at 3 above that.
    """

def ggx_glass_albedo(alpha: typing.Any, cos_o: typing.Any, eta: typing.Any) -> typing.Any:
    """
    ggx_glass_albedo(alpha, cos_o, eta): (reflected (...), refracted (...)), what a rough dielectric boundary sends to the
    viewer by single scattering where all light around is 1, by the side that it comes from, from the table. eta: the other
    side's index of refraction over the viewer's.
    """

def ggx_glass_average_albedo(alpha: typing.Any, eta: typing.Any) -> typing.Any:
    """
    ggx_glass_average_albedo(alpha, eta): 2 int E cos dcos of both of ggx_glass_albedo's together, from the table.
    """

def ggx_ltc(alpha: typing.Any, wo_local: typing.Any) -> typing.Any:
    """
    ggx_ltc(alpha, wo_local): the linearly transformed cosine nearest to the GGX lobe, from the table: (m (..., 3, 3),
    albedo (...), amplitude (...)). amplitude times the LTC integrates to albedo over the hemisphere.

    alpha (...) in [1e-3, 1]; wo_local (..., 3), unit. [Heitz16]
    """

def ggx_ltc_from_node(
    alpha: typing.Any,
    wo_local: typing.Any,
    shift: typing.Any,
    width_x: typing.Any,
    width_y: typing.Any,
    skew: typing.Any,
) -> typing.Any:
    """
    ggx_ltc_from_node(alpha, wo_local, shift, width_x, width_y, skew): the matrix (..., 3, 3) that a node of the LTC
    table stands for.
    """

def ggx_sptd(alpha: typing.Any, wo_local: typing.Any) -> typing.Any:
    """
    ggx_sptd(alpha, wo_local): the SPTD nearest to the GGX lobe, from the table: (pivot_local (..., 3), delta (...),
    albedo (...), amplitude (...)). amplitude times the SPTD integrates to albedo over the hemisphere.

    alpha (...) in [1e-3, 1]; wo_local (..., 3), unit. [Dupuy17, 5.2]
    """

def ggx_sptd_from_node(alpha: typing.Any, wo_local: typing.Any, shift: typing.Any, width: typing.Any) -> typing.Any:
    """
    ggx_sptd_from_node(alpha, wo_local, shift, width): (pivot_local (..., 3), delta (...)) that a node of the SPTD table
    stands for. The pivot lies 2 atan(alpha shift sin_o / 2) from the mirror direction towards the horizon; delta = alpha width.
    """

def ior_nodes(count: typing.SupportsInt | typing.SupportsIndex) -> numpy.typing.NDArray[numpy.float32]:
    """
    ior_nodes(count): index of refraction at the nodes of a table of that size, 1 to 3, dense at 1.
    """
