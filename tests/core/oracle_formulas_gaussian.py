"""Spherical Gaussians, for test_oracles.py."""

from typing import Any

import numpy as np
import pivot_core.distributions as pd


def sg_eval(inputs: dict[str, Any], dtype: type) -> dict[str, Any]:
    return {"G": pd.sg_eval(inputs["axis"], inputs["lam"], inputs["omega"])}


def sg_integral(inputs: dict[str, Any], dtype: type) -> dict[str, Any]:
    return {"A": pd.sg_integral(inputs["lam"]), "A_approx": dtype(2 * np.pi) / inputs["lam"]}


def sg_diffuse(inputs: dict[str, Any], dtype: type) -> dict[str, Any]:
    return {
        "exact_int_SG_cos_plus": pd.sg_irradiance(inputs["lam"], inputs["cos_xi_n"]),
        "formula_A_cos": pd.sg_irradiance_vsgl(inputs["lam"], inputs["cos_xi_n"]),
    }


def sg_specular_lobe(inputs: dict[str, Any], dtype: type) -> dict[str, Any]:
    axis, sharpness = pd.sg_ggx_lobe(inputs["alpha"], inputs["wo"])
    return {"lambda_h": dtype(2) / inputs["alpha"] ** 2, "lambda_s": sharpness, "xi_s": axis}


def asg_sg_product(inputs: dict[str, Any], dtype: type) -> dict[str, Any]:
    frame = np.eye(3, dtype=dtype)
    return {
        "formula": pd.asg_integrate_sg(frame, inputs["eta_x"], inputs["eta_y"], inputs["xi_in"], inputs["lam"]),
    }


FORMULAS = {
    "sg_eval": sg_eval,
    "sg_integral": sg_integral,
    "sg_diffuse": sg_diffuse,
    "sg_specular_lobe": sg_specular_lobe,
    "asg_sg_product": asg_sg_product,
}
