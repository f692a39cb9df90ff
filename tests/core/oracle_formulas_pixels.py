"""Solid angles of pixels, for test_oracles.py."""

from typing import Any

import pivot_core.distributions as pd


def ortho_corner(inputs: dict[str, Any], dtype: type) -> dict[str, Any]:
    return {"A": pd.orthographic_corner_solid_angle(inputs["x"], inputs["y"])}


def ortho_pixel(inputs: dict[str, Any], dtype: type) -> dict[str, Any]:
    return {"omega": pd.orthographic_pixel_solid_angle(inputs["x0"], inputs["x1"], inputs["y0"], inputs["y1"])}


def cubemap_corner(inputs: dict[str, Any], dtype: type) -> dict[str, Any]:
    return {"A": pd.cubemap_corner_solid_angle(inputs["x"], inputs["y"])}


FORMULAS = {"ortho_corner": ortho_corner, "ortho_pixel": ortho_pixel, "cubemap_corner": cubemap_corner}
