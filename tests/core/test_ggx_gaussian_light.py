"""GGX under spherical Gaussians of radiance, against quadrature."""

import numpy as np
import pivot_core.shading as ps
import pytest
from numpy.typing import NDArray

from tests.core.ggx_reference import ggx_under_gaussian

Doubles = NDArray[np.float64]


def unit(v: Doubles) -> Doubles:
    return v / np.linalg.norm(v, axis=-1, keepdims=True)


def cases(count: int, seed: int) -> list[tuple[float, Doubles, Doubles, float]]:
    """alpha 0.05..0.5, views 30..85 degrees, sharpness 10..3000, lights around the highlight."""
    random = np.random.default_rng(seed)
    result = []
    for _ in range(count):
        alpha, theta = 10 ** random.uniform(np.log10(0.05), np.log10(0.5)), np.radians(random.uniform(30, 85))
        wo = np.array([np.sin(theta), 0.0, np.cos(theta)])
        sharpness = 10 ** random.uniform(1, np.log10(3000))
        width = np.sqrt(1 / sharpness + 2 * alpha**2 * wo[2])
        axis = unit(np.array([-wo[0], 0.0, wo[2]]) + width * random.normal(size=3))
        result.append((alpha, wo, axis, sharpness))
    return result


@pytest.fixture(scope="module")
def errors() -> dict[str, Doubles]:
    """Relative to the larger of the integral and a twentieth of what the light gives in the highlight, by way."""
    lights = cases(150, 1)
    exact = np.array([ggx_under_gaussian(*light) for light in lights])
    alpha, wo, axis, sharpness = (np.array(values) for values in zip(*lights, strict=True))
    mirror = wo * [-1, -1, 1]
    most = ps.ggx_gaussian_light(alpha, wo, mirror, sharpness, "AUTO")[0]
    scale = np.maximum(exact, 0.05 * most)
    return {
        way: np.abs(ps.ggx_gaussian_light(alpha, wo, axis, sharpness, way)[0] - exact) / scale
        for way in ("AUTO", "CAPS", "WIDENED", "ANISOTROPIC")
    }


def test_caps_and_points_are_near_the_integral(errors: dict[str, Doubles]) -> None:
    error = errors["AUTO"]
    assert error.mean() < 0.025
    assert np.quantile(error, 0.95) < 0.08


def test_the_widened_lobe_is_nearer_than_nothing(errors: dict[str, Doubles]) -> None:
    error = errors["WIDENED"]
    assert error.mean() < 0.25
    assert error.mean() > 3 * errors["AUTO"].mean()
    assert errors["ANISOTROPIC"].mean() > error.mean()


@pytest.mark.parametrize("way", ["AUTO", "CAPS", "POINTS", "WIDENED", "ANISOTROPIC"])
def test_any_light_gives_a_number(way: str) -> None:
    random = np.random.default_rng(2)
    n = 4000
    alpha = 10 ** random.uniform(-3, 0, n)
    wo, axis = unit(random.normal(size=(n, 3))), unit(random.normal(size=(n, 3)))
    wo[:, 2] = np.abs(wo[:, 2]) + 1e-4
    sharpness = 10 ** random.uniform(-8, 7, n)
    value, error, _ = ps.ggx_gaussian_light(alpha, unit(wo), axis, sharpness, way)
    assert np.isfinite(value).all()
    assert np.isfinite(error).all()
    assert (value >= 0).all()
    if way == "AUTO":
        assert value.max() < 1.1
