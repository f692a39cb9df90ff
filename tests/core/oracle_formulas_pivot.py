"""The pivot transformation and its distributions, for test_oracles.py."""

from typing import Any

import numpy as np
import pivot_core.distributions as pd

from tests.core.oracle_formulas_caps import Values, versine


def pivot_of(inputs: Values) -> tuple[Any, Any]:
    return inputs["pivot_dir"], inputs["delta"]


def light_of(inputs: Values) -> tuple[Any, Any]:
    return inputs["cap_dir"], versine(inputs["psi"])


def sptd_g_on_sphere(inputs: Values, dtype: type) -> Values:
    arguments = inputs["omega"], *pivot_of(inputs)
    return {"g": pd.pivot_transform(*arguments), "jacobian": pd.pivot_jacobian(*arguments)}


def sptd_g_off_sphere(inputs: Values, dtype: type) -> Values:
    g = pd.pivot_transform_point(inputs["r"], *pivot_of(inputs))
    return {"g": g, "g_of_g": pd.pivot_transform_point(g, *pivot_of(inputs))}


def sptd_cap_transform(inputs: Values, dtype: type) -> Values:
    axis, h = pd.pivot_transform_cap(*light_of(inputs), *pivot_of(inputs))
    # of the cap and the rest of the sphere, which maps to the rest, the smaller holds the bits of both
    if inputs["psi"] <= np.pi / 2:
        one_minus_cos, one_plus_cos = pd.pivot_transform_cap_versines(*light_of(inputs), *pivot_of(inputs))
    else:
        rest = -inputs["cap_dir"], np.asarray(2 * np.cos(inputs["psi"] / 2) ** 2, dtype)
        one_plus_cos, one_minus_cos = pd.pivot_transform_cap_versines(*rest, *pivot_of(inputs))
    return {
        "dir": axis,
        "cos_psi": dtype(1) - h,
        "sin_psi": np.sqrt(one_minus_cos * one_plus_cos),
        "A": pd.cap_solid_angle(h),
    }


def sptd_eval(inputs: Values, dtype: type) -> Values:
    arguments = inputs["omega"], *pivot_of(inputs)
    return {
        "D_uniform": pd.sptd_uniform_eval(*arguments),
        "D_cosine": pd.sptd_cosine_eval(*arguments, inputs["cos_axis"]),
    }


def sptd_cap_integral(inputs: Values, dtype: type) -> Values:
    arguments = *light_of(inputs), *pivot_of(inputs)
    return {
        "I_uniform": pd.sptd_uniform_integral(*arguments),
        "I_cosine": pd.sptd_cosine_integral(*arguments, inputs["cos_axis"]),
    }


def sptd_clipped_light(inputs: Values, dtype: type) -> Values:
    caps = *light_of(inputs), inputs["normal"], dtype(1)
    return {"Lo_over_L": pd.sptd_uniform_integral2(*caps, *pivot_of(inputs))}


def sptd_triple_product(inputs: Values, dtype: type) -> Values:
    caps = *light_of(inputs), inputs["bent_dir"], versine(inputs["bent_psi"])
    return {"Lo_over_L": pd.sptd_uniform_integral2(*caps, *pivot_of(inputs))}


def sptd_joint_pdf(inputs: Values, dtype: type) -> Values:
    return {"pdf": pd.sptd_uniform_cap_pdf(*light_of(inputs), *pivot_of(inputs), inputs["omega"])}


FORMULAS = {
    function.__name__: function
    for function in (
        sptd_g_on_sphere,
        sptd_g_off_sphere,
        sptd_cap_transform,
        sptd_eval,
        sptd_cap_integral,
        sptd_clipped_light,
        sptd_triple_product,
        sptd_joint_pdf,
    )
}
