"""The curve of sRGB: the standard's values, and back again."""

import importlib.util
from pathlib import Path

import numpy as np

spec = importlib.util.spec_from_file_location("srgb", Path(__file__).parents[2] / "addon/srgb.py")
srgb = importlib.util.module_from_spec(spec)
spec.loader.exec_module(srgb)


def test_the_curve_is_the_standards() -> None:
    encoded = np.array([0.0, 0.04045, 0.5, 1.0])
    np.testing.assert_allclose(srgb.linear_from_srgb(encoded), [0, 0.0031308, 0.2140411, 1], rtol=1e-5)


def test_there_and_back() -> None:
    encoded = np.linspace(0, 1, 256)
    np.testing.assert_allclose(srgb.srgb_from_linear(srgb.linear_from_srgb(encoded)), encoded, atol=1e-6)
    np.testing.assert_allclose(srgb.srgb_from_linear(np.array([-1.0, 2.0])), [0, 1], atol=1e-15)
