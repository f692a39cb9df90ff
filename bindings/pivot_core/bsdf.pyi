"""
The GGX lobe and Fresnel reflectance, over NumPy arrays.
"""

from __future__ import annotations
import typing

__all__: list[str] = ["f0_from_ior", "fresnel_dielectric", "ggx_eval", "ggx_pdf", "ggx_sample"]

def f0_from_ior(ior: typing.Any) -> typing.Any:
    """
    f0_from_ior(ior): reflectance at normal incidence, ((ior - 1) / (ior + 1))^2.
    """

def fresnel_dielectric(cos_theta: typing.Any, ior: typing.Any) -> typing.Any:
    """
    fresnel_dielectric(cos_theta, ior): unpolarised reflectance, cos_theta (...) in [0, 1]; ior (...) > 0: of the other side,
    over that of the side where the light is.
    """

def ggx_eval(alpha: typing.Any, wo_local: typing.Any, wi_local: typing.Any) -> typing.Any:
    """
    ggx_eval(alpha, wo_local, wi_local): D G2 / (4 cos_o), the GGX BRDF times cos_i without Fresnel, per steradian; 0 for
    wi_local below the surface.

    alpha (...) > 0; wo_local (..., 3), unit, z > 0; wi_local (..., 3), unit. Height-correlated Smith. [Heitz14]
    """

def ggx_pdf(alpha: typing.Any, wo_local: typing.Any, wi_local: typing.Any) -> typing.Any:
    """
    ggx_pdf(alpha, wo_local, wi_local): the pdf per steradian of ggx_sample.
    """

def ggx_sample(alpha: typing.Any, wo_local: typing.Any, u: typing.Any) -> typing.Any:
    """
    ggx_sample(alpha, wo_local, u): wo_local mirrored at a visible normal, (..., 3); may lie below the surface, where the
    lobe is 0.

    u (..., 2) in [0, 1). [Dupuy23]
    """
