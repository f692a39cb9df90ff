"""Linearly transformed distributions, for test_oracles.py."""

from typing import Any

import pivot_core.distributions as pd


def ltsd_eval(inputs: dict[str, Any], dtype: type) -> dict[str, Any]:
    return {"D": pd.ltsd_eval(inputs["D_o"], inputs["M"], inputs["omega"])}


def ltsd_polygon(inputs: dict[str, Any], dtype: type) -> dict[str, Any]:
    return {"I": pd.ltsd_integrate_polygon(inputs["D_o"], inputs["M"], inputs["P"])}


def ltsd_moments(inputs: dict[str, Any], dtype: type) -> dict[str, Any]:
    return {"mean": pd.ltsd_mean_direction(inputs["D_o"], inputs["M"])}


def ltsd_sample_theta(inputs: dict[str, Any], dtype: type) -> dict[str, Any]:
    return {"cos_theta": pd.ltsd_base_sample_cosine(inputs["D_o"], inputs["xi"])}


FORMULAS = {
    "ltsd_eval": ltsd_eval,
    "ltsd_polygon": ltsd_polygon,
    "ltsd_moments": ltsd_moments,
    "ltsd_sample_theta": ltsd_sample_theta,
}
